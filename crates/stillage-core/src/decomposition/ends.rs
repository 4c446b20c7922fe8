//! Where rows end, and where aisles end with them.
//!
//! The comb fills a row from side to side, but the row of goods ends where its last sign does: free pieces beyond it are
//! open floor. A band serves a row along its places only: where it runs on without any, and where there is room for
//! a further aisle beside that of the row, it is open floor as well. Open floor is a [`PlotKind::Lane`], whatever band it
//! was found in.
//!
//! Cost: O(cells of the pieces at the ends + bands x places). Limits: an empty place at the end of a row without a post
//! is given up, since nothing tells it from floor.

use std::collections::BTreeMap;
use std::ops::Range;

use super::frame::{Axis, Cell, Frame, Rect};
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
/// The same at the ends of a block, metres.
const OPEN_END_M: f64 = 0.5;

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
                rows.entry((parcel.stack.start, parcel.stack.end, axis == Axis::V)).or_default().push(parcel);
            }
            _ => ended.push(parcel),
        }
    }
    for ((_, _, is_upright), mut pieces) in rows {
        let axis = if is_upright { Axis::V } else { Axis::U };
        pieces.sort_by_key(|piece| piece.rect.range(axis).start);
        let along = |piece: &Parcel| piece.rect.range(axis).clone();
        for row in pieces.chunk_by(|one, next| along(one) == along(next) || along(one).end == along(next).start) {
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
            let rect = first.rect.with(axis, along).with(axis.other(), first.stack.clone());
            ended.push(Parcel::new(rect, PlotKind::Lane, Some(axis.other())));
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
    let patch = frame.patch(&piece.rect.with(axis, seen).with(axis.other(), piece.stack.clone()), axis);
    let count = |is: fn(Cell) -> bool| patch.cells.iter().filter(|&&cell| is(cell)).count() as f64;
    let occupied = count(Cell::is_occupied) * frame.cell * frame.cell;
    let unknown = count(Cell::is_unknown);
    occupied < LEAST_POST_M2 && unknown <= UNSEEN_SHARE * patch.cells.len() as f64
}

/// Cuts the bands where places stop to lie along them.
fn end_bands(frame: &Frame, parcels: Vec<Parcel>) -> Vec<Parcel> {
    let is_band = |parcel: &Parcel| matches!(parcel.kind, PlotKind::Aisle | PlotKind::Lane);
    let (bands, mut ended): (Vec<Parcel>, Vec<Parcel>) = parcels.into_iter().partition(is_band);
    let mut bands: Vec<Band> = bands.into_iter().map(|band| Band::of(frame, band, &ended)).collect();
    // Bands of one length are those of one block.
    bands.sort_by_key(Band::block);
    for block in bands.chunk_by_mut(|one, other| one.block() == other.block()) {
        let first = block.iter().filter_map(|band| band.served().position(|here| here)).min();
        let last = block.iter().filter_map(|band| band.served().rposition(|here| here)).max();
        if let (Some(first), Some(last)) = (first, last) {
            for band in block {
                band.reach = first..last + 1;
            }
        }
    }
    let stretches: Vec<Stretch> = bands.iter().flat_map(|band| band.stretches(frame)).collect();
    let usual = usual_width(&stretches);
    for stretch in stretches {
        stretch.cut(usual, &mut ended);
    }
    ended
}

/// A band, and where places lie along it.
struct Band {
    rect: Rect,
    axis: Axis,
    /// By line across the band: whether there is a place at its low and at its high side.
    sides: [Vec<bool>; 2],
    /// From the first place to the last one along any band of its block.
    reach: Range<usize>,
}

impl Band {
    fn of(frame: &Frame, band: Parcel, others: &[Parcel]) -> Self {
        let axis = band.axis.unwrap_or(Axis::U);
        let (along, across) = (band.rect.range(axis), band.rect.range(axis.other()));
        let contact = frame.cells_of(CONTACT_M);
        let mut sides = [vec![false; along.len()], vec![false; along.len()]];
        for place in others.iter().filter(|other| other.kind == PlotKind::Place && other.axis == Some(axis)) {
            let (beside, depth) = (place.rect.range(axis), place.rect.range(axis.other()));
            let meets = [depth.end.abs_diff(across.start) <= contact, depth.start.abs_diff(across.end) <= contact];
            let (start, end) = (beside.start.max(along.start), beside.end.min(along.end));
            for (side, _) in sides.iter_mut().zip(meets).filter(|&(_, meets)| meets && start < end) {
                side[start - along.start..end - along.start].fill(true);
            }
        }
        Self { rect: band.rect, axis, sides, reach: 0..0 }
    }

    fn block(&self) -> (bool, usize, usize) {
        let along = self.rect.range(self.axis);
        (self.axis == Axis::V, along.start, along.end)
    }

    fn served(&self) -> impl ExactSizeIterator<Item = bool> + DoubleEndedIterator {
        self.sides[0].iter().zip(&self.sides[1]).map(|(low, high)| *low || *high)
    }

    /// The stretches with and without places.
    fn stretches(&self, frame: &Frame) -> Vec<Stretch> {
        let mut served: Vec<bool> = self.served().collect();
        if served.contains(&true) {
            close_gaps(&mut served[self.reach.clone()], frame.cells_of(OPEN_STRETCH_M));
            close_gaps(&mut served, frame.cells_of(OPEN_END_M));
        }
        let offset = self.rect.range(self.axis).start;
        let mut start = 0;
        let stretch = |run: &[bool]| {
            let range = start..start + run.len();
            start = range.end;
            let is_front = |side: &Vec<bool>| run[0] && side[range.clone()].contains(&true);
            let rect = self.rect.with(self.axis, offset + range.start..offset + range.end);
            Stretch { rect, axis: self.axis, fronts: [is_front(&self.sides[0]), is_front(&self.sides[1])] }
        };
        served.chunk_by(PartialEq::eq).map(stretch).collect()
    }
}

/// Closes the stretches without places that are shorter than `least`.
fn close_gaps(served: &mut [bool], least: usize) {
    let mut start = 0;
    let mut gaps: Vec<Range<usize>> = Vec::new();
    for run in served.chunk_by(PartialEq::eq) {
        if !run[0] && run.len() < least {
            gaps.push(start..start + run.len());
        }
        start += run.len();
    }
    for gap in gaps {
        served[gap].fill(true);
    }
}

/// A stretch of a band, and whether places lie along its low and its high side.
struct Stretch {
    rect: Rect,
    axis: Axis,
    fronts: [bool; 2],
}

/// Width of the band at the middle of the length of all bands with places on both sides.
fn usual_width(stretches: &[Stretch]) -> Option<usize> {
    let size =
        |stretch: &Stretch| (stretch.rect.range(stretch.axis.other()).len(), stretch.rect.range(stretch.axis).len());
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
    fn cut(self, usual: Option<usize>, parcels: &mut Vec<Parcel>) {
        let across = self.axis.other();
        let range = self.rect.range(across).clone();
        let mut part = |part: Range<usize>, kind: PlotKind| {
            parcels.push(Parcel::new(self.rect.with(across, part), kind, Some(self.axis)));
        };
        let aisles = usual.map_or(0, |width| width * self.fronts.iter().filter(|&&is_front| is_front).count());
        match (self.fronts, usual) {
            ([false, false], _) => part(range, PlotKind::Lane),
            ([low, high], Some(width)) if range.len() >= aisles + width => {
                let [start, end] = [low, high].map(|is_front| if is_front { width } else { 0 });
                let floor = range.start + start..range.end - end;
                for aisle in [range.start..floor.start, floor.end..range.end] {
                    if !aisle.is_empty() {
                        part(aisle, PlotKind::Aisle);
                    }
                }
                part(floor, PlotKind::Lane);
            }
            _ => part(range, PlotKind::Aisle),
        }
    }
}
