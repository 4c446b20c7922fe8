//! Where rows end, and where aisles end with them.
//!
//! The comb fills a row from side to side, but the row of goods ends where its last sign does: free pieces beyond it are
//! open floor. A band serves a row along its places only: where it runs on without any, and where it is far wider than
//! aisles are, it is open floor as well. Open floor is a [`PlotKind::Lane`], whatever band it was found in.
//!
//! Cost: O(cells of the pieces at the ends + bands x places). Limits: an empty place at the end of a row without a post
//! is given up, since nothing tells it from floor.

use std::collections::BTreeMap;
use std::ops::Range;

use super::frame::{Axis, Frame, Rect};
use super::{Parcel, PlotKind};

/// What reaches this far into a piece from its inner neighbour is the neighbour's: overhang and drift, metres.
const OVERHANG_M: f64 = 0.25;
/// A post at the outer border of a piece may stand so far beyond it, metres.
const POST_REACH_M: f64 = 0.1;
/// Less than this is no post, square metres: two cells of 5 cm.
const LEAST_POST_M2: f64 = 0.005;
/// A piece with more of it unknown than this may hold anything.
const UNSEEN_SHARE: f64 = 0.2;
/// Places and band meet within this, metres.
const CONTACT_M: f64 = 0.3;
/// A stretch of a band without places is open floor from this length on, metres: narrower, it is an empty place or two.
const OPEN_STRETCH_M: f64 = 1.9;
/// At the ends of a band, metres: what rows of a block differ in length.
const OPEN_END_M: f64 = 0.5;
/// A band so many times as wide as the usual aisle is an aisle and open floor beside it.
const WIDE: f64 = 1.5;

/// Ends rows and bands where their signs end.
pub(super) fn end(frame: &Frame, parcels: Vec<Parcel>) -> Vec<Parcel> {
    let parcels = end_rows(frame, parcels);
    end_bands(frame, parcels)
}

/// Makes open floor of the bare pieces at both ends of every row.
fn end_rows(frame: &Frame, parcels: Vec<Parcel>) -> Vec<Parcel> {
    let mut rows: BTreeMap<(usize, usize, bool), Vec<Parcel>> = BTreeMap::new();
    let mut ended = Vec::new();
    for parcel in parcels {
        match parcel.axis {
            Some(axis) if parcel.kind != PlotKind::Aisle && parcel.kind != PlotKind::Lane => {
                let across = parcel.rect.range(axis.other());
                rows.entry((across.start, across.end, axis == Axis::V)).or_default().push(parcel);
            }
            _ => ended.push(parcel),
        }
    }
    for ((_, _, is_upright), mut pieces) in rows {
        let axis = if is_upright { Axis::V } else { Axis::U };
        pieces.sort_by_key(|piece| piece.rect.range(axis).start);
        for row in pieces.chunk_by(|one, next| one.rect.range(axis).end == next.rect.range(axis).start) {
            end_row(frame, row, axis, &mut ended);
        }
    }
    ended
}

fn end_row(frame: &Frame, row: &[Parcel], axis: Axis, ended: &mut Vec<Parcel>) {
    if row.iter().all(|piece| piece.kind != PlotKind::Place) {
        ended.extend(row.iter().cloned());
        return;
    }
    let low = row.iter().take_while(|piece| is_bare(frame, piece, axis, true)).count();
    let high = row[low..].iter().rev().take_while(|piece| is_bare(frame, piece, axis, false)).count();
    let (before, rest) = row.split_at(low);
    let (within, after) = rest.split_at(rest.len() - high);
    ended.extend(within.iter().cloned());
    for floor in [before, after] {
        if let [first, .., last] | [first @ last] = floor {
            let along = first.rect.range(axis).start..last.rect.range(axis).end;
            ended.push(Parcel::new(first.rect.with(axis, along), PlotKind::Lane, Some(axis.other())));
        }
    }
}

/// Whether nothing shows a piece that the row ends with, on its low or high side.
fn is_bare(frame: &Frame, piece: &Parcel, axis: Axis, is_low: bool) -> bool {
    let along = piece.rect.range(axis);
    let (reach, overhang) = (frame.cells_of(POST_REACH_M), frame.cells_of(OVERHANG_M).min(along.len() / 2));
    let most = frame.whole().range(axis).end;
    let seen = if is_low {
        along.start.saturating_sub(reach)..along.end - overhang
    } else {
        along.start + overhang..(along.end + reach).min(most)
    };
    let patch = frame.patch(&piece.rect.with(axis, seen), axis);
    let count = |is: fn(super::frame::Cell) -> bool| patch.cells.iter().filter(|&&cell| is(cell)).count() as f64;
    let occupied = count(|cell| cell.is_occupied()) * frame.cell * frame.cell;
    let unknown = count(|cell| cell.is_unknown());
    occupied < LEAST_POST_M2 && unknown <= UNSEEN_SHARE * patch.cells.len() as f64
}

/// Cuts the bands where places stop to lie along them.
fn end_bands(frame: &Frame, parcels: Vec<Parcel>) -> Vec<Parcel> {
    let is_band = |parcel: &Parcel| matches!(parcel.kind, PlotKind::Aisle | PlotKind::Lane);
    let (bands, mut ended): (Vec<Parcel>, Vec<Parcel>) = parcels.into_iter().partition(is_band);
    let stretches: Vec<Stretch> = bands.iter().flat_map(|band| stretches(frame, band, &ended)).collect();
    let usual = usual_width(&stretches);
    for stretch in stretches {
        stretch.cut(usual, frame.cells_of(OPEN_STRETCH_M), &mut ended);
    }
    ended
}

/// A stretch of a band, and whether places lie along its low and its high side.
struct Stretch {
    rect: Rect,
    axis: Axis,
    fronts: [bool; 2],
}

/// The stretches of a band with and without places.
fn stretches(frame: &Frame, band: &Parcel, others: &[Parcel]) -> Vec<Stretch> {
    let axis = band.axis.unwrap_or(Axis::U);
    let (along, across) = (band.rect.range(axis), band.rect.range(axis.other()));
    let contact = frame.cells_of(CONTACT_M);
    let mut sides = [vec![false; along.len()], vec![false; along.len()]];
    for place in others.iter().filter(|other| other.kind == PlotKind::Place && other.axis == Some(axis)) {
        let (beside, depth) = (place.rect.range(axis), place.rect.range(axis.other()));
        let meets = [depth.end.abs_diff(across.start) <= contact, depth.start.abs_diff(across.end) <= contact];
        let (start, end) = (beside.start.max(along.start), beside.end.min(along.end));
        for (side, _) in sides.iter_mut().zip(meets).filter(|&(_, meets)| meets) {
            if start < end {
                side[start - along.start..end - along.start].fill(true);
            }
        }
    }
    let mut served: Vec<bool> = sides[0].iter().zip(&sides[1]).map(|(low, high)| *low || *high).collect();
    close(&mut served, frame.cells_of(OPEN_STRETCH_M), frame.cells_of(OPEN_END_M));
    let mut start = 0;
    let mut found = Vec::new();
    for run in served.chunk_by(PartialEq::eq) {
        let range = start..start + run.len();
        start = range.end;
        let lies_along = |side: &Vec<bool>| 2 * side[range.clone()].iter().filter(|&&here| here).count() > run.len();
        let fronts = if run[0] { [lies_along(&sides[0]), lies_along(&sides[1])] } else { [false; 2] };
        let fronts = if run[0] && fronts == [false; 2] { [true; 2] } else { fronts };
        let rect = band.rect.with(axis, along.start + range.start..along.start + range.end);
        found.push(Stretch { rect, axis, fronts });
    }
    found
}

/// Closes short stretches without places between others, and at the ends.
fn close(served: &mut [bool], between: usize, at_end: usize) {
    let mut start = 0;
    let runs: Vec<(Range<usize>, bool)> = served
        .chunk_by(PartialEq::eq)
        .map(|run| {
            let range = start..start + run.len();
            start = range.end;
            (range, run[0])
        })
        .collect();
    if runs.len() > 1 {
        for (range, is_served) in runs {
            let least = if range.start == 0 || range.end == served.len() { at_end } else { between };
            if !is_served && range.len() < least {
                served[range].fill(true);
            }
        }
    }
}

/// Width of the band at the middle of the length of all bands with places on both sides.
fn usual_width(stretches: &[Stretch]) -> Option<usize> {
    let size = |stretch: &Stretch| {
        (stretch.rect.range(stretch.axis.other()).len(), stretch.rect.range(stretch.axis).len())
    };
    let mut sizes: Vec<(usize, usize)> = stretches.iter().filter(|of| of.fronts == [true; 2]).map(size).collect();
    sizes.sort_unstable();
    let half = sizes.iter().map(|(_, length)| length).sum::<usize>() / 2;
    let mut passed = 0;
    let middle = sizes.iter().find(|(_, length)| {
        passed += length;
        passed > half
    });
    middle.map(|&(width, _)| width)
}

impl Stretch {
    /// Cuts what lies beyond the reach of an aisle off a stretch that is too wide for one.
    fn cut(self, usual: Option<usize>, least: usize, parcels: &mut Vec<Parcel>) {
        let across = self.axis.other();
        let range = self.rect.range(across).clone();
        let aisle = |part: Range<usize>| Parcel::new(self.rect.with(across, part), PlotKind::Aisle, Some(self.axis));
        let floor = |part: Range<usize>| Parcel::new(self.rect.with(across, part), PlotKind::Lane, Some(self.axis));
        let width = usual.unwrap_or(range.len());
        let sides = usize::from(self.fronts[0]) + usize::from(self.fronts[1]);
        if sides == 0 {
            parcels.push(floor(range));
            return;
        }
        let is_wide = range.len() as f64 > WIDE * (width * sides) as f64 && range.len() >= width * sides + least;
        if !is_wide {
            parcels.push(aisle(range));
            return;
        }
        let start = if self.fronts[0] { range.start + width } else { range.start };
        let end = if self.fronts[1] { range.end - width } else { range.end };
        if self.fronts[0] {
            parcels.push(aisle(range.start..start));
        }
        parcels.push(floor(start..end));
        if self.fronts[1] {
            parcels.push(aisle(end..range.end));
        }
    }
}
