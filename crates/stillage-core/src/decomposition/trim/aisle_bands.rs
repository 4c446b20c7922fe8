//! Aisles end where the places along them do.
//!
//! A band is an aisle along its places, and beyond them as far as the floor beside it was not seen free, since a row ends
//! where it is seen to end. Where a band runs on without any row it is open floor. How much of its width is aisle,
//! [`super::aisle_width`] decides.
//!
//! Cost: O(cells of the bands + places log places).

use std::ops::Range;

use super::aisle_width;
use super::band_section::{BandSection, GROUND_SHARE, OPEN_END_M, without_short_gaps};
use super::place_index::PlaceIndex;
use crate::decomposition::ground::{Axis, Cell, Rect, RegionFrame};
use crate::decomposition::parcel::Parcel;
use crate::plot::PlotKind;
use crate::runs::runs_of_equal;
use crate::watch::{Stopped, Watch};

/// Where the ground beyond the side of a band begins and ends, metres from the band.
const BEYOND_M: [f64; 2] = [0.3, 0.8];

/// Cuts the bands at the ends of the places along them; other parcels stay as they are and come first.
pub(super) fn trimmed(frame: &RegionFrame, parcels: Vec<Parcel>, watch: &Watch<'_>) -> Result<Vec<Parcel>, Stopped> {
    let is_band = |parcel: &Parcel| matches!(parcel.kind, PlotKind::Aisle | PlotKind::OpenFloor);
    let (bands, mut trimmed): (Vec<Parcel>, Vec<Parcel>) = parcels.into_iter().partition(is_band);
    let [along_u, along_v] = Axis::BOTH.map(|axis| PlaceIndex::of(frame, &trimmed, axis, watch));
    let places = [along_u?, along_v?];
    let mut bands: Vec<AisleBand> =
        bands.into_iter().map(|band| AisleBand::of(frame, band, &places, watch)).collect::<Result<_, _>>()?;
    // Bands of one length are those of one block of rows.
    bands.sort_by_key(AisleBand::block);
    for block in bands.chunk_by_mut(|one, other| one.block() == other.block()) {
        let first = block.iter().filter_map(|band| band.has_place().position(|here| here)).min();
        let last = block.iter().filter_map(|band| band.has_place().rposition(|here| here)).max();
        if let (Some(first), Some(last)) = (first, last) {
            for band in block {
                band.reach = first..last + 1;
            }
        }
    }
    let mut sections = Vec::new();
    for band in &bands {
        watch.check()?;
        sections.extend(band.sections(frame));
    }
    trimmed.extend(aisle_width::cut(frame, &sections, &places, watch)?);
    Ok(trimmed)
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
    fn of(frame: &RegionFrame, band: Parcel, places: &[PlaceIndex; 2], watch: &Watch<'_>) -> Result<Self, Stopped> {
        watch.check()?;
        let axis = band.axis.unwrap_or(Axis::U);
        let index = &places[usize::from(axis == Axis::V)];
        let along = band.rect.range(axis);
        let mut sides = [vec![false; along.len()], vec![false; along.len()]];
        for (side, places) in sides.iter_mut().zip(index.along(&band.rect)) {
            for place in places {
                let beside = index.places.rects()[place].range(axis);
                let (start, end) = (beside.start.max(along.start), beside.end.min(along.end));
                side[start - along.start..end - along.start].fill(true);
            }
        }
        let beyond = frame.beside(&band.rect, axis, BEYOND_M.map(|metres| frame.cells_of(metres)));
        for (side, strip) in sides.iter_mut().zip(beyond) {
            let free = frame.counts(&strip, axis.other(), Cell::is_free);
            let depth = strip.range(axis.other()).len() as f64;
            extend_unseen(side, |line| f64::from(free[line]) >= GROUND_SHARE * depth, frame.cells_of(OPEN_END_M));
        }
        Ok(Self { rect: band.rect, axis, sides, reach: 0..0 })
    }

    /// The block of rows that it belongs to: its direction and where it begins and ends.
    fn block(&self) -> (bool, usize, usize) {
        let along = self.rect.range(self.axis);
        (self.axis == Axis::V, along.start, along.end)
    }

    /// By line across the band: whether there is a place on either side.
    fn has_place(&self) -> impl ExactSizeIterator<Item = bool> + DoubleEndedIterator {
        self.sides[0].iter().zip(&self.sides[1]).map(|(low, high)| *low || *high)
    }

    /// The sections with and without places, ascending.
    fn sections(&self, frame: &RegionFrame) -> Vec<BandSection> {
        let has_place = without_short_gaps(frame, self.has_place().collect(), &self.reach);
        let start = self.rect.range(self.axis).start;
        let section = |run: Range<usize>| {
            let rect = self.rect.with(self.axis, start + run.start..start + run.end);
            let sides = [&self.sides[0], &self.sides[1]].map(|side| side[run.clone()].to_vec());
            let fronts = [&sides[0], &sides[1]].map(|side| has_place[run.start] && side.contains(&true));
            BandSection { walls: walls(frame, &rect, self.axis), rect, axis: self.axis, sides, fronts }
        };
        runs_of_equal(&has_place).map(section).collect()
    }
}

/// Whether the site ends at the low and at the high side of a band.
fn walls(frame: &RegionFrame, rect: &Rect, axis: Axis) -> [bool; 2] {
    let beyond = frame.beside(rect, axis, BEYOND_M.map(|metres| frame.cells_of(metres)));
    beyond.map(|strip| frame.share(&strip, Cell::is_inside) < GROUND_SHARE)
}

/// Extends the lines with places before the first and behind the last one, up to the first `least` lines in a row that
/// were seen free.
fn extend_unseen(has_place: &mut [bool], is_free: impl Fn(usize) -> bool, least: usize) {
    let (Some(first), Some(last)) = (has_place.iter().position(|&here| here), has_place.iter().rposition(|&here| here))
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
    let behind = unseen(&mut (last + 1..has_place.len()));
    has_place[first - before..first].fill(true);
    has_place[last + 1..last + 1 + behind].fill(true);
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;
    use crate::decomposition::ground::drivable;

    /// Cells of 0.05 m along the side of a character: half a metre.
    const CHARACTER: usize = 10;

    /// Trims the bands of a picture: `p` are places of two by two characters, lines without any are bands. Aisles are
    /// drawn as `a`, open floor as `-`.
    fn check(picture: &str, expected: &Expect) {
        let lines: Vec<&str> = picture.split_whitespace().collect();
        let wide = |line: &&str| {
            let symbols = line.replace('p', "#").chars().flat_map(|symbol| [symbol; CHARACTER]).collect::<String>();
            (symbols + "\n").repeat(CHARACTER)
        };
        let (mut frame, whole) = RegionFrame::of_picture(&lines.iter().map(wide).collect::<String>(), 0.05);
        drivable::mark(&mut frame, 1.0, &Watch::unwatched()).expect("nobody stops it");
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
        let trimmed = trimmed(&frame, parcels, &Watch::unwatched()).expect("nobody stops it");
        for band in trimmed.iter().filter(|one| one.kind != PlotKind::Place) {
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
