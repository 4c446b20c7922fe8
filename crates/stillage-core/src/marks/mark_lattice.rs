//! The lattice of marks in one line: a pitch, and where the marks of each place stand.
//!
//! A lattice has one mark for each place, or two: the legs of a pod. Marks longer than most of their line are several that
//! touch, or one and a column: either end may be on the lattice. A mark on it gains; a place without a mark costs, and so
//! does a mark off it. Cost: O(marks x log marks).

use std::collections::BTreeSet;

use super::range::length;

/// Tolerance of a place on the lattice: a share of the pitch, and metres or cells.
const TOLERANCE_SHARE: f64 = 0.02;
const TOLERANCE_M: f64 = 0.05;
const TOLERANCE_CELLS: f64 = 1.0;
/// Least share of the marks that a lattice with one mark for each place explains, and one with two.
pub(super) const EXPLAINED: f64 = 0.75;
const EXPLAINED_BY_TWO: f64 = 0.85;
/// Least share of the marks that each of two explains.
const LEAST_OF_TWO: f64 = 0.3;
/// What a second mark for each place costs, a place without a mark, and a mark off the lattice; a mark on it gains 1.
const SECOND_COST: f64 = 2.0;
const MISSING_COST: f64 = 0.4;
const STRAY_COST: f64 = 0.7;
/// Least share of the places that have marks.
const SEEN: f64 = 0.45;
/// Equal marks differ in length by at most this, metres.
const REGULAR_M: f64 = 0.1;
/// Two marks of each place begin and end in the same place, or in the next one but one, where a mark is missing.
const SAME_PLACE: i64 = 2;
/// Longest marks, in pitches: the box around a turned thing is a little longer than the thing.
const LONGEST_SHARE: f64 = 1.1;
/// Least number of marks.
const LEAST_MARKS: usize = 2;

/// A distance from place to place, and how far a mark may stand off, metres.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pitch {
    pub length: f64,
    pub tolerance: f64,
}

impl Pitch {
    /// `cell` is the side of a cell of the grid, metres.
    pub fn new(length: f64, cell: f64) -> Self {
        Self { length, tolerance: TOLERANCE_SHARE * length + TOLERANCE_M.max(TOLERANCE_CELLS * cell) }
    }

    /// Distance of a place from the nearest one of a lattice with a phase, with its sign.
    pub fn off(self, place: f64, phase: f64) -> f64 {
        place - phase - self.length * ((place - phase) / self.length).round()
    }

    /// Whether a place lies on it within the tolerance.
    pub fn is_on(self, place: f64, phase: f64) -> bool {
        self.off(place, phase).abs() <= self.tolerance
    }
}

/// A lattice and how well it explains some marks.
#[derive(Debug, Clone, Default)]
pub(super) struct MarkLattice {
    /// Where the middles of marks lie from the lattice's zero, in [0, pitch): one, or two where each place has two.
    pub phases: Vec<f64>,
    /// Number of marks on the lattice.
    pub explained: f64,
    /// What it explains, less what it does not.
    pub score: f64,
}

impl MarkLattice {
    /// The lattice of some marks, of which most have the `usual` length.
    pub fn of(marks: &[[f64; 2]], usual: f64, pitch: Pitch, is_thin: bool) -> Self {
        if marks.len() < LEAST_MARKS || usual > LONGEST_SHARE * pitch.length {
            return Self::default();
        }
        let all = marks.len() as f64;
        let first = fullest(marks.iter().flat_map(|&mark| middles(mark, usual)), pitch);
        let rest: Vec<[f64; 2]> =
            marks.iter().copied().filter(|&mark| on_lattice(mark, usual, first, pitch).is_none()).collect();
        let on_first = all - rest.len() as f64;
        let (mut phases, mut explained) = (vec![first], on_first);
        if on_first < EXPLAINED * all {
            let second = fullest(rest.iter().flat_map(|&mark| middles(mark, usual)), pitch);
            let on_second =
                rest.iter().filter(|&&mark| on_lattice(mark, usual, second, pitch).is_some()).count() as f64;
            explained += on_second;
            phases.push(second);
            let is_two = is_thin && explained >= EXPLAINED_BY_TWO * all && on_second >= LEAST_OF_TWO * all;
            if !is_two {
                return Self::default();
            }
        }
        let numbers = |&phase: &f64| -> BTreeSet<i64> {
            marks.iter().filter_map(|&mark| on_lattice(mark, usual, phase, pitch)).flatten().collect()
        };
        let numbers: Vec<BTreeSet<i64>> = phases.iter().map(numbers).collect();
        let seen: usize = numbers.iter().map(BTreeSet::len).sum();
        let firsts: Vec<i64> = numbers.iter().filter_map(|numbers| numbers.first().copied()).collect();
        let lasts: Vec<i64> = numbers.iter().filter_map(|numbers| numbers.last().copied()).collect();
        let (low, high) = (firsts.iter().min().copied().unwrap_or(0), lasts.iter().max().copied().unwrap_or(0));
        let differ = |ends: &[i64]| ends.iter().any(|end| (end - ends[0]).abs() > SAME_PLACE);
        if differ(&firsts) || differ(&lasts) {
            return Self::default();
        }
        let places = (high - low + 1) as f64 * phases.len() as f64;
        let seen = seen as f64;
        if seen < SEEN * places {
            return Self::default();
        }
        let second = SECOND_COST * (phases.len() - 1) as f64;
        Self {
            phases,
            explained,
            score: seen - MISSING_COST * (places - seen) - STRAY_COST * (all - explained) - second,
        }
    }

    /// Whether a mark stands on it.
    pub fn explains(&self, mark: [f64; 2], usual: f64, pitch: Pitch) -> bool {
        self.phases.iter().any(|&phase| on_lattice(mark, usual, phase, pitch).is_some())
    }
}

/// Whether a mark is as long as most, or as several side by side at a pitch.
pub(super) fn is_regular(mark: [f64; 2], usual: f64, pitch: Pitch) -> bool {
    pitch.off(length(mark), usual).abs() <= REGULAR_M
}

/// Where the first and the last of the marks have their middle that a mark stands for.
pub(super) fn middles(mark: [f64; 2], usual: f64) -> [f64; 2] {
    [mark[0] + usual / 2.0, mark[1] - usual / 2.0]
}

/// The numbers of the places of a lattice that a mark stands for; `None` for one off the lattice.
fn on_lattice(mark: [f64; 2], usual: f64, phase: f64, pitch: Pitch) -> Option<std::ops::RangeInclusive<i64>> {
    let [first, last] = middles(mark, usual)
        .map(|place| (pitch.is_on(place, phase)).then(|| ((place - phase) / pitch.length).round() as i64));
    match (first, last) {
        (Some(first), Some(last)) => Some(first..=last.max(first)),
        (one, other) => one.or(other).map(|number| number..=number),
    }
}

/// The phase that most places have, within the tolerance: the mean of theirs; 0 without places.
fn fullest(places: impl Iterator<Item = f64>, pitch: Pitch) -> f64 {
    let mut phases: Vec<f64> = places.map(|place| place - pitch.length * (place / pitch.length).floor()).collect();
    phases.sort_by(f64::total_cmp);
    let count = phases.len();
    let reach = 2.0 * pitch.tolerance;
    // Phases go round: those behind the last one are the first ones again.
    let phase = |index: usize| phases[index % count] + if index < count { 0.0 } else { pitch.length };
    let (mut best, mut most, mut end, mut sum) = (0.0, 0, 0, 0.0);
    for start in 0..count {
        while end < start + count && phase(end) - phase(start) <= reach {
            sum += phase(end);
            end += 1;
        }
        if end - start > most {
            most = end - start;
            best = sum / most as f64;
        }
        sum -= phase(start);
    }
    best.rem_euclid(pitch.length)
}
