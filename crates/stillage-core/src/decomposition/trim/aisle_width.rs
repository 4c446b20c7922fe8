//! How much of a band is aisle: what is left beside the aisles of its rows is open floor where there is room for more.
//!
//! How wide an aisle is, the bands with places on both sides tell. On which side of it the rest lies, the rows of the other
//! blocks do, or else which of its two rows has no other aisle. A band with room for two aisles and nothing else is two,
//! each as long as its own row.
//!
//! Cost: O(bands x places). Limits: a band between a row and a wall is all aisle, up to twice as wide as others.

use std::cmp::Ordering;
use std::ops::Range;

use super::aisle_bands::{CONTACT_M, GROUND_SHARE, closed};
use crate::decomposition::ground::{Axis, Cell, Rect, RegionFrame};
use crate::decomposition::plot::{Parcel, PlotKind};

/// What is left beside an aisle is open floor from this width on, metres: the depth of a row that is missing.
const OPEN_STRIP_M: f64 = 1.0;
/// Where the ground behind a row begins and ends, metres.
const BEHIND_M: [f64; 2] = [0.3, 1.1];
/// Two aisles side by side may be so much narrower than two usual ones.
const TWO_AISLES_SHARE: f64 = 0.85;

/// Cuts stretches of bands, `ended` being all other parcels, and adds their parts.
pub(super) fn cut(frame: &RegionFrame, stretches: Vec<BandSection>, ended: &mut Vec<Parcel>) {
    let mut parts = Vec::new();
    if let Some(width) = usual_width(&stretches) {
        let aisles = UsualAisle { width, strip: frame.cells_of(OPEN_STRIP_M), borders: PlaceBorders::of(frame, ended) };
        for stretch in stretches {
            aisles.cut(frame, ended, stretch, &mut parts);
        }
    } else {
        parts.extend(stretches.into_iter().map(BandSection::whole));
    }
    ended.extend(parts);
}

/// A stretch of a band: whether places lie along its low and its high side, or the site ends there.
pub(super) struct BandSection {
    pub rect: Rect,
    pub axis: Axis,
    /// The same by line.
    pub sides: [Vec<bool>; 2],
    pub fronts: [bool; 2],
    pub walls: [bool; 2],
}

impl BandSection {
    fn across(&self) -> Range<usize> {
        self.rect.range(self.axis.other()).clone()
    }

    fn part(&self, across: Range<usize>, kind: PlotKind) -> Parcel {
        Parcel::new(self.rect.with(self.axis.other(), across), kind, Some(self.axis))
    }

    /// One aisle, and open floor on both sides of it.
    fn one_aisle(&self, aisle: Range<usize>, parcels: &mut Vec<Parcel>) {
        let across = self.across();
        for floor in [across.start..aisle.start, aisle.end..across.end] {
            if !floor.is_empty() {
                parcels.push(self.part(floor, PlotKind::OpenFloor));
            }
        }
        parcels.push(self.part(aisle, PlotKind::Aisle));
    }

    /// The aisle of the row on one side, as long as the row.
    fn aisle(&self, frame: &RegionFrame, across: Range<usize>, side: usize, parcels: &mut Vec<Parcel>) {
        let served = self.sides[side].clone();
        let reach = 0..served.iter().rposition(|&here| here).map_or(0, |last| last + 1);
        let reach = served.iter().position(|&here| here).unwrap_or(reach.end)..reach.end;
        let mut start = self.rect.range(self.axis).start;
        for run in closed(frame, served, &reach).chunk_by(PartialEq::eq) {
            let part = self.part(across.clone(), if run[0] { PlotKind::Aisle } else { PlotKind::OpenFloor });
            let along = start..start + run.len();
            start = along.end;
            parcels.push(Parcel { rect: part.rect.with(self.axis, along), ..part });
        }
    }

    /// How much the rows at the low and the high side need an aisle here: most with no way to their other side, less with
    /// more rows there, least with open floor.
    fn needs(&self, frame: &RegionFrame, rows: &[Parcel]) -> [AisleNeed; 2] {
        let contact = frame.cells_of(CONTACT_M);
        let (along, across) = (self.rect.range(self.axis), self.across());
        let meets = |place: &Rect| {
            let (beside, depth) = (place.range(self.axis), place.range(self.axis.other()));
            let is_beside = beside.start < along.end && along.start < beside.end;
            [depth.end.abs_diff(across.start), depth.start.abs_diff(across.end)]
                .map(|distance| is_beside && distance <= contact)
        };
        let is_place = |one: &&Parcel| one.kind == PlotKind::Place && one.axis == Some(self.axis);
        let places: Vec<&Rect> = rows.iter().filter(is_place).map(|place| &place.rect).collect();
        let mut lengths = [[0; 3]; 2];
        for place in &places {
            for side in (0..2).filter(|&side| meets(place)[side]) {
                let need = AisleNeed::of(frame, place, self.axis, side, &places);
                lengths[side][need as usize] += place.range(self.axis).len();
            }
        }
        lengths.map(|[none, some, all]| {
            if all >= none + some {
                AisleNeed::All
            } else if none >= some {
                AisleNeed::None
            } else {
                AisleNeed::Some
            }
        })
    }

    /// All of it is what places along it say.
    fn whole(self) -> Parcel {
        let kind = if self.fronts == [false; 2] { PlotKind::OpenFloor } else { PlotKind::Aisle };
        self.part(self.across(), kind)
    }
}

/// How much a row needs the aisle on one of its sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum AisleNeed {
    /// Its other side is open floor.
    None,
    /// Other rows stand behind it.
    Some,
    /// Nothing leads to its other side.
    All,
}

impl AisleNeed {
    /// By what lies behind a place at the low or high side of a band, and behind the places there.
    fn of(frame: &RegionFrame, place: &Rect, axis: Axis, side: usize, places: &[&Rect]) -> Self {
        let beside = |rect: &Rect| {
            let [low, high] = frame.beside(rect, axis, BEHIND_M.map(|metres| frame.cells_of(metres)));
            if side == 0 { low } else { high }
        };
        let touches = |one: &Range<usize>, other: &Range<usize>| one.start < other.end && other.start < one.end;
        let holds =
            |strip: &Rect, place: &Rect| Axis::BOTH.iter().all(|&axis| touches(place.range(axis), strip.range(axis)));
        let mut behind = beside(place);
        let mut need = Self::None;
        // The strips only ever move away from the band.
        while let Some(next) = places.iter().find(|place| holds(&behind, place)) {
            (behind, need) = (beside(next), Self::Some);
        }
        if frame.share(&behind, Cell::is_drivable) >= GROUND_SHARE { need } else { Self::All }
    }
}

/// Width of the band at the middle of the length of all bands with places on both sides.
fn usual_width(stretches: &[BandSection]) -> Option<usize> {
    let size = |stretch: &BandSection| (stretch.across().len(), stretch.rect.range(stretch.axis).len());
    let mut sizes: Vec<(usize, usize)> = stretches.iter().filter(|of| of.fronts == [true; 2]).map(size).collect();
    sizes.sort_unstable();
    let whole: usize = sizes.iter().map(|(_, length)| length).sum();
    let mut passed = 0;
    let middle = sizes.iter().find(|(_, length)| {
        passed += length;
        2 * passed >= whole
    });
    middle.map(|&(width, _)| width)
}

/// Lengths of places by the lines that bound them along the rows, for both directions.
struct PlaceBorders {
    lengths: [Vec<usize>; 2],
    contact: usize,
}

impl PlaceBorders {
    fn of(frame: &RegionFrame, parcels: &[Parcel]) -> Self {
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
struct UsualAisle {
    width: usize,
    /// What is left beside an aisle is open floor from this width on.
    strip: usize,
    borders: PlaceBorders,
}

impl UsualAisle {
    /// Cuts what lies beyond the reach of the aisles off a stretch.
    fn cut(&self, frame: &RegionFrame, rows: &[Parcel], stretch: BandSection, parcels: &mut Vec<Parcel>) {
        let across = stretch.across();
        let (start, end, width) = (across.start, across.end, self.width);
        let has_room = |aisles: usize, more: usize| across.len() >= aisles * width + more;
        let is_two = across.len() as f64 >= 2.0 * TWO_AISLES_SHARE * width as f64;
        let room_before_wall = |is_wall: bool| if is_wall { width } else { self.strip };
        match stretch.fronts {
            [true, true] if has_room(2, self.strip) => {
                stretch.aisle(frame, start..start + width, 0, parcels);
                parcels.push(stretch.part(start + width..end - width, PlotKind::OpenFloor));
                stretch.aisle(frame, end - width..end, 1, parcels);
            }
            [true, true] if has_room(1, self.strip) => match self.only_side(frame, rows, &stretch) {
                Some(0) => stretch.one_aisle(start..start + width, parcels),
                Some(_) => stretch.one_aisle(end - width..end, parcels),
                None if is_two => {
                    let middle = start.midpoint(end);
                    stretch.aisle(frame, start..middle, 0, parcels);
                    stretch.aisle(frame, middle..end, 1, parcels);
                }
                None => parcels.push(stretch.whole()),
            },
            [true, false] if has_room(1, room_before_wall(stretch.walls[1])) => {
                stretch.one_aisle(start..start + width, parcels);
            }
            [false, true] if has_room(1, room_before_wall(stretch.walls[0])) => {
                stretch.one_aisle(end - width..end, parcels);
            }
            _ => parcels.push(stretch.whole()),
        }
    }

    /// On which side the only aisle of a stretch with places on both sides lies, if anything tells.
    fn only_side(&self, frame: &RegionFrame, rows: &[Parcel], stretch: &BandSection) -> Option<usize> {
        let across = stretch.across();
        let far_sides = [across.start + self.width, across.end - self.width];
        let [beside_low, beside_high] = far_sides.map(|line| self.borders.at(stretch.axis, line));
        let needs = stretch.needs(frame, rows);
        match (beside_low, needs[0]).cmp(&(beside_high, needs[1])) {
            Ordering::Greater => Some(0),
            Ordering::Less => Some(1),
            Ordering::Equal => None,
        }
    }
}
