//! Runs of marks that keep one pitch.
//!
//! A gap wider than a cross aisle may part two blocks of racks, and the marks beyond it are then at other distances. So a
//! line is cut at such gaps, and parts that keep the same lattice are joined again: there, places are empty. Gaps that all
//! lines have are cross aisles.

use super::mark_lattice::{self, EXPLAINED, MarkLattice, Pitch};
use super::mark_line::MarkLine;
use super::range::length;

/// Marks at least this deep are as deep as their row, metres; thinner ones are its fronts, or the legs of its places.
pub(super) const DEEP_M: f64 = 0.45;
/// Narrowest gap between two blocks, metres and pitches.
const CROSS_M: f64 = 1.0;
const CROSS_PITCHES: f64 = 1.25;
/// A gap that so many lines have is a cross aisle if it is so wide, metres; in fewer lines places may be empty by chance.
const LEAST_LINES: usize = 4;
const CROSS_OF_ALL_M: f64 = 1.9;
/// Parts of a line behind one another that are tried as one: a column may stand between two.
const PARTS_BACK: usize = 3;

/// Marks of a line that keep one pitch.
#[derive(Debug, Clone)]
pub(super) struct MarkRun {
    /// Place across the direction, metres.
    pub across: [f64; 2],
    /// Places along it, ascending.
    pub marks: Vec<[f64; 2]>,
    /// Length of most marks.
    pub usual: f64,
    /// Number of things in those marks that are as long as most, or as several side by side, and in the others.
    pub regular: usize,
    pub irregular: usize,
    /// Where the middles of marks lie from the lattice's zero, in [0, pitch): one, or two where each place has two.
    pub phases: Vec<f64>,
}

impl MarkRun {
    /// Where the middle of the first mark is, and that of the last one.
    pub fn ends(&self) -> [f64; 2] {
        let [first, last] = [self.marks[0], self.marks[self.marks.len() - 1]];
        [first[0] + self.usual / 2.0, last[1] - self.usual / 2.0]
    }
}

/// Middles of gaps that all lines have and that are wide enough for a cross aisle at a pitch, ascending.
fn cross_aisles(lines: &[MarkLine], pitch: Pitch) -> Vec<f64> {
    if lines.len() < LEAST_LINES {
        return Vec::new();
    }
    let widest = widest(pitch).max(CROSS_OF_ALL_M);
    let mut marks: Vec<[f64; 2]> = lines.iter().flat_map(|line| line.marks.iter().copied()).collect();
    marks.sort_by(|one, other| one[0].total_cmp(&other[0]));
    let (mut end, mut found) = (f64::INFINITY, Vec::new());
    for mark in marks {
        if mark[0] - end >= widest {
            found.push(f64::midpoint(end, mark[0]));
        }
        end = if end.is_finite() { end.max(mark[1]) } else { mark[1] };
    }
    found
}

/// Narrowest gap between two blocks, metres.
fn widest(pitch: Pitch) -> f64 {
    CROSS_M.max(CROSS_PITCHES * pitch.length)
}

/// How well the marks of some lines keep a pitch.
pub(super) fn score(lines: &[MarkLine], pitch: Pitch) -> f64 {
    let cross_aisles = cross_aisles(lines, pitch);
    lines.iter().flat_map(|line| parts(line, pitch, &cross_aisles)).map(|part| part.1.score).sum()
}

/// The runs of some lines at a pitch, and the lines that have none.
pub(super) fn of_lines(lines: Vec<MarkLine>, pitch: Pitch) -> (Vec<MarkRun>, Vec<MarkLine>) {
    let (mut runs, mut others) = (Vec::new(), Vec::new());
    let cross_aisles = cross_aisles(&lines, pitch);
    for line in lines {
        let found = parts(&line, pitch, &cross_aisles);
        let found: Vec<_> = found.into_iter().filter(|(_, lattice)| lattice.score > 0.0).collect();
        if found.is_empty() {
            others.push(line);
            continue;
        }
        for (marks, lattice) in found {
            let marks: Vec<[f64; 2]> =
                marks.into_iter().filter(|&mark| lattice.explains(mark, line.usual, pitch)).collect();
            let is_in = |mark: &[f64; 2]| marks.iter().any(|other| other[0] == mark[0] && other[1] == mark[1]);
            let (mut regular, mut irregular) = (0, 0);
            for (mark, things) in line.marks.iter().zip(&line.things).filter(|(mark, _)| is_in(mark)) {
                *if mark_lattice::is_regular(*mark, line.usual, pitch) { &mut regular } else { &mut irregular } +=
                    things;
            }
            let phases = lattice.phases;
            runs.push(MarkRun { across: line.across, marks, usual: line.usual, regular, irregular, phases });
        }
    }
    (runs, others)
}

/// The parts of a line with the lattice of each.
fn parts(line: &MarkLine, pitch: Pitch, cross_aisles: &[f64]) -> Vec<(Vec<[f64; 2]>, MarkLattice)> {
    let is_thin = length(line.across) < DEEP_M;
    let lattice = |marks: &[[f64; 2]]| MarkLattice::of(marks, line.usual, pitch, is_thin);
    let mut found: Vec<(Vec<[f64; 2]>, MarkLattice)> = Vec::new();
    for part in chunks(line, pitch) {
        let start = part[0][0];
        let last = cross_aisles.iter().copied().filter(|&place| place < start).fold(f64::NEG_INFINITY, f64::max);
        let near = found.iter_mut().rev().take(PARTS_BACK).take_while(|(marks, _)| marks[marks.len() - 1][1] > last);
        let mut joined = false;
        for (before, own) in near {
            let both = [before.as_slice(), part].concat();
            let whole = lattice(&both);
            if whole.explained >= own.explained + EXPLAINED * part.len() as f64 {
                (*before, *own, joined) = (both, whole, true);
                break;
            }
        }
        if !joined {
            found.push((part.to_vec(), lattice(part)));
        }
    }
    found
}

/// The marks of a line, cut at wide gaps and wherever no lattice with one or two marks for each place goes on.
fn chunks(line: &MarkLine, pitch: Pitch) -> impl Iterator<Item = &[[f64; 2]]> {
    let marks = &line.marks;
    let middles = move |index: usize| mark_lattice::middles(marks[index], line.usual);
    let is_on = move |one: usize, other: usize| {
        middles(one).iter().any(|&phase| middles(other).iter().any(|&place| pitch.is_on(place, phase)))
    };
    let goes_on = move |index: usize| {
        let near = marks[index + 1][0] - marks[index][1] < widest(pitch);
        let before = index.saturating_sub(1)..=index;
        let after = index + 1..(index + 3).min(marks.len());
        near && before.into_iter().any(|one| after.clone().any(|other| is_on(one, other)))
    };
    let ends = (0..marks.len()).filter(move |&index| index + 1 == marks.len() || !goes_on(index));
    ends.scan(0, move |start, index| Some(&marks[std::mem::replace(start, index + 1)..=index]))
}
