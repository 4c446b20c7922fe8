//! From the bodies between aisles to rows, from rows to places.
//!
//! The depth of the places is the one that explains the thickness of the bodies of a region best, as whole numbers of
//! places with a flue between backs. A body then is so many rows deep; what is left against a wall is no row. The pitch is
//! that of all rows together, unless a row says otherwise clearly. Cost: O(cells x pitches).

use std::ops::Range;

use super::blocks::{Block, BlockKind};
use super::comb::{self, Tooth};
use super::evidence::Evidence;
use super::frame::{Axis, Frame, Rect};
use super::pitch::PitchScores;
use super::{Parcel, PlotKind};
use crate::watch::{Stopped, Watch};

/// Depths of places that occur, metres: from 0.8 m (Euro pallets along the aisle) to 1.3 m and what drift adds.
pub(super) const DEPTHS_M: [f64; 2] = [0.8, 1.45];
/// Widths of places that occur, metres.
pub(super) const PITCHES_M: [f64; 2] = [0.8, 1.6];
/// The depth that a place has when nothing else is known, metres (a 1.2 m pallet), and what a metre of deviation costs.
const USUAL_DEPTH_M: f64 = 1.15;
const DEPTH_PRIOR: f64 = 0.03;
const DEPTH_STEP_M: f64 = 0.025;
/// Usual flue between the backs of two rows, metres (accuracy study).
const FLUE_M: f64 = 0.12;
/// Most rows between two aisles.
const MOST_LAYERS: usize = 16;
/// A body thinner than this share of the depth holds no row.
const THIN_SHARE: f64 = 0.6;
/// A row's own pitch must score so much better than that of the block (accuracy study).
const OWN_PITCH_GAIN: f64 = 0.1;
/// Pieces narrower than this are given to their neighbour, metres.
const SLIVER_M: f64 = 0.4;
/// An end piece that differs from the pitch by less than this share of it is a place.
const END_SHARE: f64 = 0.3;
/// Occupied share of a line of cells that makes it a wall.
const WALL_SHARE: f64 = 0.5;

/// Hints of the user, metres.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hints {
    pub pitch: [f64; 2],
    pub depth: [f64; 2],
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
    let depth = usual_depth(frame, blocks, hints);
    let widths = [hints.pitch[0] - comb::NARROWER_M, hints.pitch[1] + comb::WIDER_M];
    let mut rows = Vec::new();
    for block in blocks {
        watch.check()?;
        match block.kind {
            BlockKind::Aisle => parcels.push(Parcel::new(block.rect.clone(), PlotKind::Aisle, block.axis)),
            BlockKind::Lane => parcels.push(Parcel::new(block.rect.clone(), PlotKind::Lane, block.axis)),
            BlockKind::Body => {
                let axis = row_axis(block);
                let across = axis.other();
                let (layers, rests) = layers(frame, block, axis, depth);
                for layer in layers {
                    let rect = block.rect.with(across, layer);
                    let evidence = Evidence::of(&frame.patch(&rect, axis), frame.cell, widths);
                    rows.push(Row { rect, axis, evidence });
                }
                for rest in rests {
                    parcels.push(Parcel::new(block.rect.with(across, rest), PlotKind::Rest, Some(axis)));
                }
            }
        }
    }
    watch.check()?;
    let all: Vec<&Evidence> = rows.iter().map(|row| &row.evidence).collect();
    let pooled = PitchScores::of(&all, hints.pitch);
    let Some((pitch, _)) = pooled.best() else { return Ok(parcels) };
    for row in &rows {
        watch.check()?;
        let own = PitchScores::of(&[&row.evidence], hints.pitch);
        let own_best = own.best().filter(|&(_, score)| score > own.at(pitch) + OWN_PITCH_GAIN);
        let pitch = own_best.map_or(pitch, |(pitch, _)| pitch);
        comb_row(frame, row, pitch, &mut parcels);
    }
    Ok(parcels)
}

/// Direction of the rows of a body: that of the aisles beside it, else its long side.
fn row_axis(block: &Block) -> Axis {
    block.axis.unwrap_or(if block.rect.u.len() >= block.rect.v.len() { Axis::U } else { Axis::V })
}

/// The depth of a place that explains the bodies between aisles best.
fn usual_depth(frame: &Frame, blocks: &[Block], hints: &Hints) -> f64 {
    let bodies: Vec<(f64, f64)> = blocks
        .iter()
        .filter(|block| block.kind == BlockKind::Body && block.fronts == [true; 2])
        .map(|block| {
            let axis = row_axis(block);
            let size = |axis: Axis| block.rect.range(axis).len() as f64 * frame.cell;
            (size(axis.other()), size(axis))
        })
        .filter(|&(thickness, length)| thickness >= THIN_SHARE * hints.depth[0] && thickness < 8.0 && length > 2.0)
        .collect();
    let steps = ((hints.depth[1] - hints.depth[0]) / DEPTH_STEP_M).round() as usize;
    let total: f64 = bodies.iter().map(|(_, length)| length).sum();
    let cost = |depth: f64| {
        let misfits = bodies.iter().map(|&(thickness, length)| {
            let misfit = |layers: usize| {
                let plain = (thickness - layers as f64 * depth).abs();
                plain.min((plain_thickness(layers, depth) - thickness).abs()) / (1.0 + 0.3 * layers as f64)
            };
            length * (1..7).map(misfit).fold(f64::INFINITY, f64::min)
        });
        misfits.sum::<f64>() / total.max(1.0) + DEPTH_PRIOR * (depth - USUAL_DEPTH_M).abs()
    };
    let depths = (0..=steps).map(|step| hints.depth[0] + step as f64 * DEPTH_STEP_M);
    depths.min_by(|&one, &other| cost(one).total_cmp(&cost(other))).unwrap_or(USUAL_DEPTH_M)
}

/// Thickness of so many rows with a flue between every two.
fn plain_thickness(layers: usize, depth: f64) -> f64 {
    layers as f64 * depth + FLUE_M * (layers / 2) as f64
}

/// The rows of a body and what is left beside them, as ranges across its rows.
fn layers(frame: &Frame, block: &Block, axis: Axis, depth: f64) -> (Vec<Range<usize>>, Vec<Range<usize>>) {
    let range = block.rect.range(axis.other()).clone();
    let thickness = range.len() as f64 * frame.cell;
    match block.fronts {
        [true, true] | [false, false] => {
            if thickness < THIN_SHARE * depth {
                return (Vec::new(), vec![range]);
            }
            let misfit = |layers: usize| (plain_thickness(layers, depth) - thickness).abs();
            let count = (1..=MOST_LAYERS).min_by(|&a, &b| misfit(a).total_cmp(&misfit(b))).unwrap_or(1);
            (equal_parts(&range, count), Vec::new())
        }
        [low_front, _] => one_sided(frame, block, axis, depth, low_front),
    }
}

fn equal_parts(range: &Range<usize>, count: usize) -> Vec<Range<usize>> {
    let at = |part: usize| range.start + (range.len() * part + count / 2) / count;
    (0..count).map(|part| at(part)..at(part + 1)).collect()
}

/// The row along the aisle on the one side of a body, before the wall on the other.
fn one_sided(
    frame: &Frame,
    block: &Block,
    axis: Axis,
    depth: f64,
    low_front: bool,
) -> (Vec<Range<usize>>, Vec<Range<usize>>) {
    let range = block.rect.range(axis.other()).clone();
    let patch = frame.patch(&block.rect, axis);
    let occupied: Vec<f64> = (0..patch.height)
        .map(|y| patch.row(y).iter().filter(|cell| cell.is_occupied()).count() as f64 / patch.width.max(1) as f64)
        .collect();
    // The outermost wall; before it there may be a row.
    let is_wall = |&y: &usize| occupied[y] >= WALL_SHARE;
    let wall = if low_front { (0..patch.height).rev().find(is_wall) } else { (0..patch.height).find(is_wall) };
    let room = match wall {
        Some(wall) if low_front => 0..wall,
        Some(wall) => wall + 1..patch.height,
        None => 0..patch.height,
    };
    let row_depth = frame.cells_of(depth).max(1);
    if (room.len() as f64) < THIN_SHARE * row_depth as f64 {
        return (Vec::new(), vec![range]);
    }
    let row_depth = if room.len() as f64 > 1.5 * row_depth as f64 { row_depth } else { room.len() };
    let row = if low_front { room.start..room.start + row_depth } else { room.end - row_depth..room.end };
    let shift = |part: Range<usize>| range.start + part.start..range.start + part.end;
    let rest = if low_front { row.end..patch.height } else { 0..row.start };
    let rests = if rest.is_empty() { Vec::new() } else { vec![shift(rest)] };
    (vec![shift(row)], rests)
}

/// Cuts a row into parcels.
fn comb_row(frame: &Frame, row: &Row, pitch: f64, parcels: &mut Vec<Parcel>) {
    let comb = comb::cut(&row.evidence, pitch);
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
