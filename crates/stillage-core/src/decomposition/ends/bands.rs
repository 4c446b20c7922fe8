//! Aisles end where the places along them do.
//!
//! A band serves a row along its places only: where it runs on without any it is open floor, and so is what is left of
//! it beside the aisles of its rows where there is room for more: a row that is missing, or a lane before a row. How
//! wide an aisle is, the bands with places on both sides tell; on which side the rest lies, the rows of the other
//! blocks.
//!
//! Cost: O(bands x places). Limits: a band between a row and a wall is all aisle, up to twice as wide as others.

use std::ops::Range;

use super::super::frame::{Axis, Cell, Frame, Rect};
use super::super::{Parcel, PlotKind};

/// Places and band meet within this, metres.
const CONTACT_M: f64 = 0.8;
/// A stretch of a band without places is open floor from this length on, metres: narrower, it is an empty place or two.
const OPEN_STRETCH_M: f64 = 1.9;
/// The same at the ends of a block, metres.
const OPEN_END_M: f64 = 0.5;
/// What is left beside an aisle is open floor from this width on, metres: the depth of a row that is missing.
const OPEN_STRIP_M: f64 = 1.0;
/// Where the ground ends that lies beyond the side of a band, metres, and the share of it that must be in the site.
const BEYOND_M: [f64; 2] = [0.3, 0.8];
const GROUND_SHARE: f64 = 0.5;

/// Cuts the bands where places stop to lie along them.
pub(super) fn end(frame: &Frame, parcels: Vec<Parcel>) -> Vec<Parcel> {
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
    if let Some(width) = usual_width(&stretches) {
        let aisles = Aisles { width, strip: frame.cells_of(OPEN_STRIP_M), borders: Borders::of(frame, &ended) };
        for stretch in stretches {
            aisles.cut(stretch, &mut ended);
        }
    } else {
        ended.extend(stretches.into_iter().map(Stretch::whole));
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
            let fronts = [is_front(&self.sides[0]), is_front(&self.sides[1])];
            Stretch { walls: walls(frame, &rect, self.axis), rect, axis: self.axis, fronts }
        };
        served.chunk_by(PartialEq::eq).map(stretch).collect()
    }
}

/// Whether the site ends at the low and at the high side of a band.
fn walls(frame: &Frame, rect: &Rect, axis: Axis) -> [bool; 2] {
    let beyond = frame.beside(rect, axis, BEYOND_M.map(|metres| frame.cells_of(metres)));
    beyond.map(|strip| frame.share(&strip, Cell::is_inside) < GROUND_SHARE)
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

/// A stretch of a band: whether places lie along its low and its high side, or the site ends there.
struct Stretch {
    rect: Rect,
    axis: Axis,
    fronts: [bool; 2],
    walls: [bool; 2],
}

impl Stretch {
    fn across(&self) -> Range<usize> {
        self.rect.range(self.axis.other()).clone()
    }

    fn part(&self, across: Range<usize>, kind: PlotKind) -> Parcel {
        Parcel::new(self.rect.with(self.axis.other(), across), kind, Some(self.axis))
    }

    /// All of it is what places along it say.
    fn whole(self) -> Parcel {
        let kind = if self.fronts == [false; 2] { PlotKind::Lane } else { PlotKind::Aisle };
        self.part(self.across(), kind)
    }
}

/// Width of the band at the middle of the length of all bands with places on both sides.
fn usual_width(stretches: &[Stretch]) -> Option<usize> {
    let size = |stretch: &Stretch| (stretch.across().len(), stretch.rect.range(stretch.axis).len());
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

/// Lengths of places by the lines that bound them along the rows, for both directions.
struct Borders {
    lengths: [Vec<usize>; 2],
    contact: usize,
}

impl Borders {
    fn of(frame: &Frame, parcels: &[Parcel]) -> Self {
        let lengths = Axis::BOTH.map(|axis| {
            let mut lengths = vec![0; frame.whole().range(axis.other()).end + 1];
            for place in parcels.iter().filter(|one| one.kind == PlotKind::Place && one.axis == Some(axis)) {
                let across = place.rect.range(axis.other());
                for border in [across.start, across.end] {
                    lengths[border] += place.rect.range(axis).len();
                }
            }
            lengths
        });
        Self { lengths, contact: frame.cells_of(CONTACT_M) }
    }

    /// Length of the places with a border about there.
    fn at(&self, axis: Axis, line: usize) -> usize {
        let lengths = &self.lengths[usize::from(axis == Axis::V)];
        lengths[line.saturating_sub(self.contact)..(line + self.contact + 1).min(lengths.len())].iter().sum()
    }
}

/// What is known of the aisles of a region.
struct Aisles {
    width: usize,
    /// What is left beside an aisle is open floor from this width on.
    strip: usize,
    borders: Borders,
}

impl Aisles {
    /// Cuts what lies beyond the reach of the aisles off a stretch.
    fn cut(&self, stretch: Stretch, parcels: &mut Vec<Parcel>) {
        let across = stretch.across();
        let Some(floor) = self.floor(&stretch).filter(|floor| !floor.is_empty()) else {
            parcels.push(stretch.whole());
            return;
        };
        for aisle in [across.start..floor.start, floor.end..across.end] {
            if !aisle.is_empty() {
                parcels.push(stretch.part(aisle, PlotKind::Aisle));
            }
        }
        parcels.push(stretch.part(floor, PlotKind::Lane));
    }

    /// The part of a stretch that no aisle needs.
    fn floor(&self, stretch: &Stretch) -> Option<Range<usize>> {
        let across = stretch.across();
        let has_room = |aisles: usize, more: usize| across.len() >= aisles * self.width + more;
        match stretch.fronts {
            [true, true] if has_room(2, self.strip) => Some(across.start + self.width..across.end - self.width),
            [true, true] if has_room(1, self.strip) => {
                let floors = [across.start..across.end - self.width, across.start + self.width..across.end];
                let [low, high] = [floors[0].end, floors[1].start].map(|line| self.borders.at(stretch.axis, line));
                let [below, above] = floors;
                (low != high).then_some(if low > high { below } else { above })
            }
            [true, false] if has_room(1, if stretch.walls[1] { self.width } else { self.strip }) => {
                Some(across.start + self.width..across.end)
            }
            [false, true] if has_room(1, if stretch.walls[0] { self.width } else { self.strip }) => {
                Some(across.start..across.end - self.width)
            }
            _ => None,
        }
    }
}
