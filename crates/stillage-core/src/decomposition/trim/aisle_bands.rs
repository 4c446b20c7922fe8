//! Aisles end where the places along them do.
//!
//! A band serves a row along its places only, and on beside what nobody saw: a row ends where it is seen to end. Where a
//! band runs on without any row it is open floor. How much of its width is aisle, [`super::aisle_width`] says.
//!
//! Cost: O(bands x places).

use std::ops::Range;

use super::aisle_width::{self, BandSection};
use crate::decomposition::ground::{Axis, Cell, Rect, RegionFrame};
use crate::decomposition::plot::{Parcel, PlotKind};

/// Places and band meet within this, metres.
pub(super) const CONTACT_M: f64 = 0.8;
/// A stretch of a band without places is open floor from this length on, metres: narrower, it is an empty place or two.
const OPEN_STRETCH_M: f64 = 1.9;
/// The same at the ends of a block, metres.
const OPEN_END_M: f64 = 0.5;
/// Where the ground ends that lies beyond the side of a band, metres, and the share of it that must be in the site, or
/// free.
const BEYOND_M: [f64; 2] = [0.3, 0.8];
pub(super) const GROUND_SHARE: f64 = 0.5;

/// Cuts the bands where places stop to lie along them.
pub(super) fn end(frame: &RegionFrame, parcels: Vec<Parcel>) -> Vec<Parcel> {
    let is_band = |parcel: &Parcel| matches!(parcel.kind, PlotKind::Aisle | PlotKind::OpenFloor);
    let (bands, mut ended): (Vec<Parcel>, Vec<Parcel>) = parcels.into_iter().partition(is_band);
    let mut bands: Vec<AisleBand> = bands.into_iter().map(|band| AisleBand::of(frame, band, &ended)).collect();
    // Bands of one length are those of one block.
    bands.sort_by_key(AisleBand::block);
    for block in bands.chunk_by_mut(|one, other| one.block() == other.block()) {
        let first = block.iter().filter_map(|band| band.served().position(|here| here)).min();
        let last = block.iter().filter_map(|band| band.served().rposition(|here| here)).max();
        if let (Some(first), Some(last)) = (first, last) {
            for band in block {
                band.reach = first..last + 1;
            }
        }
    }
    let stretches: Vec<BandSection> = bands.iter().flat_map(|band| band.stretches(frame)).collect();
    aisle_width::cut(frame, stretches, &mut ended);
    ended
}

/// A band, and where places lie along it.
struct AisleBand {
    rect: Rect,
    axis: Axis,
    /// By line across the band: whether there is a place at its low and at its high side.
    sides: [Vec<bool>; 2],
    /// From the first place to the last one along any band of its block.
    reach: Range<usize>,
}

impl AisleBand {
    fn of(frame: &RegionFrame, band: Parcel, others: &[Parcel]) -> Self {
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
    fn stretches(&self, frame: &RegionFrame) -> Vec<BandSection> {
        let served = closed(frame, self.served().collect(), &self.reach);
        let offset = self.rect.range(self.axis).start;
        let mut start = 0;
        let stretch = |run: &[bool]| {
            let range = start..start + run.len();
            start = range.end;
            let rect = self.rect.with(self.axis, offset + range.start..offset + range.end);
            let sides = [&self.sides[0], &self.sides[1]].map(|side| side[range.clone()].to_vec());
            let fronts = [&sides[0], &sides[1]].map(|side| run[0] && side.contains(&true));
            BandSection { walls: walls(frame, &rect, self.axis), rect, axis: self.axis, sides, fronts }
        };
        served.chunk_by(PartialEq::eq).map(stretch).collect()
    }
}

/// Whether the site ends at the low and at the high side of a band.
fn walls(frame: &RegionFrame, rect: &Rect, axis: Axis) -> [bool; 2] {
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
pub(super) fn closed(frame: &RegionFrame, mut served: Vec<bool>, reach: &Range<usize>) -> Vec<bool> {
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

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;
    use crate::decomposition::ground::drivable;
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
        let (mut frame, whole) = RegionFrame::of_picture(&lines.iter().map(wide).collect::<String>(), 0.05);
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
