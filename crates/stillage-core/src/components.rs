//! Connected components of cells, as runs along the rows.
//!
//! Neighbouring cells of a row are one run; runs that touch those of the row before are joined by union-find (A.
//! Rosenfeld and J. Pfaltz, *Sequential operations in digital picture processing*, 1966, doi 10.1145/321356.321357,
//! with runs in place of cells). Components are ordered by their first cells. Cost: O(cells) time, O(runs) memory.

use std::ops::Range;

use crate::geometry::{DisjointSets, OrientedBox, Point};
use crate::watch::{Stopped, Watch};

/// Which cells touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Neighbours {
    /// Those that share a side.
    Four,
    /// Those that share a side or a corner.
    Eight,
}

/// Neighbouring cells of a row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Run {
    pub row: u32,
    pub columns: Range<u32>,
}

impl Run {
    fn touches(&self, other: &Self, neighbours: Neighbours) -> bool {
        let reach = u32::from(neighbours == Neighbours::Eight);
        self.columns.start < other.columns.end + reach && other.columns.start < self.columns.end + reach
    }
}

/// The components of some cells.
pub(crate) struct Components {
    width: usize,
    /// By component, each in the order of rows and columns.
    runs: Vec<Run>,
    /// End of each component in `runs`.
    ends: Vec<usize>,
}

impl Components {
    /// The components of the cells for which `is_member` holds (by row-major index), of a grid of `cells` cells in rows
    /// of
    /// `width`.
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    pub(crate) fn of(
        [width, cells]: [usize; 2],
        neighbours: Neighbours,
        is_member: impl Fn(usize) -> bool,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let mut runs: Vec<Run> = Vec::new();
        let mut pairs: Vec<[u32; 2]> = Vec::new();
        let mut before = 0..0;
        for row in 0..cells.checked_div(width).unwrap_or(0) {
            watch.check()?;
            let start = runs.len();
            runs.extend(runs_of_row(row, width, &is_member));
            pairs.extend(touching(&runs, before, start..runs.len(), neighbours));
            before = start..runs.len();
        }
        let mut sets = DisjointSets::new(runs.len());
        for [one, other] in pairs {
            sets.join(one as usize, other as usize);
        }
        Ok(Self::grouped(width, runs, sets))
    }

    /// Brings the runs of each set together.
    fn grouped(width: usize, runs: Vec<Run>, mut sets: DisjointSets) -> Self {
        // The root of a set is its first run, so numbers follow the first cells.
        let mut ends = Vec::new();
        let mut numbers = vec![0; runs.len()];
        for run in 0..runs.len() {
            let root = sets.find(run);
            if root == run {
                numbers[run] = ends.len();
                ends.push(0);
            }
            numbers[run] = numbers[root];
            ends[numbers[run]] += 1;
        }
        let mut sum = 0;
        for end in &mut ends {
            // The start of the component; it becomes the end as the runs are put in.
            sum += std::mem::replace(end, sum);
        }
        let mut sorted = vec![Run { row: 0, columns: 0..0 }; runs.len()];
        for (run, number) in runs.into_iter().zip(numbers) {
            sorted[ends[number]] = run;
            ends[number] += 1;
        }
        Self { width, runs: sorted, ends }
    }

    /// The components in the order of their first cells.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Component<'_>> {
        (0..self.ends.len()).map(|index| {
            let start = index.checked_sub(1).map_or(0, |before| self.ends[before]);
            Component { width: self.width, runs: &self.runs[start..self.ends[index]] }
        })
    }
}

fn runs_of_row(row: usize, width: usize, is_member: impl Fn(usize) -> bool) -> impl Iterator<Item = Run> {
    let mut column = 0;
    std::iter::from_fn(move || {
        let is_in = |column: usize| is_member(row * width + column);
        let start = (column..width).find(|&column| is_in(column))?;
        let end = (start + 1..width).find(|&column| !is_in(column)).unwrap_or(width);
        column = end;
        Some(Run { row: row as u32, columns: start as u32..end as u32 })
    })
}

/// The pairs of runs of a row and of the next that touch.
fn touching(
    runs: &[Run],
    below: Range<usize>,
    above: Range<usize>,
    neighbours: Neighbours,
) -> impl Iterator<Item = [u32; 2]> {
    let mut first = below.start;
    above.flat_map(move |run| {
        let reach = u32::from(neighbours == Neighbours::Eight);
        while first < below.end && runs[first].columns.end + reach <= runs[run].columns.start {
            first += 1;
        }
        let touching = (first..below.end).take_while(move |&other| runs[other].touches(&runs[run], neighbours));
        touching.map(move |other| [other as u32, run as u32])
    })
}

/// Cells that are connected; at least one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Component<'a> {
    width: usize,
    runs: &'a [Run],
}

impl<'a> Component<'a> {
    /// Its runs, in the order of rows and columns.
    pub(crate) fn runs(&self) -> &'a [Run] {
        self.runs
    }

    /// Number of cells.
    pub(crate) fn len(&self) -> usize {
        self.runs.iter().map(|run| run.columns.len()).sum()
    }

    /// Its cells by row-major index, ascending.
    pub(crate) fn cells(&self) -> impl Iterator<Item = usize> + use<'a> {
        let width = self.width;
        self.runs.iter().flat_map(move |run| {
            let row = run.row as usize * width;
            row + run.columns.start as usize..row + run.columns.end as usize
        })
    }

    /// Its first cell.
    pub(crate) fn first(&self) -> usize {
        self.runs[0].row as usize * self.width + self.runs[0].columns.start as usize
    }

    /// The columns and rows that it reaches over.
    pub(crate) fn bounds(&self) -> [Range<usize>; 2] {
        let low = self.runs.iter().map(|run| run.columns.start).min().unwrap_or(0) as usize;
        let high = self.runs.iter().map(|run| run.columns.end).max().unwrap_or(0) as usize;
        let [first, last] = [self.runs.first(), self.runs.last()].map(|run| run.map_or(0, |run| run.row as usize));
        [low..high, first..last + 1]
    }

    /// The smallest box around it, metres from the corner of the grid; `cell` is the side of a cell, metres.
    pub(crate) fn smallest_box(&self, cell: f64) -> OrientedBox {
        let corners = self.runs.iter().flat_map(|run| {
            let [left, right] = [run.columns.start, run.columns.end].map(f64::from);
            let [low, high] = [f64::from(run.row), f64::from(run.row) + 1.0];
            [(left, low), (right, low), (left, high), (right, high)].map(|(x, y)| Point::new(x, y) * cell)
        });
        OrientedBox::smallest_around(&corners.collect::<Vec<_>>())
    }

    /// Diagonal of its bounds, cells.
    pub(crate) fn diagonal(&self) -> f64 {
        let [columns, rows] = self.bounds().map(|side| side.len() as f64);
        columns.hypot(rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn drawn(picture: &str, neighbours: Neighbours) -> String {
        let lines: Vec<&str> = picture.split_whitespace().collect();
        let (width, cells) = (lines[0].len(), lines.concat());
        let is_member = |cell: usize| cells.as_bytes()[cell] == b'#';
        let found = Components::of([width, cells.len()], neighbours, is_member, &Watch::unwatched());
        let mut drawn = ".".repeat(cells.len()).into_bytes();
        for (letter, component) in (b'a'..).zip(found.expect("nobody stops it").iter()) {
            component.cells().for_each(|cell| drawn[cell] = letter);
        }
        let lines = drawn.chunks(width).map(String::from_utf8_lossy);
        lines.collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn corners_join_eight_neighbours_only() {
        let picture = "
            #.#.#
            #.###
            .#...
            #..##
        ";
        expect_test::expect![[r"
            a.a.a
            a.aaa
            .a...
            a..bb"]]
        .assert_eq(&drawn(picture, Neighbours::Eight));
        expect_test::expect![[r"
            a.b.b
            a.bbb
            .c...
            d..ee"]]
        .assert_eq(&drawn(picture, Neighbours::Four));
    }

    #[test]
    fn a_component_knows_its_size() {
        let found =
            Components::of([4, 12], Neighbours::Eight, |cell| [1, 2, 4, 8].contains(&cell), &Watch::unwatched());
        let found = found.expect("nobody stops it");
        let component = found.iter().next().expect("there are cells");
        assert_eq!((component.first(), component.len(), component.bounds()), (1, 4, [0..3, 0..3]));
        assert!(component.cells().eq([1, 2, 4, 8]));
    }

    proptest! {
        #[test]
        fn neighbours_share_a_component(
            width in 1_usize..9,
            members in proptest::collection::vec(any::<bool>(), 0..80),
            eight in any::<bool>(),
        ) {
            let cells = members.len() / width * width;
            let neighbours = if eight { Neighbours::Eight } else { Neighbours::Four };
            let found = Components::of([width, cells], neighbours, |cell| members[cell], &Watch::unwatched());
            let mut numbers = vec![0; cells];
            for (number, component) in (1..).zip(found.expect("nobody stops it").iter()) {
                component.cells().for_each(|cell| numbers[cell] = number);
            }
            // A flood from each component's first cell reaches just its cells.
            let mut flooded = vec![0; cells];
            let mut count = 0;
            for first in (0..cells).filter(|&cell| members[cell]) {
                if flooded[first] != 0 {
                    continue;
                }
                count += 1;
                let mut open = vec![first];
                while let Some(cell) = open.pop() {
                    flooded[cell] = count;
                    for near in (0..cells).filter(|&near| members[near] && flooded[near] == 0) {
                        let across = (cell / width).abs_diff(near / width);
                        let along = (cell % width).abs_diff(near % width);
                        if across.max(along) == 1 && (eight || across + along == 1) {
                            open.push(near);
                        }
                    }
                }
            }
            prop_assert_eq!(numbers, flooded);
        }
    }
}
