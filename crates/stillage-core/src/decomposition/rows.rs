//! From the bodies between aisles to rows, from rows to places.
//!
//! The bodies are cut into rows by the depth of their places ([`super::depth`]), the rows into places by the comb, with
//! the pitch and the goods that [`super::reading`] finds in all rows of one direction together. Where nothing repeats,
//! there is no comb: walls, shelves and furniture are not cut into places. Cost: O(cells x pitches).

use std::ops::Range;

use super::blocks::{Block, BlockKind};
use super::comb;
use super::depth::{self, Body};
use super::evidence::Evidence;
use super::frame::{Axis, Frame, Rect};
use super::gate;
use super::layers::{self, Stack};
use super::pieces;
use super::pitch::Guesses;
use super::reading::{Reading, Rows};
use super::{Parcel, PlotKind};
use crate::watch::{Stopped, Watch};

/// Depths of places that occur, metres: from 0.8 m (Euro pallets along the aisle) to 1.3 m and what drift adds.
pub(super) const DEPTHS_M: [f64; 2] = [0.8, 1.45];
/// Widths of places that occur, metres.
pub(super) const PITCHES_M: [f64; 2] = [0.8, 1.6];
/// Cells above this are too coarse for gaps and posts, metres.
const COARSEST_CELL_M: f64 = 0.1;

/// Hints of the user, metres.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hints {
    pub pitch: [f64; 2],
    pub depth: [f64; 2],
}

impl Hints {
    /// Widths that places may have.
    fn widths(&self) -> [f64; 2] {
        [self.pitch[0] - comb::NARROWER_M, self.pitch[1] + comb::WIDER_M]
    }
}

/// One row of places, or several that are reached from one side, one behind the other: their lanes run through.
struct Row {
    /// All layers together.
    rect: Rect,
    axis: Axis,
    /// Ranges across the row.
    layers: Stack,
    /// Of the layers together.
    evidence: Evidence,
}

impl Row {
    fn of(frame: &Frame, body: &Body, layers: Stack, hints: &Hints) -> Self {
        let axis = body.axis;
        let of_layer = |layer: &Range<usize>| {
            let rect = body.rect.with(axis.other(), layer.clone());
            Evidence::of(&frame.patch(&rect, axis), frame.cell, hints.widths())
        };
        let evidence = Evidence::bundle(layers.iter().map(of_layer));
        let start = layers.iter().map(|layer| layer.start).min().unwrap_or(0);
        let end = layers.iter().map(|layer| layer.end).max().unwrap_or(start);
        Self { rect: body.rect.with(axis.other(), start..end), axis, layers, evidence }
    }
}

/// Lays the blocks of a region out.
pub(super) fn lay_out(
    frame: &Frame,
    blocks: &[Block],
    hints: &Hints,
    watch: &Watch<'_>,
) -> Result<Vec<Parcel>, Stopped> {
    let mut parcels = Vec::new();
    let mut bodies = Vec::new();
    for block in blocks {
        match block.kind {
            BlockKind::Aisle => parcels.push(Parcel::new(block.rect.clone(), PlotKind::Aisle, block.axis)),
            BlockKind::Lane => parcels.push(Parcel::new(block.rect.clone(), PlotKind::Lane, block.axis)),
            BlockKind::Body => bodies.push(Body::of(frame, block)),
        }
    }
    let depth = depth::usual(frame, &bodies, hints.depth);
    for axis in Axis::BOTH {
        let bodies: Vec<&Body> = bodies.iter().filter(|body| body.axis == axis).collect();
        let (mut rows, mut rests) = (Vec::new(), Vec::new());
        for (body, layers) in bodies.iter().zip(layers::cut(frame, &bodies, depth, hints.depth)) {
            watch.check()?;
            let rest_of = |rest| Parcel::new(body.rect.with(axis.other(), rest), PlotKind::Rest, Some(axis));
            rests.extend(layers.rests.into_iter().map(rest_of));
            rows.extend(layers.stacks.into_iter().map(|stack| Row::of(frame, body, stack, hints)));
        }
        watch.check()?;
        if is_periodic(frame, &rows, hints) {
            parcels.append(&mut rests);
            comb_rows(frame, &rows, hints, &mut parcels, watch)?;
        } else {
            let whole = |body: &&Body| Parcel::new(body.rect.clone(), PlotKind::Rest, Some(axis));
            parcels.extend(bodies.iter().map(whole));
        }
    }
    Ok(parcels)
}

/// Whether these are rows of places, or walls and furniture, which are not cut.
fn is_periodic(frame: &Frame, rows: &[Row], hints: &Hints) -> bool {
    let evidence: Vec<&Evidence> = rows.iter().map(|row| &row.evidence).collect();
    let patch = |row: usize| frame.patch(&rows[row].rect, rows[row].axis);
    frame.cell <= COARSEST_CELL_M && gate::is_periodic(&evidence, patch, hints.widths(), hints.pitch)
}

/// Cuts the rows of one direction.
fn comb_rows(
    frame: &Frame,
    rows: &[Row],
    hints: &Hints,
    parcels: &mut Vec<Parcel>,
    watch: &Watch<'_>,
) -> Result<(), Stopped> {
    let all: Vec<&Evidence> = rows.iter().map(|row| &row.evidence).collect();
    let guesses = Guesses::of(&all, hints.pitch);
    watch.check()?;
    let readings = Rows { rows: &all, guesses: &guesses }.read();
    for (row, reading) in rows.iter().zip(readings) {
        match reading {
            Some(reading) => comb_row(frame, row, &reading, parcels),
            None => parcels.push(Parcel::new(row.rect.clone(), PlotKind::Rest, Some(row.axis))),
        }
    }
    Ok(())
}

/// Cuts a row into parcels, the same in each of its layers.
fn comb_row(frame: &Frame, row: &Row, reading: &Reading, parcels: &mut Vec<Parcel>) {
    let pieces = pieces::of_comb(&reading.cut(&row.evidence), reading.pitch, frame);
    let start = row.rect.range(row.axis).start;
    let stack = row.rect.range(row.axis.other());
    for (piece, kind) in pieces {
        let range = start + piece.start..start + piece.end;
        for layer in &row.layers {
            let rect = row.rect.with(row.axis, range.clone()).with(row.axis.other(), layer.clone());
            parcels.push(Parcel { rect, kind, axis: Some(row.axis), stack: stack.clone() });
        }
    }
}
