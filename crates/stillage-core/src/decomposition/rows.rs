//! From the bodies between aisles to rows, from rows to places.
//!
//! The bodies are cut into rows by the depth of their places ([`super::depth`]), the rows into places by the comb, with
//! the pitch and the goods that [`super::reading`] finds in all rows of one direction together. Where nothing repeats,
//! there is no comb: walls, shelves and furniture are not cut into places. Cost: O(cells x pitches).

use std::ops::Range;

use super::blocks::{Block, BlockKind};
use super::comb::{self, Tooth};
use super::depth::{self, Body};
use super::evidence::Evidence;
use super::frame::{Axis, Frame, Rect};
use super::gate;
use super::reading::{self, Reading, Rows};
use super::{Parcel, PlotKind};
use crate::watch::{Stopped, Watch};

/// Depths of places that occur, metres: from 0.8 m (Euro pallets along the aisle) to 1.3 m and what drift adds.
pub(super) const DEPTHS_M: [f64; 2] = [0.8, 1.45];
/// Widths of places that occur, metres.
pub(super) const PITCHES_M: [f64; 2] = [0.8, 1.6];
/// Cells above this are too coarse for gaps and posts, metres.
const COARSEST_CELL_M: f64 = 0.1;
/// Pieces narrower than this are given to their neighbour, metres.
const SLIVER_M: f64 = 0.4;
/// An end piece that differs from the pitch by less than this share of it is a place.
const END_SHARE: f64 = 0.3;

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

/// One row of places.
struct Row {
    rect: Rect,
    axis: Axis,
    evidence: Evidence,
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
        for body in &bodies {
            watch.check()?;
            let layers = depth::layers(frame, body, depth, hints.depth);
            let rest_of = |rest| Parcel::new(rest, PlotKind::Rest, Some(axis));
            rests.extend(layers.rests.into_iter().map(|rest| rest_of(body.rect.with(axis.other(), rest))));
            for layer in layers.rows {
                let layer = body.rect.with(axis.other(), layer);
                let [before, within, after] = in_region(frame, &layer, axis).map(|part| layer.with(axis, part));
                rests.extend([before, after].into_iter().filter(|rest| !rest.range(axis).is_empty()).map(rest_of));
                if !within.range(axis).is_empty() {
                    let evidence = Evidence::of(&frame.patch(&within, axis), frame.cell, hints.widths());
                    rows.push(Row { rect: within, axis, evidence });
                }
            }
        }
        watch.check()?;
        if let Some(readings) = read(frame, &rows, hints, watch)? {
            parcels.append(&mut rests);
            for (row, reading) in rows.iter().zip(readings) {
                match reading {
                    Some(reading) => comb_row(frame, row, &reading, &mut parcels),
                    None => parcels.push(Parcel::new(row.rect.clone(), PlotKind::Rest, Some(row.axis))),
                }
            }
        } else {
            let whole = |body: &&Body| Parcel::new(body.rect.clone(), PlotKind::Rest, Some(axis));
            parcels.extend(bodies.iter().map(whole));
        }
    }
    Ok(parcels)
}

/// The parts of a layer before, within and behind its region: a region is bounded by tiles, its blocks are rectangles, and
/// what the next region holds stands in another direction.
fn in_region(frame: &Frame, layer: &Rect, axis: Axis) -> [Range<usize>; 3] {
    let patch = frame.patch(layer, axis);
    let along = layer.range(axis);
    let is_within = |&column: &usize| {
        2 * (0..patch.height).filter(|&row| patch.row(row)[column].is_inside()).count() >= patch.height
    };
    let first = (0..patch.width).find(is_within).unwrap_or(patch.width);
    let end = (first..patch.width).rfind(is_within).map_or(first, |last| last + 1);
    [along.start..along.start + first, along.start + first..along.start + end, along.start + end..along.end]
}

/// A reading for each of the rows of one direction, if they are rows of places; walls and furniture are not read.
fn read(
    frame: &Frame,
    rows: &[Row],
    hints: &Hints,
    watch: &Watch<'_>,
) -> Result<Option<Vec<Option<Reading>>>, Stopped> {
    if frame.cell > COARSEST_CELL_M {
        return Ok(None);
    }
    let evidence: Vec<&Evidence> = rows.iter().map(|row| &row.evidence).collect();
    let all = Rows { rows: &evidence, pitches: reading::pitches(hints.pitch) };
    let Some(first) = all.in_common() else { return Ok(None) };
    watch.check()?;
    let patch = |row: usize| frame.patch(&rows[row].rect, rows[row].axis);
    let is_periodic = gate::is_periodic(&evidence, patch, hints.widths(), &first, &all.pitches);
    watch.check()?;
    Ok(is_periodic.then(|| all.read(first)))
}

/// Cuts a row into parcels.
fn comb_row(frame: &Frame, row: &Row, reading: &Reading, parcels: &mut Vec<Parcel>) {
    let comb = reading.cut(&row.evidence);
    let pitch = reading.pitch;
    let along = row.rect.range(row.axis).clone();
    let mut pieces: Vec<(Range<usize>, PlotKind)> = Vec::new();
    let mut start = 0;
    for &(tooth, end) in &comb.pieces {
        if end <= start {
            continue;
        }
        let width = (end - start) as f64 * frame.cell;
        let kind = match tooth {
            Tooth::Place => PlotKind::Place,
            Tooth::Gap => PlotKind::Gap,
            Tooth::End if (width - pitch).abs() < END_SHARE * pitch => PlotKind::Place,
            Tooth::Slip | Tooth::End => PlotKind::Rest,
        };
        pieces.push((start..end, kind));
        start = end;
    }
    absorb_slivers(&mut pieces, frame.cells_of(SLIVER_M));
    for (piece, kind) in pieces {
        let range = along.start + piece.start..along.start + piece.end;
        parcels.push(Parcel::new(row.rect.with(row.axis, range), kind, Some(row.axis)));
    }
}

/// Gives pieces too narrow for anything to the narrower of their neighbours.
fn absorb_slivers(pieces: &mut Vec<(Range<usize>, PlotKind)>, least: usize) {
    while let Some(index) =
        pieces.iter().position(|(range, kind)| *kind == PlotKind::Rest && range.len() < least && pieces.len() > 1)
    {
        let (range, _) = pieces.remove(index);
        let before = index.checked_sub(1).map(|before| pieces[before].0.len());
        let after = pieces.get(index).map(|(range, _)| range.len());
        match (before, after) {
            (Some(before), Some(after)) if after < before => pieces[index].0.start = range.start,
            (Some(_), _) => pieces[index - 1].0.end = range.end,
            (None, _) => pieces[index].0.start = range.start,
        }
    }
}
