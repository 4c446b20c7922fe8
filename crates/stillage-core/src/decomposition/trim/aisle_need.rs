//! How much a row needs the aisle on one of its sides, by what lies on its other side.
//!
//! From a place the ground behind it is looked at: another place that stands there is stepped to, until there is none.
//! Where no way leads to the last one from behind, the row has no other aisle. A strip behind a place always lies further
//! from the aisle than the one before, and a step depends on the place and the side only, so every place is stepped from
//! once: O(places) in all.

use super::band_section::{BandSection, GROUND_SHARE};
use super::place_index::PlaceIndex;
use crate::decomposition::ground::{Cell, Rect, RegionFrame};
use crate::watch::{Stopped, Watch};

/// Where the ground behind a row begins and ends, metres from the row.
const BEHIND_M: [f64; 2] = [0.3, 1.1];

/// How much a row needs the aisle on one of its sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum AisleNeed {
    /// Its other side is open floor.
    OpenBehind,
    /// Other rows stand behind it, the last of them before open floor.
    RowsBehind,
    /// Nothing leads to its other side.
    NoOtherAccess,
}

/// What the places of one direction need, found place by place and kept.
pub(super) struct AisleNeeds<'a> {
    frame: &'a RegionFrame,
    index: &'a PlaceIndex,
    watch: &'a Watch<'a>,
    /// By side of the aisle that the place lies along, low or high, and by place.
    known: [Vec<Option<AisleNeed>>; 2],
}

impl<'a> AisleNeeds<'a> {
    pub fn new(frame: &'a RegionFrame, index: &'a PlaceIndex, watch: &'a Watch<'a>) -> Self {
        let unknown = || vec![None; index.places.rects().len()];
        Self { frame, index, watch, known: [unknown(), unknown()] }
    }

    /// What the rows along the low and the high side of a section need, by the length of their places.
    pub fn of_section(&mut self, section: &BandSection) -> Result<[AisleNeed; 2], Stopped> {
        let along = self.index.along(&section.rect);
        let mut lengths = [[0; 3]; 2];
        for (side, places) in along.into_iter().enumerate() {
            for place in places {
                let need = self.of_place(place, side)?;
                lengths[side][need as usize] += self.rect(place).range(section.axis).len();
            }
        }
        Ok(lengths.map(|[open, rows, no_other]| {
            if no_other >= open + rows {
                AisleNeed::NoOtherAccess
            } else if open >= rows {
                AisleNeed::OpenBehind
            } else {
                AisleNeed::RowsBehind
            }
        }))
    }

    /// What a place at the low or high side of an aisle needs.
    fn of_place(&mut self, first: usize, side: usize) -> Result<AisleNeed, Stopped> {
        let mut steps = Vec::new();
        let mut place = first;
        let mut need = loop {
            self.watch.check()?;
            if let Some(known) = self.known[side][place] {
                break known;
            }
            let behind = self.behind(place, side);
            if let Some(&next) = self.index.places.overlapping(&behind).first() {
                steps.push(place);
                place = next;
            } else {
                let is_open = self.frame.share(&behind, Cell::is_drivable) >= GROUND_SHARE;
                let need = if is_open { AisleNeed::OpenBehind } else { AisleNeed::NoOtherAccess };
                self.known[side][place] = Some(need);
                break need;
            }
        };
        for place in steps.into_iter().rev() {
            need = need.max(AisleNeed::RowsBehind);
            self.known[side][place] = Some(need);
        }
        Ok(need)
    }

    /// The strip behind a place, away from an aisle at whose low or high side it lies.
    fn behind(&self, place: usize, side: usize) -> Rect {
        let distances = BEHIND_M.map(|metres| self.frame.cells_of(metres));
        let [low, high] = self.frame.beside(self.rect(place), self.index.axis, distances);
        if side == 0 { low } else { high }
    }

    fn rect(&self, place: usize) -> &Rect {
        &self.index.places.rects()[place]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::decomposition::ground::{Axis, RectIndex, drivable};
    use crate::watch::{Observer, Stage, StopFlag};

    /// The same step by step from one place, as often as it is asked for.
    fn simple(frame: &RegionFrame, places: &[Rect], place: &Rect, axis: Axis, side: usize) -> AisleNeed {
        let behind =
            |rect: &Rect| frame.beside(rect, axis, BEHIND_M.map(|metres| frame.cells_of(metres)))[side].clone();
        let meet = |one: &Rect, other: &Rect| {
            Axis::BOTH.iter().all(|&axis| {
                let (one, other) = (one.range(axis), other.range(axis));
                one.start < other.end && other.start < one.end
            })
        };
        let (mut strip, mut need) = (behind(place), AisleNeed::OpenBehind);
        while let Some(next) = places.iter().find(|place| meet(&strip, place)) {
            (strip, need) = (behind(next), AisleNeed::RowsBehind);
        }
        let is_open = frame.share(&strip, Cell::is_drivable) >= GROUND_SHARE;
        if is_open { need } else { AisleNeed::NoOtherAccess }
    }

    proptest! {
        #[test]
        fn places_need_what_a_step_by_step_walk_finds(
            picture in proptest::collection::vec("[.#]{12}", 12),
            places in proptest::collection::vec((0_usize..90, 1_usize..30, 0_usize..90, 1_usize..30), 0..40),
            is_upright: bool,
        ) {
            // Cells of 0.05 m, eight to the side of a character.
            let wide = |line: &String| (line.chars().flat_map(|cell| [cell; 8]).collect::<String>() + "\n").repeat(8);
            let (mut frame, whole) = RegionFrame::of_picture(&picture.iter().map(wide).collect::<String>(), 0.05);
            drivable::mark(&mut frame, 0.3, &Watch::unwatched()).expect("nobody stops it");
            let rects: Vec<Rect> = places.into_iter().map(|(u, width, v, height)| {
                let (u, v) = (whole.u.start + u, whole.v.start + v);
                Rect { u: u..(u + width).min(frame.columns), v: v..(v + height).min(frame.rows) }
            }).collect();
            let (axis, watch) = (if is_upright { Axis::V } else { Axis::U }, Watch::unwatched());
            let places = RectIndex::of(rects.clone(), &watch).expect("nobody stops it");
            let index = PlaceIndex { axis, contact: 8, places };
            let mut needs = AisleNeeds::new(&frame, &index, &watch);
            for (place, rect) in rects.iter().enumerate() {
                for side in 0..2 {
                    let found = needs.of_place(place, side).expect("nobody stops it");
                    prop_assert_eq!(found, simple(&frame, &rects, rect, axis, side));
                }
            }
        }
    }

    /// A block of 50,000 places, 4 cells wide and 16 deep, with 1.2 m of floor all around.
    fn block_of_places() -> (RegionFrame, Vec<Rect>) {
        let (columns, layers) = (250, 200);
        let beside = ".".repeat(24);
        let goods = format!("{beside}{}{beside}\n", "#".repeat(4 * columns));
        let floor = (".".repeat(4 * columns + 48) + "\n").repeat(24);
        let (mut frame, whole) =
            RegionFrame::of_picture(&[&floor[..], &goods.repeat(16 * layers), &floor].concat(), 0.05);
        drivable::mark(&mut frame, 0.6, &Watch::unwatched()).expect("nobody stops it");
        let place = |number: usize| {
            let (u, v) = (whole.u.start + 24 + number % columns * 4, whole.v.start + 24 + number / columns * 16);
            Rect { u: u..u + 4, v: v..v + 16 }
        };
        (frame, (0..columns * layers).map(place).collect())
    }

    struct Nobody;

    impl Observer for Nobody {
        fn progress(&self, _stage: Stage, _fraction: f64) {}
    }

    #[test]
    fn each_of_fifty_thousand_places_is_stepped_from_once() {
        let (frame, rects) = block_of_places();
        let places = RectIndex::of(rects, &Watch::unwatched()).expect("nobody stops it");
        let index = PlaceIndex { axis: Axis::U, contact: 16, places };
        let (stop, count) = (StopFlag::default(), index.places.rects().len());
        let watch = Watch::new(&stop, &Nobody);
        let mut needs = AisleNeeds::new(&frame, &index, &watch);
        // The first place of a column is stepped from through all 200 layers, and these are known from then on.
        let from_low = |needs: &mut AisleNeeds<'_>, place: usize| needs.of_place(place, 1);
        assert_eq!(from_low(&mut needs, 0), Ok(AisleNeed::RowsBehind));
        assert_eq!(needs.known[1].iter().flatten().count(), 200);
        for place in 0..count - 1 {
            assert_eq!(
                from_low(&mut needs, place),
                Ok(if place < count - 250 { AisleNeed::RowsBehind } else { AisleNeed::OpenBehind })
            );
        }
        stop.raise();
        assert_eq!(from_low(&mut needs, count - 1), Err(Stopped));
    }
}
