//! Rows of equal marks, and the borders between their places.
//!
//! Marks much shorter than the pitch are frames: they stand on the borders. Longer ones stand in the places, between two
//! borders, and so do two marks of each place.

use super::faces::{self, FacedRow};
use super::mark_lattice::Pitch;
use super::mark_run::{DEEP_M, MarkRun};
use super::range::{length, middle};
use crate::geometry::{OrientedBox, Point, direction, normal};

/// Marks at most this long are frames, in pitches.
const FRAME_SHARE: f64 = 0.4;
/// Least number of places of a row by itself: two may be equal by chance.
const LEAST_PLACES: usize = 3;
/// Least length of things in places, in pitches: what is further apart are stacks on a floor.
const FILLED_SHARE: f64 = 0.6;
/// Rows back to back nearer than this touch, metres.
const FLUE_M: f64 = 0.3;

/// A row and the borders of its places.
#[derive(Debug, Clone)]
pub(crate) struct MarkedRow {
    pub frame: RowFrame,
    /// Place across the row, metres from the origin of the grid.
    pub across: [f64; 2],
    /// Borders along the row, metres from the origin of the grid; ascending, both ends included.
    pub borders: Vec<f64>,
    /// Whether its marks stand on the borders: frames are there where places are empty.
    pub has_frames: bool,
    pub(super) counts: MarkCounts,
}

/// The direction of a row.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RowFrame {
    pub region: u8,
    /// The first direction of the region, radians.
    pub angle: f64,
    /// 0 for a row along the first direction, 1 for one across it.
    pub axis: usize,
}

/// What a row stands for.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct MarkCounts {
    /// Number of things that are as long as most, or as several side by side.
    pub explained: usize,
    /// Number of the others.
    pub irregular: usize,
    /// Number of runs of marks.
    pub runs: usize,
    /// Number of marks that the row would have without empty places.
    pub full: usize,
}

impl MarkCounts {
    fn of(runs: &[MarkRun]) -> Self {
        let sum = |part: fn(&MarkRun) -> usize| runs.iter().map(part).sum();
        Self { explained: sum(|run| run.regular), irregular: sum(|run| run.irregular), runs: runs.len(), full: 0 }
    }

    /// Those of several rows together.
    pub fn of_rows<'a>(rows: impl IntoIterator<Item = &'a MarkedRow>) -> Self {
        rows.into_iter().map(|row| row.counts).fold(Self::default(), |one, other| Self {
            explained: one.explained + other.explained,
            irregular: one.irregular + other.irregular,
            runs: one.runs + other.runs,
            full: one.full + other.full,
        })
    }
}

impl MarkedRow {
    /// Distance from place to place, metres.
    pub(super) fn pitch(&self) -> f64 {
        length(self.along()) / self.count() as f64
    }

    /// Whether it is evidence by itself.
    pub(super) fn is_long(&self) -> bool {
        self.count() >= LEAST_PLACES
    }

    /// Number of its places.
    pub(crate) fn count(&self) -> usize {
        self.borders.len() - 1
    }

    fn of(row: &FacedRow, frame: RowFrame, pitch: Pitch) -> Option<Self> {
        let most = row.runs.iter().max_by_key(|run| run.marks.len())?;
        let first = row.runs.iter().map(|run| run.ends()[0]).min_by(f64::total_cmp)?;
        let last = row.runs.iter().map(|run| run.ends()[1]).max_by(f64::total_cmp)?;
        let usual = most.usual;
        let is_frame = usual <= FRAME_SHARE * pitch.length && most.phases.len() == 1;
        let phase = match most.phases[..] {
            [phase] if is_frame => phase,
            [phase] => phase + pitch.length / 2.0,
            [one, two] => between(one, two, [first, last], pitch),
            _ => return None,
        };
        let is_sparse = length(row.across) == length(most.across) && !is_frame && usual < FILLED_SHARE * pitch.length;
        if most.phases.len() == 1 && is_sparse {
            return None;
        }
        let number = |place: f64| (place - phase) / pitch.length;
        let (low, high) = if is_frame {
            (number(first).round(), number(last).round())
        } else {
            (number(first).floor(), number(last).ceil())
        };
        let borders: Vec<f64> = (low as i64..=high as i64).map(|number| phase + number as f64 * pitch.length).collect();
        let full = (borders.len() - 1) * row.runs.len() * most.phases.len();
        let counts = MarkCounts { full, ..MarkCounts::of(&row.runs) };
        (borders.len() > 1).then_some(Self { frame, across: row.across, borders, has_frames: is_frame, counts })
    }

    /// The box around it, metres of the grid.
    pub(crate) fn bounds(&self) -> OrientedBox {
        let RowFrame { angle, axis, .. } = self.frame;
        let mut sides = [self.along(), self.across];
        if axis == 1 {
            sides.swap(0, 1);
        }
        let [u, v] = sides.map(middle);
        let half_extents = sides.map(|side| length(side) / 2.0);
        OrientedBox { center: Point::from(direction(angle) * u + normal(angle) * v), half_extents, angle }
    }

    /// The same row with as many more places as it takes to reach some ends, metres.
    pub(super) fn up_to(&self, [low, high]: [f64; 2]) -> Self {
        let (pitch, [first, last]) = (self.pitch(), self.along());
        let places = |length: f64| (length / pitch).round().max(0.0) as i64;
        let numbers = -places(first - low)..=self.count() as i64 + places(high - last);
        Self { borders: numbers.map(|number| first + number as f64 * pitch).collect(), ..self.clone() }
    }

    /// From its first border to the last one.
    pub(crate) fn along(&self) -> [f64; 2] {
        [self.borders[0], self.borders[self.borders.len() - 1]]
    }
}

/// Where the borders of places with two marks are, given by the phases of these: between the last mark of a place and the
/// first one of the next. `ends` are the first and the last mark of a row.
fn between(one: f64, two: f64, ends: [f64; 2], pitch: Pitch) -> f64 {
    let is_two = ends.map(|end| pitch.off(end, two).abs() < pitch.off(end, one).abs());
    let [first, last] = match is_two {
        [false, true] => [one, two],
        [true, false] => [two, one],
        // A mark at an end is missing: the marks of neighbours are nearer to each other.
        _ if (two - one).rem_euclid(pitch.length) > pitch.length / 2.0 => [one, two],
        _ => [two, one],
    };
    last + (first - last).rem_euclid(pitch.length) / 2.0
}

/// The rows of some runs at a pitch.
pub(super) fn of_runs(runs: Vec<MarkRun>, frame: RowFrame, pitch: Pitch) -> Vec<MarkedRow> {
    let (deep, thin): (Vec<MarkRun>, Vec<MarkRun>) = runs.into_iter().partition(|run| length(run.across) >= DEEP_M);
    let mut rows: Vec<FacedRow> =
        deep.into_iter().map(|run| FacedRow { across: run.across, runs: vec![run] }).collect();
    rows.extend(faces::paired(thin));
    let mut found: Vec<MarkedRow> = rows.iter().filter_map(|row| MarkedRow::of(row, frame, pitch)).collect();
    close_flues(&mut found);
    found
}

/// Makes rows back to back meet in the middle between them.
fn close_flues(rows: &mut [MarkedRow]) {
    rows.sort_by(|one, other| one.across[0].total_cmp(&other.across[0]));
    for high in 0..rows.len() {
        for low in 0..high {
            let (one, two) = (rows[low].along(), rows[high].along());
            let is_beside = one[0] < two[1] && two[0] < one[1];
            let flue = [rows[low].across[1], rows[high].across[0]];
            if is_beside && flue[0] < flue[1] && length(flue) <= FLUE_M {
                (rows[low].across[1], rows[high].across[0]) = (middle(flue), middle(flue));
            }
        }
    }
}
