//! Passages through rows that lie beside one another.
//!
//! Empty places and open floor look alike; only several rows together distinguish them. A run of pieces on which vehicles
//! find room is a passage where it goes on, at the same place, through three rows and across an aisle, or where the comb
//! found a passage in one row and such a run in the next. Its sides are the medians of the sides of its runs.
//!
//! The passage of a run goes through a chain of rows, each of them near the one before, with runs that cover most of its
//! range. Such runs all cover the middle of the range. So runs are listed by the strips that they touch along the rows, in
//! the order of their rows, and each distinct range is followed through the chains of one strip only.
//!
//! Cost: O(cells of the rows), and O(r log r + ranges x runs of their chain in the strip) for r runs. Runs are no shorter
//! than a strip is wide, so few of a row touch one; aligned rows share their ranges. Limits: places that are empty opposite
//! one another in three rows are lost.

use std::collections::BTreeSet;
use std::ops::Range;

use super::piece_row::PieceRow;
use crate::decomposition::ground::{Cell, RegionFrame};
use crate::plot::PlotKind;
use crate::runs::runs_of_equal;
use crate::watch::{Stopped, Watch};

/// Narrowest passage, metres: two empty places are none.
const PASSAGE_M: f64 = 2.6;
/// Rows with at most one aisle between them are no further apart than this, metres.
const NEXT_ROW_M: f64 = 5.0;
/// Two rows back to back are not deeper than this, metres: a passage that goes on beyond them crosses an aisle.
const PAIR_M: f64 = 3.6;
/// Rows of a passage that no comb found, at least.
const LEAST_ROWS: usize = 3;
/// Share of a piece that a passage covers, and on which vehicles find room; share of a range that a run covers.
const SHARE: f64 = 0.75;

/// The ranges of the passages through each row, cells along the row, without repeats.
#[derive(Debug, PartialEq)]
pub(super) struct Passages {
    of_rows: Vec<Vec<[usize; 2]>>,
}

/// A run of pieces of a row on which vehicles find room.
#[derive(Debug, Clone, PartialEq)]
struct OpenRun {
    row: usize,
    /// Range of its row across the rows.
    across: Range<usize>,
    along: Range<usize>,
    /// Whether the comb found a passage in it.
    has_passage: bool,
}

impl OpenRun {
    /// Whether it covers most of a range along the rows.
    fn covers(&self, along: &Range<usize>) -> bool {
        common(along, &self.along) as f64 >= SHARE * along.len() as f64
    }
}

/// Lengths in cells.
#[derive(Clone, Copy)]
struct Lengths {
    least: usize,
    next_row: usize,
    pair: usize,
}

impl Passages {
    /// Finds the passages through some rows.
    pub fn find(frame: &RegionFrame, rows: &[PieceRow], watch: &Watch<'_>) -> Result<Self, Stopped> {
        let [least, next_row, pair] = [PASSAGE_M, NEXT_ROW_M, PAIR_M].map(|metres| frame.cells_of(metres));
        let lengths = Lengths { least: least.max(1), next_row, pair };
        let mut runs = Vec::new();
        for (number, row) in rows.iter().enumerate() {
            watch.check()?;
            runs.extend(open_runs(frame, number, row, lengths.least));
        }
        Self::through(runs, rows.len(), lengths, watch)
    }

    /// The passages through some runs of so many rows.
    fn through(mut runs: Vec<OpenRun>, rows: usize, lengths: Lengths, watch: &Watch<'_>) -> Result<Self, Stopped> {
        runs.sort_by_key(|run| run.across.start);
        let strips = runs.iter().map(|run| run.along.end.div_ceil(lengths.least)).max().unwrap_or(0);
        let mut of_strips: Vec<Vec<u32>> = vec![Vec::new(); strips];
        for (number, run) in (0..).zip(&runs) {
            watch.check()?;
            let touched = run.along.start / lengths.least..run.along.end.div_ceil(lengths.least);
            of_strips[touched].iter_mut().for_each(|strip| strip.push(number));
        }
        let mut found = Self { of_rows: vec![Vec::new(); rows] };
        for (strip, numbers) in of_strips.iter().enumerate() {
            let of_strip: Vec<&OpenRun> = numbers.iter().map(|&number| &runs[number as usize]).collect();
            for chain in chains(&of_strip, lengths.next_row) {
                found.follow(chain, strip, lengths, watch)?;
            }
        }
        for ranges in &mut found.of_rows {
            ranges.sort_unstable();
            ranges.dedup();
        }
        Ok(found)
    }

    /// Follows each range with its middle in a strip through a chain of runs that touch this strip.
    fn follow(&mut self, chain: &[&OpenRun], strip: usize, lengths: Lengths, watch: &Watch<'_>) -> Result<(), Stopped> {
        let is_here = |run: &&&OpenRun| run.along.start.midpoint(run.along.end) / lengths.least == strip;
        let ranges: BTreeSet<[usize; 2]> =
            chain.iter().filter(is_here).map(|run| [run.along.start, run.along.end]).collect();
        for range in ranges.into_iter().map(|[start, end]| start..end) {
            watch.check()?;
            let covering: Vec<&OpenRun> = chain.iter().copied().filter(|run| run.covers(&range)).collect();
            let has_range = |members: &&[&OpenRun]| members.iter().any(|run| run.along == range);
            for members in chains(&covering, lengths.next_row).filter(has_range) {
                let Some(range) = passage(members, lengths.pair) else { continue };
                for member in members {
                    let of_row = &mut self.of_rows[member.row];
                    if of_row.last() != Some(&range) {
                        of_row.push(range);
                    }
                }
            }
        }
        Ok(())
    }

    /// Makes passages of the pieces that they go through.
    pub fn open(self, frame: &RegionFrame, rows: &mut [PieceRow], watch: &Watch<'_>) -> Result<(), Stopped> {
        for (row, ranges) in rows.iter_mut().zip(self.of_rows) {
            watch.check()?;
            let mut is_open = vec![false; row.pieces.len()];
            for range in ranges.into_iter().map(|[start, end]| start..end) {
                let axis = row.axis;
                let first = row.pieces.partition_point(|piece| piece.rect.range(axis).end <= range.start);
                let pieces = row.pieces[first..].iter().map(|piece| piece.rect.range(axis));
                let within = pieces
                    .take_while(|along| along.start < range.end)
                    .map(|along| common(along, &range) as f64 >= SHARE * along.len() as f64);
                is_open[first..].iter_mut().zip(within).for_each(|(is_open, is_within)| *is_open |= is_within);
            }
            let opened = row.pieces.iter_mut().zip(is_open).filter(|&(_, is_open)| is_open);
            for (piece, _) in opened {
                if frame.share(&piece.rect, Cell::is_drivable) >= SHARE {
                    piece.kind = PlotKind::Passage;
                }
            }
        }
        Ok(())
    }
}

/// Length that two ranges have in common.
fn common(one: &Range<usize>, other: &Range<usize>) -> usize {
    one.end.min(other.end).saturating_sub(one.start.max(other.start))
}

/// The runs of a row that are no shorter than `least`; none of a row without places.
fn open_runs(frame: &RegionFrame, number: usize, row: &PieceRow, least: usize) -> Vec<OpenRun> {
    if !row.holds_places() {
        return Vec::new();
    }
    let is_open: Vec<bool> =
        row.pieces.iter().map(|piece| frame.share(&piece.rect, Cell::is_drivable) >= SHARE).collect();
    let mut found = Vec::new();
    for run in runs_of_equal(&is_open).filter(|run| is_open[run.start]) {
        let pieces = &row.pieces[run];
        let along = row.along(&pieces[0]).start..row.along(&pieces[pieces.len() - 1]).end;
        if along.len() >= least {
            let is_passage = |kind: PlotKind| kind == PlotKind::Passage;
            let has_passage = pieces.iter().any(|piece| is_passage(piece.kind) && row.along(piece).len() >= least);
            found.push(OpenRun { row: number, across: row.across.clone(), along, has_passage });
        }
    }
    found
}

/// Parts of some runs, which are in the order of their rows, in which each row is near one before it.
fn chains<'r, 'a>(runs: &'r [&'a OpenRun], next_row: usize) -> impl Iterator<Item = &'r [&'a OpenRun]> {
    let mut end = 0;
    runs.chunk_by(move |run, next| {
        end = run.across.end.max(end);
        next.across.start.saturating_sub(end) <= next_row
    })
}

/// The range of the passage through the runs of a chain, if they are one.
fn passage(members: &[&OpenRun], pair: usize) -> Option<[usize; 2]> {
    let low = members.iter().map(|member| member.across.start).min().unwrap_or(0);
    let depth = members.iter().map(|member| member.across.end).max().unwrap_or(low) - low;
    let crosses_aisle = members.len() >= LEAST_ROWS && depth > pair;
    let is_passage = crosses_aisle || (members.len() > 1 && members.iter().any(|member| member.has_passage));
    is_passage.then(|| {
        let (starts, ends) = (members.iter().map(|of| of.along.start), members.iter().map(|of| of.along.end));
        [median(starts.collect(), true), median(ends.collect(), false)]
    })
}

/// The middle one of some numbers, of two the greater or the lesser one.
fn median(mut numbers: Vec<usize>, is_greater: bool) -> usize {
    let at = if is_greater { numbers.len() / 2 } else { numbers.len().saturating_sub(1) / 2 };
    if numbers.is_empty() { 0 } else { *numbers.select_nth_unstable(at).1 }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use proptest::prelude::*;

    use super::*;
    use crate::watch::{Observer, Stage, StopFlag};

    const LENGTHS: Lengths = Lengths { least: 52, next_row: 100, pair: 72 };

    /// The passages through each run, one by one: whatever can be reached from it through runs that cover its range.
    fn one_by_one(runs: &[OpenRun], rows: usize) -> Vec<Vec<[usize; 2]>> {
        let mut of_rows = vec![Vec::new(); rows];
        for seed in runs {
            let mut members: Vec<&OpenRun> = vec![seed];
            let mut next = 0;
            while next < members.len() {
                let across = &members[next].across;
                for other in runs.iter().filter(|other| other.covers(&seed.along)) {
                    let beside = &other.across;
                    let distance = beside.start.saturating_sub(across.end).max(across.start.saturating_sub(beside.end));
                    if distance <= LENGTHS.next_row && !members.iter().any(|member| std::ptr::eq(*member, other)) {
                        members.push(other);
                    }
                }
                next += 1;
            }
            if let Some(range) = passage(&members, LENGTHS.pair) {
                for member in members {
                    of_rows[member.row].push(range);
                }
            }
        }
        for ranges in &mut of_rows {
            ranges.sort_unstable();
            ranges.dedup();
        }
        of_rows
    }

    /// Runs of rows 20 cells deep with 4 to 150 cells between them, some of them with two runs.
    fn runs() -> impl Strategy<Value = Vec<OpenRun>> {
        let row = (4_usize..150, 0_usize..300, 52_usize..140, 0_usize..40, 52_usize..90, any::<[bool; 2]>());
        proptest::collection::vec(row, 0..24).prop_map(|rows| {
            let (mut runs, mut low) = (Vec::new(), 0);
            for (row, (space, start, length, gap, second, has_passage)) in rows.into_iter().enumerate() {
                low += space;
                let across = low..low + 20;
                low += 20;
                let along = start..start + length;
                let behind = along.end + gap + 1..along.end + gap + 1 + second;
                runs.push(OpenRun { row, across: across.clone(), along, has_passage: has_passage[0] });
                if has_passage[1] {
                    runs.push(OpenRun { row, across, along: behind, has_passage: false });
                }
            }
            runs
        })
    }

    proptest! {
        #[test]
        fn passages_are_those_found_one_by_one(runs in runs()) {
            let wanted = one_by_one(&runs, 24);
            let found = Passages::through(runs, 24, LENGTHS, &Watch::unwatched()).expect("nobody stops it");
            prop_assert_eq!(found.of_rows, wanted);
        }
    }

    /// 100,000 runs, twenty to a row, each a few cells off the one below: one chain of rows in every strip.
    fn hostile() -> (Vec<OpenRun>, usize) {
        let (rows, columns) = (5_000, 20);
        let run = |number: usize| {
            let (row, column) = (number / columns, number % columns);
            let start = 80 * column + row * 7 % 12;
            let along = start..start + 53 + row * 5 % 11;
            OpenRun { row, across: 60 * row..60 * row + 20, along, has_passage: false }
        };
        ((0..rows * columns).map(run).collect(), rows)
    }

    #[test]
    fn a_hundred_thousand_runs_are_followed_range_by_range() {
        let (runs, rows) = hostile();
        let ranges: BTreeMap<(usize, usize), usize> = runs.iter().fold(BTreeMap::new(), |mut ranges, run| {
            *ranges.entry((run.along.start, run.along.end)).or_default() += 1;
            ranges
        });
        // Every range is followed once through the 5,000 rows of its strip, and not once for each of its runs.
        assert!(ranges.len() * 20 < runs.len(), "{} ranges", ranges.len());
        let found = Passages::through(runs, rows, LENGTHS, &Watch::unwatched()).expect("nobody stops it");
        assert!(found.of_rows.iter().all(|ranges| ranges.len() >= 20), "every column is a passage through every row");
    }

    struct Nobody;

    impl Observer for Nobody {
        fn progress(&self, _stage: Stage, _fraction: f64) {}
    }

    #[test]
    fn another_thread_stops_them() {
        let (runs, rows) = hostile();
        let stop = StopFlag::default();
        let watch = Watch::new(&stop, &Nobody);
        std::thread::scope(|scope| {
            scope.spawn(|| stop.raise());
            while Passages::through(runs.clone(), rows, LENGTHS, &watch) != Err(Stopped) {}
        });
    }
}
