//! Strips of free ground before the two long sides of a row.
//!
//! From every cell of a front a line leads away from the row to where the free ground ends. Neighbouring lines of about one
//! length are a strip. Cost: O(cells of the strips).

use std::ops::Range;

use super::chains::Chain;
use super::strip::Strip;
use crate::geometry::{Point, direction, normal};

/// Widest aisle, metres: two trucks pass each other, and block storage is served across it.
const WIDEST_M: f64 = 6.0;
/// Narrowest aisle, metres: robots that carry pods need 0.8.
const NARROWEST_M: f64 = 0.75;
/// Least length of an aisle in widths.
const LEAST_LENGTH: f64 = 1.5;
/// Ground this near to a front may still be part of what stands there, metres.
const ROUGH_M: f64 = 0.4;
/// Lines of a strip differ from its width by at most this: metres, and a share of the width.
const LEVEL_M: f64 = 0.25;
const LEVEL_SHARE: f64 = 0.1;
/// Longest gap in a strip, metres: that of the rows beside it.
const GAP_M: f64 = super::chains::GAP_M;

/// What lies at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ground {
    /// Free ground of the hall.
    Free,
    /// Anything that ends it.
    Closed,
}

/// The strips before both long sides of a row; `step` is the side of a cell, metres.
pub(super) fn strips(chain: &Chain, step: f64, ground: impl Fn(Point) -> Ground) -> Vec<Strip> {
    let (along, across) = (direction(chain.angle), normal(chain.angle));
    let count = ((chain.along[1] - chain.along[0]) / step).ceil().max(1.0) as usize;
    let place = |index: usize| chain.along[0] + (index as f64 + 0.5) * step;
    let mut found = Vec::new();
    for (front, sign) in [(chain.across[0], -1.0), (chain.across[1], 1.0)] {
        let reach = |index: usize| {
            let at = |depth: f64| ground(Point::from(along * place(index) + across * (front + sign * depth)));
            let depths = |from: f64, to: f64| {
                let steps = ((to - from) / step).max(0.0) as usize;
                (0..=steps).map(move |number| from + number as f64 * step)
            };
            let start = depths(step / 2.0, ROUGH_M).find(|&depth| at(depth) == Ground::Free)?;
            depths(start, WIDEST_M + step).find(|&depth| at(depth) == Ground::Closed)
        };
        let reaches: Vec<Option<f64>> = (0..count).map(reach).collect();
        for (range, width) in level_runs(&reaches, step) {
            let sides = [front, front + sign * width];
            let strip = Strip {
                angle: chain.angle,
                along: [place(range.start) - step / 2.0, place(range.end - 1) + step / 2.0],
                across: [sides[0].min(sides[1]), sides[0].max(sides[1])],
            };
            found.push(strip);
        }
    }
    found
}

/// Whether a strip may be an aisle.
pub(super) fn is_aisle(strip: &Strip) -> bool {
    (NARROWEST_M..=WIDEST_M).contains(&strip.width()) && strip.length() >= LEAST_LENGTH * strip.width()
}

/// Runs of lines of about one length, with that length: the longest run first, then those beside it.
fn level_runs(reaches: &[Option<f64>], step: f64) -> Vec<(Range<usize>, f64)> {
    let mut found = Vec::new();
    let mut open: Vec<Range<usize>> = Vec::new();
    open.push(0..reaches.len());
    let gap = (GAP_M / step) as usize;
    while let Some(range) = open.pop() {
        let mut lengths: Vec<f64> =
            reaches[range.clone()].iter().flatten().copied().filter(|&length| length >= NARROWEST_M).collect();
        if lengths.is_empty() {
            continue;
        }
        lengths.sort_by(f64::total_cmp);
        let usual = most_common(&lengths);
        let is_level = |index: &usize| {
            reaches[*index].is_some_and(|length| (length - usual).abs() <= LEVEL_M + LEVEL_SHARE * usual)
        };
        let mut best = range.start..range.start;
        let mut run: Option<Range<usize>> = None;
        for index in range.clone().filter(is_level) {
            let next = match run.take() {
                Some(run) if index - run.end <= gap => run.start..index + 1,
                _ => index..index + 1,
            };
            if next.len() > best.len() {
                best = next.clone();
            }
            run = Some(next);
        }
        if best.is_empty() {
            continue;
        }
        let mut level: Vec<f64> = best.clone().filter(is_level).filter_map(|index| reaches[index]).collect();
        level.sort_by(f64::total_cmp);
        let width = level[level.len() / 2];
        open.extend([range.start..best.start, best.end..range.end].into_iter().filter(|rest| !rest.is_empty()));
        found.push((best, width));
    }
    found
}

/// The length that most lines have, within the tolerance; `lengths` ascend.
fn most_common(lengths: &[f64]) -> f64 {
    let (mut best, mut most, mut end) = (lengths[0], 0, 0);
    for (start, &length) in lengths.iter().enumerate() {
        while end < lengths.len() && lengths[end] <= length + LEVEL_M {
            end += 1;
        }
        if end - start > most {
            (best, most) = (lengths[(start + end - 1) / 2], end - start);
        }
    }
    best
}
