//! Strips of ground between two walls.
//!
//! A strip begins where the two ends of neighbouring runs stay in place over some lines. From there it is followed both
//! ways, line by line, and its sides follow the walls, for long walls of scans bend. Of all that, the stretch with most
//! walls is kept.

use std::ops::Range;

use super::cross_lines::{CrossLine, GroundRun};
use crate::geometry::{Point, direction, normal};
use crate::watch::{Stopped, Watch};

/// Least and greatest width, metres: one person, and two trucks that pass each other.
const WIDTHS_M: [f64; 2] = [1.0, 4.0];
/// Least length in widths, and in metres. No measurement is recorded for these values.
const LEAST_LENGTH: f64 = 4.0;
const LEAST_LENGTH_M: f64 = 6.0;
/// Greatest distance of a wall from where it was seen before, metres: the roughness of scanned walls.
const STRAY_M: f64 = 0.12;
/// A strip begins where both walls are seen over this length, metres.
const SEED_M: f64 = 0.5;
/// A strip ends after this length without a wall, metres: rooms that open widely on both sides are shorter.
const UNSEEN_M: f64 = 6.0;
/// Least share of the width that is free: a wall across it leaves a door at most.
const LEAST_FREE: f64 = 0.3;
/// Least share of the length over which each wall is seen. No measurement is recorded for this value.
const LEAST_SEEN: f64 = 0.25;
/// What each line counts against a strip, in walls that are seen on it: a length without walls is made up for by the same
/// length with one.
const LINE_COUNTS: f64 = 0.5;
/// Share by which the place of a wall follows what is seen of it on the next line.
const FOLLOWED: f64 = 0.1;
/// A passage ends at most this far before the next one, metres. No measurement is recorded for this value.
const MEETING_M: f64 = 1.0;
/// Least width of a doorway across a passage that parts nothing, in widths of the passage: doors in fire walls are narrower.
const AS_WIDE: f64 = 0.8;

/// A strip of ground along a direction.
pub(super) struct PassageStrip {
    /// The direction, radians.
    pub angle: f64,
    /// Of each line its place along the direction, and those of its two sides across it, metres.
    pub lines: Vec<(f64, [f64; 2])>,
}

impl PassageStrip {
    /// Whether a point lies in the strip, or shortly before its ends.
    pub(super) fn is_met_at(&self, point: Point) -> bool {
        let place = direction(self.angle).dot(&point.coords);
        let [first, last] = self.ends();
        let sides = self.sides_at(place);
        (first - MEETING_M..last + MEETING_M).contains(&place)
            && (sides[0]..sides[1]).contains(&normal(self.angle).dot(&point.coords))
    }

    /// Whether a line leads across the strip, away from its ends, from one wall to the other.
    pub(super) fn is_crossed_by(&self, ends: [Point; 2]) -> bool {
        let (along, across) = (direction(self.angle), normal(self.angle));
        let (way, middle) = (ends[1] - ends[0], nalgebra::center(&ends[0], &ends[1]));
        let place = along.dot(&middle.coords);
        let ([first, last], sides) = (self.ends(), self.sides_at(place));
        let width = sides[1] - sides[0];
        (first + width..last - width).contains(&place)
            && (sides[0]..sides[1]).contains(&across.dot(&middle.coords))
            && across.dot(&way).abs() >= (AS_WIDE * width).max(along.dot(&way).abs())
    }

    /// The places of its first and its last line along the direction, metres.
    fn ends(&self) -> [f64; 2] {
        [self.lines[0].0, self.lines[self.lines.len() - 1].0]
    }

    /// Its sides at a place along the direction, or at the end that is nearer to it.
    fn sides_at(&self, place: f64) -> [f64; 2] {
        let line = self.lines.partition_point(|&(along, _)| along < place);
        self.lines[line.min(self.lines.len() - 1)].1
    }
}

/// One line of a strip that is followed.
#[derive(Debug, Clone, Copy)]
struct StripLine {
    line: usize,
    sides: [f64; 2],
    is_seen: [bool; 2],
}

impl StripLine {
    fn sees_both(&self) -> bool {
        self.is_seen == [true, true]
    }
}

/// The strips on the lines across a direction, `angle` in radians; `cell` is the side of a cell, metres.
pub(super) fn find(
    lines: &[CrossLine],
    angle: f64,
    cell: f64,
    watch: &Watch<'_>,
) -> Result<Vec<PassageStrip>, Stopped> {
    let mut seeds = seeds(lines, (SEED_M / cell).ceil() as usize);
    seeds.sort_by_key(|seed| std::cmp::Reverse(seed.len()));
    let mut is_taken: Vec<Vec<bool>> = lines.iter().map(|line| vec![false; line.runs.len()]).collect();
    let mut strips = Vec::new();
    for seed in seeds {
        watch.check()?;
        let holds = |step: &StripLine, run: &GroundRun| {
            let middle = f64::midpoint(step.sides[0], step.sides[1]);
            run.ends[0] < middle && middle < run.ends[1]
        };
        let runs_of = |step: &StripLine| lines[step.line].runs.iter().position(|run| holds(step, run));
        if seed.iter().any(|step| runs_of(step).is_some_and(|run| is_taken[step.line][run])) {
            continue;
        }
        let mut steps = followed(lines, &seed, (UNSEEN_M / cell).ceil() as usize);
        for step in &steps {
            if let Some(run) = runs_of(step) {
                is_taken[step.line][run] = true;
            }
        }
        let range = best_stretch(&steps);
        steps = steps[range].to_vec();
        if is_passage(&steps, cell) {
            interpolate(&mut steps);
            let lines = steps.iter().map(|step| (lines[step.line].along, step.sides)).collect();
            strips.push(PassageStrip { angle, lines });
        }
    }
    Ok(strips)
}

/// Stretches of at least so many lines on which the two ends of a run stay in place and are walls.
fn seeds(lines: &[CrossLine], least: usize) -> Vec<Vec<StripLine>> {
    let may_be_passage =
        |run: &GroundRun| run.is_wall == [true, true] && (WIDTHS_M[0]..=WIDTHS_M[1]).contains(&run.width());
    let mut found = Vec::new();
    // The stretches that reach the last line, each with the mean of its sides.
    let mut open: Vec<(Vec<StripLine>, [f64; 2])> = Vec::new();
    for (line, cross_line) in lines.iter().enumerate() {
        let mut next = Vec::new();
        for run in cross_line.runs.iter().filter(|run| may_be_passage(run)) {
            let stays = |(_, sides): &(Vec<StripLine>, [f64; 2])| {
                [0, 1].into_iter().all(|side| (run.ends[side] - sides[side]).abs() <= STRAY_M)
            };
            let (mut seed, mut sides) = match open.iter().position(stays) {
                Some(index) => open.swap_remove(index),
                None => (Vec::new(), run.ends),
            };
            seed.push(StripLine { line, sides: run.ends, is_seen: [true, true] });
            let share = FOLLOWED.max(1.0 / seed.len() as f64);
            for (side, end) in sides.iter_mut().zip(run.ends) {
                *side += share * (end - *side);
            }
            next.push((seed, sides));
        }
        found.extend(std::mem::replace(&mut open, next).into_iter().map(|(seed, _)| seed));
    }
    found.extend(open.into_iter().map(|(seed, _)| seed));
    found.retain(|seed| seed.len() >= least);
    found
}

/// A strip from a seed on both ways, until so many lines show no wall, or none of them is free.
fn followed(lines: &[CrossLine], seed: &[StripLine], unseen: usize) -> Vec<StripLine> {
    let mean = |side: usize| seed.iter().map(|step| step.sides[side]).sum::<f64>() / seed.len() as f64;
    let sides = [mean(0), mean(1)];
    let [first, last] = [seed[0].line, seed[seed.len() - 1].line];
    let mut steps = follow(lines, (0..first).rev(), sides, unseen);
    steps.reverse();
    steps.extend(seed);
    steps.extend(follow(lines, last + 1..lines.len(), sides, unseen));
    steps
}

fn follow(lines: &[CrossLine], way: impl Iterator<Item = usize>, mut sides: [f64; 2], unseen: usize) -> Vec<StripLine> {
    let mut steps: Vec<StripLine> = Vec::new();
    let mut last_seen = 0;
    for line in way {
        let (middle, width) = (f64::midpoint(sides[0], sides[1]), sides[1] - sides[0]);
        let overlap = |run: &GroundRun| (run.ends[1].min(sides[1]) - run.ends[0].max(sides[0])).max(0.0);
        let free: f64 = lines[line].runs.iter().map(overlap).sum();
        if free < LEAST_FREE * width || steps.len() - last_seen > unseen {
            break;
        }
        let mut step = StripLine { line, sides, is_seen: [false, false] };
        if let Some(run) = lines[line].runs.iter().find(|run| run.ends[0] < middle && middle < run.ends[1]) {
            for side in [0, 1] {
                if run.is_wall[side] && (run.ends[side] - sides[side]).abs() <= STRAY_M {
                    step.is_seen[side] = true;
                    step.sides[side] = run.ends[side];
                    sides[side] += FOLLOWED * (run.ends[side] - sides[side]);
                }
            }
        }
        steps.push(step);
        if step.is_seen.contains(&true) {
            last_seen = steps.len();
        }
    }
    steps
}

/// The stretch with most walls on its lines (the maximum sum of a range, J. Bentley 1984), from where both walls are seen
/// first to where both are seen last.
fn best_stretch(steps: &[StripLine]) -> Range<usize> {
    let (mut best, mut most) = (0..0, 0.0);
    let (mut start, mut sum) = (0, 0.0);
    for (index, step) in steps.iter().enumerate() {
        sum += step.is_seen.iter().filter(|&&is_seen| is_seen).count() as f64 - LINE_COUNTS;
        if sum <= 0.0 {
            (start, sum) = (index + 1, 0.0);
        } else if sum > most {
            (best, most) = (start..index + 1, sum);
        }
    }
    let both = |&index: &usize| steps[index].sees_both();
    let [first, last] = [best.clone().find(both), best.clone().rev().find(both)];
    first.zip(last).map_or(0..0, |(first, last)| first..last + 1)
}

/// Whether a stretch is long enough, and both its walls are seen over enough of it.
fn is_passage(steps: &[StripLine], cell: f64) -> bool {
    let Some(first) = steps.first() else { return false };
    let (length, width) = (steps.len() as f64 * cell, first.sides[1] - first.sides[0]);
    let is_seen_enough =
        |side: usize| steps.iter().filter(|step| step.is_seen[side]).count() as f64 >= LEAST_SEEN * steps.len() as f64;
    length >= LEAST_LENGTH_M.max(LEAST_LENGTH * width) && is_seen_enough(0) && is_seen_enough(1)
}

/// Where a wall is not seen it leads straight from where it was seen last to where it is seen next.
fn interpolate(steps: &mut [StripLine]) {
    for side in [0, 1] {
        let seen: Vec<usize> = (0..steps.len()).filter(|&index| steps[index].is_seen[side]).collect();
        for pair in seen.windows(2) {
            let [from, to] = [steps[pair[0]].sides[side], steps[pair[1]].sides[side]];
            let lines = pair[1] - pair[0];
            for (number, step) in steps[pair[0]..pair[1]].iter_mut().enumerate() {
                step.sides[side] = from + (to - from) * number as f64 / lines as f64;
            }
        }
    }
}
