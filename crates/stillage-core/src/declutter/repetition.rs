//! Whether small things stand in rows at equal distances, as posts do and speckle does not.
//!
//! A thing is in a row if the step from it to one of its nearest neighbours leads from there, or back from the thing, to a
//! third one. Independent hits
//! do so by chance, the more often the denser they are, and just as often where the step is turned by an angle that no rows
//! have. So the share of things with a third one after a turned step is subtracted. Cost: O(n log n) for n things, as long as
//! they are spread evenly.

use std::collections::BTreeMap;

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

/// Share of some things, metres, that stand in rows, less that by chance; `cell` is the side of a cell, metres.
pub(super) fn share_in_rows(things: &[Point], cell: f64) -> f64 {
    let bucket = |point: &Point| [(point.x / STEP_M).floor() as i64, (point.y / STEP_M).floor() as i64];
    let mut buckets: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for (index, thing) in things.iter().enumerate() {
        buckets.entry(bucket(thing)).or_default().push(index);
    }
    let around = |point: Point| {
        let [column, row] = bucket(&point);
        (-1..=1).flat_map(move |across| (-1..=1).map(move |up| [column + across, row + up]))
    };
    let near = |point: Point| around(point).filter_map(|bucket| buckets.get(&bucket)).flatten().copied();
    let turned = |step: Vector, turn: f64| direction(turn) * step.x + normal(turn) * step.y;
    let is_in_row = |index: usize, turn: f64| {
        let thing = things[index];
        let mut neighbours: Vec<(f64, usize)> = near(thing)
            .filter(|&other| other != index)
            .map(|other| ((things[other] - thing).norm(), other))
            .filter(|(distance, _)| *distance <= STEP_M)
            .collect();
        neighbours.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
        neighbours.iter().take(NEIGHBOURS).any(|&(_, other)| {
            let step = turned(things[other] - thing, turn);
            [things[other] + step, thing - step]
                .into_iter()
                .any(|third| near(third).any(|at| at != other && (things[at] - third).norm() <= TOLERANCE_CELLS * cell))
        })
    };
    let sample: Vec<usize> = (0..things.len()).step_by(things.len().div_ceil(SAMPLE).max(1)).collect();
    let share =
        |turn: f64| sample.iter().filter(|&&index| is_in_row(index, turn)).count() as f64 / sample.len().max(1) as f64;
    share(0.0) - share(TURN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::hash::{split_mix, unit};

    #[test]
    fn posts_stand_in_rows_and_speckle_does_not() {
        let posts: Vec<Point> =
            (0..40).map(|post| Point::new(f64::from(post % 10) * 1.4, f64::from(post / 10) * 2.1)).collect();
        assert!(share_in_rows(&posts, 0.05) > 0.99);
        let number = |index: u64| 20.0 * unit(split_mix(index));
        let speckle: Vec<Point> = (0..400).map(|hit| Point::new(number(2 * hit), number(2 * hit + 1))).collect();
        assert!(share_in_rows(&speckle, 0.05) < 0.1);
        assert!(share_in_rows(&speckle, 0.3) < 0.1, "of cells as coarse as the hits are dense");
        assert!(share_in_rows(&[], 0.05) < 0.01);
    }
}
