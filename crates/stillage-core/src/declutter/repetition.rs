//! Whether small things stand in rows at equal distances, as posts do and speckle does not.
//!
//! A thing is in a row if the step from it to one of its nearest neighbours leads from there, or back from the thing, to a
//! third one. Independent hits do so by chance, the more often the denser they are, and just as often where the step is turned
//! by an angle that no rows have. So the share of things with a third one after a turned step is subtracted. Where many places
//! are empty, the step within one place still is the same for all. Cost: O(n log n) for n things, as long as they are spread
//! evenly.

use std::collections::{BTreeMap, BTreeSet};

use crate::geometry::{Point, Vector, direction, normal};

/// Longest step, metres: no bay is wider.
const STEP_M: f64 = 3.5;
/// Neighbours that are tried for each thing: those on both sides along the row and across it, and the next row's.
const NEIGHBOURS: usize = 8;
/// How far the third one may stand beside the place that the step leads to, cells: both steps are rounded.
const TOLERANCE_CELLS: f64 = 1.6;
/// Angle of the turned step, radians: not near to that between two diagonals of rows.
const TURN: f64 = 0.65;
/// Things that are looked at, evenly spread.
const SAMPLE: usize = 1_000;

/// Things, metres, by square buckets of a step.
pub(super) struct Repetition<'a> {
    things: &'a [Point],
    /// Side of a cell, metres.
    cell: f64,
    buckets: BTreeMap<[i64; 2], Vec<usize>>,
}

impl<'a> Repetition<'a> {
    /// `cell` is the side of a cell, metres.
    pub(super) fn of(things: &'a [Point], cell: f64) -> Self {
        let mut buckets: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
        for (index, thing) in things.iter().enumerate() {
            buckets.entry(bucket(*thing)).or_default().push(index);
        }
        Self { things, cell, buckets }
    }

    /// Share of the things that stand in rows, less that by chance.
    pub(super) fn share_in_rows(&self) -> f64 {
        let turned = |step: Vector, turn: f64| direction(turn) * step.x + normal(turn) * step.y;
        let is_near = |other: usize, place: Point| (self.things[other] - place).norm() <= self.tolerance();
        let is_in_row = |&index: &usize, turn: f64| {
            let thing = self.things[index];
            let mut neighbours: Vec<(f64, usize)> =
                self.steps(index).map(|(other, step)| (step.norm(), other)).collect();
            neighbours.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
            neighbours.iter().take(NEIGHBOURS).any(|&(_, other)| {
                let step = turned(self.things[other] - thing, turn);
                let thirds = [self.things[other] + step, thing - step];
                thirds.into_iter().any(|third| self.near(third).any(|at| at != other && is_near(at, third)))
            })
        };
        let sample = self.sample();
        let share = |turn: f64| {
            sample.iter().filter(|&index| is_in_row(index, turn)).count() as f64 / sample.len().max(1) as f64
        };
        share(0.0) - share(TURN)
    }

    /// Share of the things from which the step that most of them have in common leads to another one, forth or back, less
    /// that by chance.
    pub(super) fn share_with_common_step(&self) -> f64 {
        let sample = self.sample();
        let mut counts: BTreeMap<[i64; 2], usize> = BTreeMap::new();
        for &index in &sample {
            let far = self.steps(index).filter(|(_, step)| step.norm() > 2.0 * self.tolerance());
            // Steps in cells, without their sign, and those a cell beside.
            let forth = far.map(|(_, step)| if (step.x, step.y) < (0.0, 0.0) { -step } else { step });
            let cells = forth.map(|step| [step.x, step.y].map(|side| (side / self.cell).round() as i64));
            let beside = |[x, y]: [i64; 2]| (x - 1..=x + 1).flat_map(move |x| (y - 1..=y + 1).map(move |y| [x, y]));
            for step in cells.flat_map(beside).collect::<BTreeSet<_>>() {
                *counts.entry(step).or_default() += 1;
            }
        }
        let most = counts.values().copied().max().unwrap_or(0) as f64;
        // Steps at random are spread over a half disc.
        let spread = std::f64::consts::FRAC_PI_2 * (STEP_M / self.cell).powi(2);
        let chance = counts.values().sum::<usize>() as f64 / spread.max(1.0);
        (most - chance) / sample.len().max(1) as f64
    }

    fn tolerance(&self) -> f64 {
        TOLERANCE_CELLS * self.cell
    }

    /// Numbers of the things that are looked at.
    fn sample(&self) -> Vec<usize> {
        (0..self.things.len()).step_by(self.things.len().div_ceil(SAMPLE).max(1)).collect()
    }

    /// Numbers of the things in the buckets around a place.
    fn near(&self, place: Point) -> impl Iterator<Item = usize> {
        let [column, row] = bucket(place);
        let around =
            (column - 1..=column + 1).flat_map(move |column| (row - 1..=row + 1).map(move |row| [column, row]));
        around.filter_map(|bucket| self.buckets.get(&bucket)).flatten().copied()
    }

    /// The steps from a thing to its neighbours, with the numbers of these.
    fn steps(&self, index: usize) -> impl Iterator<Item = (usize, Vector)> {
        let thing = self.things[index];
        let others = self.near(thing).filter(move |&other| other != index);
        others.map(move |other| (other, self.things[other] - thing)).filter(|(_, step)| step.norm() <= STEP_M)
    }
}

fn bucket(place: Point) -> [i64; 2] {
    [place.x, place.y].map(|side| (side / STEP_M).floor() as i64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::hash::{split_mix, unit};

    #[test]
    fn posts_stand_in_rows_and_speckle_does_not() {
        let posts: Vec<Point> =
            (0..40).map(|post| Point::new(f64::from(post % 10) * 1.4, f64::from(post / 10) * 2.1)).collect();
        assert!(Repetition::of(&posts, 0.05).share_in_rows() > 0.99);
        let number = |index: u64| 20.0 * unit(split_mix(index));
        let speckle: Vec<Point> = (0..400).map(|hit| Point::new(number(2 * hit), number(2 * hit + 1))).collect();
        assert!(Repetition::of(&speckle, 0.05).share_in_rows() < 0.1);
        assert!(Repetition::of(&speckle, 0.3).share_in_rows() < 0.1, "of cells as coarse as the hits are dense");
        assert!(Repetition::of(&[], 0.05).share_in_rows() < 0.01);
    }

    #[test]
    fn legs_of_pods_have_a_step_in_common_however_many_places_are_empty() {
        let is_full = |pod: u32| unit(split_mix(u64::from(pod))) > 0.4;
        let pods =
            (0..80).filter(|&pod| is_full(pod)).map(|pod| (f64::from(pod % 10) * 1.2, f64::from(pod / 10) * 2.7));
        let legs: Vec<Point> = pods
            .flat_map(|(x, y)| {
                [(0.0, 0.0), (0.9, 0.0), (0.0, 0.8), (0.9, 0.8)].map(|leg| Point::new(x + leg.0, y + leg.1))
            })
            .collect();
        let share = Repetition::of(&legs, 0.05).share_with_common_step();
        assert!(share > 0.6, "{share}");
        let number = |index: u64| 20.0 * unit(split_mix(index));
        let speckle: Vec<Point> = (0..400).map(|hit| Point::new(number(2 * hit), number(2 * hit + 1))).collect();
        assert!(Repetition::of(&speckle, 0.05).share_with_common_step() < 0.3);
        assert!(Repetition::of(&[], 0.05).share_with_common_step() < 0.01);
    }
}
