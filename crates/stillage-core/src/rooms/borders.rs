//! The borders of the rooms as straight segments.
//!
//! The sides of cells between two rooms, or between a room and none, form chains that end where three of them meet.
//! Each chain is simplified once for both rooms beside it, so that rooms neither overlap nor leave a gap. Method: D.
//! Douglas and T. Peucker 1973. Cost: O(cells + b log b) for b sides of cells on the border; the simplification of a
//! chain that winds all along is quadratic in its length. Limits: rooms narrower than the tolerance may vanish.

use std::collections::BTreeMap;

use crate::geometry::{Point, segment};
use crate::watch::{Stopped, Watch};

/// Greatest distance of a dropped corner from the segment that replaces it, metres: the roughness of scanned walls.
const TOLERANCE_M: f64 = 0.1;

/// Traces the borders between cells of different rooms; points in metres of the grid frame.
pub(super) fn segments(rooms: &[u32], width: usize, cell: f64, watch: &Watch<'_>) -> Result<Vec<[Point; 2]>, Stopped> {
    let corners = Corners::of(rooms, width, watch)?;
    let tolerance = TOLERANCE_M / cell;
    let mut segments = Vec::new();
    for chain in corners.chains(watch)? {
        let point = |corner: [i64; 2]| Point::new(corner[0] as f64 * cell, corner[1] as f64 * cell);
        let kept = simplified(&chain, tolerance, watch)?;
        // A ring that is left with two points encloses nothing: it was smaller than the tolerance.
        if kept.len() > 3 || kept[0] != kept[kept.len() - 1] {
            segments.extend(kept.windows(2).map(|ends| [point(ends[0]), point(ends[1])]));
        }
    }
    Ok(segments)
}

/// Corners of cells on a border, with the directions in which it goes on: bits 0 to 3 for right, up, left, down.
struct Corners(BTreeMap<[i64; 2], u8>);

const STEPS: [[i64; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

impl Corners {
    fn of(rooms: &[u32], width: usize, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let height = rooms.len().checked_div(width).unwrap_or(0);
        let at = |column: Option<usize>, row: Option<usize>| match (column, row) {
            (Some(column), Some(row)) if column < width && row < height => rooms[row * width + column],
            _ => 0,
        };
        let mut corners = BTreeMap::new();
        let mut side = |from: [usize; 2], direction: usize| {
            let from = from.map(|place| place as i64);
            let to = [from[0] + STEPS[direction][0], from[1] + STEPS[direction][1]];
            *corners.entry(from).or_default() |= 1 << direction;
            *corners.entry(to).or_default() |= 1 << (direction + 2);
        };
        for row in 0..=height {
            watch.check()?;
            for column in 0..=width {
                let here = at(Some(column), Some(row));
                if here != at(Some(column), row.checked_sub(1)) {
                    side([column, row], 0);
                }
                if here != at(column.checked_sub(1), Some(row)) {
                    side([column, row], 1);
                }
            }
        }
        Ok(Self(corners))
    }

    /// Chains of corners from one branching to the next, and rings without any.
    fn chains(mut self, watch: &Watch<'_>) -> Result<Vec<Vec<[i64; 2]>>, Stopped> {
        let branchings: Vec<[i64; 2]> =
            self.0.iter().filter(|(_, ways)| ways.count_ones() != 2).map(|(&corner, _)| corner).collect();
        let is_branching = |corner: &[i64; 2]| branchings.binary_search(corner).is_ok();
        let mut chains = Vec::new();
        for &start in &branchings {
            watch.check()?;
            while let Some(chain) = self.walk(start, is_branching) {
                chains.push(chain);
            }
        }
        let corners: Vec<[i64; 2]> = self.0.keys().copied().collect();
        for start in corners {
            while let Some(ring) = self.walk(start, |&corner| corner == start) {
                chains.push(from_a_corner(ring));
            }
        }
        Ok(chains)
    }

    /// Follows a chain from a corner to its end, and removes the sides on the way.
    fn walk(&mut self, start: [i64; 2], is_end: impl Fn(&[i64; 2]) -> bool) -> Option<Vec<[i64; 2]>> {
        let mut chain = vec![start];
        let mut at = start;
        loop {
            let ways = self.0.get_mut(&at).filter(|ways| **ways != 0)?;
            let direction = ways.trailing_zeros() as usize;
            *ways &= !(1 << direction);
            at = [at[0] + STEPS[direction][0], at[1] + STEPS[direction][1]];
            if let Some(ways) = self.0.get_mut(&at) {
                *ways &= !(1 << ((direction + 2) % 4));
            }
            chain.push(at);
            if is_end(&at) {
                return Some(chain);
            }
        }
    }
}

/// Turns a ring so that it begins at the point farthest from where it began, which is a true corner of the room.
fn from_a_corner(mut ring: Vec<[i64; 2]>) -> Vec<[i64; 2]> {
    let start = ring[0];
    ring.pop();
    let squared = |point: &[i64; 2]| (point[0] - start[0]).pow(2) + (point[1] - start[1]).pow(2);
    let farthest = (0..ring.len()).max_by_key(|&index| squared(&ring[index])).unwrap_or(0);
    ring.rotate_left(farthest);
    ring.push(ring[0]);
    ring
}

/// The points of a chain whose segments stay within a tolerance of all others.
fn simplified(chain: &[[i64; 2]], tolerance: f64, watch: &Watch<'_>) -> Result<Vec<[i64; 2]>, Stopped> {
    let last = chain.len() - 1;
    let mut is_kept = vec![false; chain.len()];
    (is_kept[0], is_kept[last]) = (true, true);
    let mut waiting = vec![(0, last)];
    while let Some((start, end)) = waiting.pop() {
        watch.check()?;
        let farthest = (start + 1..end)
            .map(|index| (index, distance(chain[index], chain[start], chain[end])))
            .reduce(|best, other| if other.1 > best.1 { other } else { best });
        if let Some((index, distance)) = farthest
            && distance > tolerance
        {
            is_kept[index] = true;
            waiting.extend([(start, index), (index, end)]);
        }
    }
    Ok(chain.iter().zip(is_kept).filter(|&(_, is_kept)| is_kept).map(|(&corner, _)| corner).collect())
}

/// Distance of a corner from the segment between two others.
fn distance(corner: [i64; 2], start: [i64; 2], end: [i64; 2]) -> f64 {
    let from_start = |to: [i64; 2]| Point::new((to[0] - start[0]) as f64, (to[1] - start[1]) as f64);
    segment::distance(from_start(corner), [Point::origin(), from_start(end)])
}
