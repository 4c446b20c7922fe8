//! Aisles end where the places along them do.
//!
//! A band serves a row along its places only, and on beside what nobody saw: a row ends where it is seen to end. Where a
//! band runs on without any row it is open floor, and so is what is left of it beside the aisles of its rows where there
//! is room for more: a row that is missing, or a lane before a row. How wide an aisle is, the bands with places on both
//! sides tell. On which side the rest lies, the rows of the other blocks do, or else which of its two rows has no other
//! aisle. A band with room for two aisles and nothing else is two, each as long as its own row.
//!
//! Cost: O(bands x places). Limits: a band between a row and a wall is all aisle, up to twice as wide as others.

use std::cmp::Ordering;
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
/// Where the ground ends that lies beyond the side of a band, metres, and the share of it that must be in the site, or
/// free.
const BEYOND_M: [f64; 2] = [0.3, 0.8];
const GROUND_SHARE: f64 = 0.5;
/// The same behind a row.
const BEHIND_M: [f64; 2] = [0.3, 1.1];
/// Two aisles side by side may be so much narrower than two usual ones.
const TWO_AISLES_SHARE: f64 = 0.85;

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
        let mut parts = Vec::new();
        for stretch in stretches {
            aisles.cut(frame, &ended, stretch, &mut parts);
        }
        ended.extend(parts);
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
        let beyond = frame.beside(&band.rect, axis, BEYOND_M.map(|metres| frame.cells_of(metres)));
        for (side, strip) in sides.iter_mut().zip(beyond) {
            let free = frame.counts(&strip, axis.other(), Cell::is_free);
            let depth = strip.range(axis.other()).len() as f64;
            go_on(side, |line| f64::from(free[line]) >= GROUND_SHARE * depth, frame.cells_of(OPEN_END_M));
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
        let served = closed(frame, self.served().collect(), &self.reach);
        let offset = self.rect.range(self.axis).start;
        let mut start = 0;
        let stretch = |run: &[bool]| {
            let range = start..start + run.len();
            start = range.end;
            let rect = self.rect.with(self.axis, offset + range.start..offset + range.end);
            let sides = [&self.sides[0], &self.sides[1]].map(|side| side[range.clone()].to_vec());
            let fronts = [&sides[0], &sides[1]].map(|side| run[0] && side.contains(&true));
            Stretch { walls: walls(frame, &rect, self.axis), rect, axis: self.axis, sides, fronts }
        };
        served.chunk_by(PartialEq::eq).map(stretch).collect()
    }
}

/// Whether the site ends at the low and at the high side of a band.
fn walls(frame: &Frame, rect: &Rect, axis: Axis) -> [bool; 2] {
    let beyond = frame.beside(rect, axis, BEYOND_M.map(|metres| frame.cells_of(metres)));
    beyond.map(|strip| frame.share(&strip, Cell::is_inside) < GROUND_SHARE)
}

/// Lets places go on before the first and behind the last one as far as no stretch of `least` lines was seen free.
fn go_on(served: &mut [bool], is_free: impl Fn(usize) -> bool, least: usize) {
    let (Some(first), Some(last)) = (served.iter().position(|&here| here), served.iter().rposition(|&here| here))
    else {
        return;
    };
    let unseen = |lines: &mut dyn Iterator<Item = usize>| {
        let (mut end, mut free) = (0, 0);
        for (count, line) in lines.enumerate() {
            free = if is_free(line) { free + 1 } else { 0 };
            if free >= least {
                break;
            }
            end = if free == 0 { count + 1 } else { end };
        }
        end
    };
    let before = unseen(&mut (0..first).rev());
    let behind = unseen(&mut (last + 1..served.len()));
    served[first - before..first].fill(true);
    served[last + 1..last + 1 + behind].fill(true);
}

/// Lines with places, and the empty places between and beside them.
fn closed(frame: &Frame, mut served: Vec<bool>, reach: &Range<usize>) -> Vec<bool> {
    if served.contains(&true) {
        close_gaps(&mut served[reach.clone()], frame.cells_of(OPEN_STRETCH_M));
        close_gaps(&mut served, frame.cells_of(OPEN_END_M));
    }
    served
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
    /// The same by line.
    sides: [Vec<bool>; 2],
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

    /// One aisle, and open floor on both sides of it.
    fn one_aisle(&self, aisle: Range<usize>, parcels: &mut Vec<Parcel>) {
        let across = self.across();
        for floor in [across.start..aisle.start, aisle.end..across.end] {
            if !floor.is_empty() {
                parcels.push(self.part(floor, PlotKind::Lane));
            }
        }
        parcels.push(self.part(aisle, PlotKind::Aisle));
    }

    /// The aisle of the row on one side, as long as the row.
    fn aisle(&self, frame: &Frame, across: Range<usize>, side: usize, parcels: &mut Vec<Parcel>) {
        let served = self.sides[side].clone();
        let reach = 0..served.iter().rposition(|&here| here).map_or(0, |last| last + 1);
        let reach = served.iter().position(|&here| here).unwrap_or(reach.end)..reach.end;
        let mut start = self.rect.range(self.axis).start;
        for run in closed(frame, served, &reach).chunk_by(PartialEq::eq) {
            let part = self.part(across.clone(), if run[0] { PlotKind::Aisle } else { PlotKind::Lane });
            let along = start..start + run.len();
            start = along.end;
            parcels.push(Parcel { rect: part.rect.with(self.axis, along), ..part });
        }
    }

    /// How much the rows at the low and the high side need an aisle here: most with no way to their other side, less with
    /// more rows there, least with open floor.
    fn needs(&self, frame: &Frame, rows: &[Parcel]) -> [Need; 2] {
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
                let need = Need::of(frame, place, self.axis, side, &places);
                lengths[side][need as usize] += place.range(self.axis).len();
            }
        }
        lengths.map(|[none, some, all]| {
            if all >= none + some {
                Need::All
            } else if none >= some {
                Need::None
            } else {
                Need::Some
            }
        })
    }

    /// All of it is what places along it say.
    fn whole(self) -> Parcel {
        let kind = if self.fronts == [false; 2] { PlotKind::Lane } else { PlotKind::Aisle };
        self.part(self.across(), kind)
    }
}

/// How much a row needs the aisle on one of its sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Need {
    /// Its other side is open floor.
    None,
    /// Other rows stand behind it.
    Some,
    /// Nothing leads to its other side.
    All,
}

impl Need {
    /// By what lies behind a place at the low or high side of a band, and behind the places there.
    fn of(frame: &Frame, place: &Rect, axis: Axis, side: usize, places: &[&Rect]) -> Self {
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
fn usual_width(stretches: &[Stretch]) -> Option<usize> {
    let size = |stretch: &Stretch| (stretch.across().len(), stretch.rect.range(stretch.axis).len());
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
    fn cut(&self, frame: &Frame, rows: &[Parcel], stretch: Stretch, parcels: &mut Vec<Parcel>) {
        let across = stretch.across();
        let (start, end, width) = (across.start, across.end, self.width);
        let has_room = |aisles: usize, more: usize| across.len() >= aisles * width + more;
        let is_two = across.len() as f64 >= 2.0 * TWO_AISLES_SHARE * width as f64;
        let room_before_wall = |is_wall: bool| if is_wall { width } else { self.strip };
        match stretch.fronts {
            [true, true] if has_room(2, self.strip) => {
                stretch.aisle(frame, start..start + width, 0, parcels);
                parcels.push(stretch.part(start + width..end - width, PlotKind::Lane));
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
    fn only_side(&self, frame: &Frame, rows: &[Parcel], stretch: &Stretch) -> Option<usize> {
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

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;
    use crate::decomposition::drivable;
    use crate::watch::Watch;

    /// Cells of 0.05 m along the side of a character: half a metre.
    const CHARACTER: usize = 10;

    /// Ends the bands of a picture: `p` are places of two by two characters, lines without any are bands. Aisles are
    /// drawn as `a`, open floor as `-`.
    fn check(picture: &str, expected: &Expect) {
        let lines: Vec<&str> = picture.split_whitespace().collect();
        let wide = |line: &&str| {
            let symbols = line.replace('p', "#").chars().flat_map(|symbol| [symbol; CHARACTER]).collect::<String>();
            (symbols + "\n").repeat(CHARACTER)
        };
        let (mut frame, whole) = Frame::of_picture(&lines.iter().map(wide).collect::<String>(), 0.05);
        let vehicle = frame.cells_of(1.0);
        drivable::mark(&mut frame, vehicle, &Watch::unwatched()).expect("nobody stops it");
        let rect = |columns: Range<usize>, rows: Range<usize>| {
            let (u, v) = (&whole.u, &whole.v);
            let high = |row: usize| v.end - CHARACTER * row;
            Rect {
                u: u.start + CHARACTER * columns.start..u.start + CHARACTER * columns.end,
                v: high(rows.end)..high(rows.start),
            }
        };
        let mut parcels = Vec::new();
        let mut row = 0;
        for lines in lines.chunk_by(|one, next| one.contains('p') == next.contains('p')) {
            let rows = row..row + lines.len();
            row = rows.end;
            if !lines[0].contains('p') {
                let kind = PlotKind::Aisle;
                parcels.push(Parcel::new(rect(0..lines[0].len(), rows), kind, Some(Axis::U)));
                continue;
            }
            for (layer, line) in lines.iter().enumerate().step_by(2) {
                for (column, _) in line.match_indices("pp") {
                    let place = rect(column..column + 2, rows.start + layer..rows.start + layer + 2);
                    parcels.push(Parcel::new(place, PlotKind::Place, Some(Axis::U)));
                }
            }
        }
        let mut drawn: Vec<Vec<char>> = lines.iter().map(|line| line.chars().collect()).collect();
        for band in end(&frame, parcels).iter().filter(|one| one.kind != PlotKind::Place) {
            let symbol = if band.kind == PlotKind::Aisle { 'a' } else { '-' };
            let rows = (whole.v.end - band.rect.v.end) / CHARACTER..(whole.v.end - band.rect.v.start) / CHARACTER;
            let columns =
                (band.rect.u.start - whole.u.start) / CHARACTER..(band.rect.u.end - whole.u.start) / CHARACTER;
            drawn[rows].iter_mut().for_each(|line| line[columns.clone()].fill(symbol));
        }
        let text: String = drawn.into_iter().map(|line| line.into_iter().chain(['\n']).collect::<String>()).collect();
        expected.assert_eq(&text);
    }

    #[test]
    fn an_aisle_ends_with_its_rows_and_goes_on_beside_what_nobody_saw() {
        check(
            "
            ....pppppppp????
            ....pppppppp????
            ................
            ................
            ................
            ................
            ....pppppppp????
            ....pppppppp????
            ",
            &expect![[r#"
                ....pppppppp????
                ....pppppppp????
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ....pppppppp????
                ....pppppppp????
            "#]],
        );
    }

    #[test]
    fn two_aisles_side_by_side_are_as_long_as_their_rows() {
        check(
            "
            ................
            ................
            ................
            ................
            ....pppppppp....
            ....pppppppp....
            ....pppppppp....
            ....pppppppp....
            ................
            ................
            ................
            ................
            ................
            ................
            ................
            ................
            ....pppppppppppp
            ....pppppppppppp
            ....pppppppppppp
            ....pppppppppppp
            ................
            ................
            ................
            ................
            ....pppppppppppp
            ....pppppppppppp
            ................
            ................
            ................
            ................
            ....pppppppppppp
            ....pppppppppppp
            ",
            &expect![[r#"
                ----aaaaaaaa----
                ----aaaaaaaa----
                ----aaaaaaaa----
                ----aaaaaaaa----
                ....pppppppp....
                ....pppppppp....
                ....pppppppp....
                ....pppppppp....
                ----aaaaaaaa----
                ----aaaaaaaa----
                ----aaaaaaaa----
                ----aaaaaaaa----
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ....pppppppppppp
                ....pppppppppppp
                ....pppppppppppp
                ....pppppppppppp
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ....pppppppppppp
                ....pppppppppppp
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ....pppppppppppp
                ....pppppppppppp
            "#]],
        );
    }

    #[test]
    fn the_only_aisle_lies_before_the_row_that_has_no_other() {
        check(
            "
            ....pppppppppppp
            ....pppppppppppp
            ................
            ................
            ................
            ................
            ................
            ................
            ....pppppppppppp
            ....pppppppppppp
            ................
            ................
            ................
            ................
            ....pppppppppppp
            ....pppppppppppp
            ",
            &expect![[r#"
                ....pppppppppppp
                ....pppppppppppp
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----------------
                ----------------
                ....pppppppppppp
                ....pppppppppppp
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ----aaaaaaaaaaaa
                ....pppppppppppp
                ....pppppppppppp
            "#]],
        );
    }
}
