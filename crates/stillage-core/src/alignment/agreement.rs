//! How well two maps agree under a motion.
//!
//! Each surface point of one map that lies on known ground of the other either touches a surface there, or does not.
//! Counted in both directions, so that what is new and what is gone count alike. Cost: O(points).

use rayon::prelude::*;

use super::refine::contact;
use super::surfaces::Surfaces;
use crate::geometry::hash::{split_mix, unit};
use crate::geometry::{RigidMotion, Vector};
use crate::grid::Occupancy;

/// Distance within which surfaces touch, metres, where cells are small.
const TOUCH_M: f64 = 0.1;
/// The same in cells, where they are large: those beside one another.
const TOUCH_CELLS: f64 = 1.1;

/// Fewest points of walls in either map that count by themselves.
const LEAST_WALL_POINTS: usize = 50;

/// Distance within which surfaces of two maps touch, metres.
pub(super) fn touch(maps: [&Surfaces<'_>; 2]) -> f64 {
    let cell = maps.into_iter().map(|map| map.grid.resolution()).fold(0.0, f64::max);
    (cell * TOUCH_CELLS).max(TOUCH_M)
}

/// Share of surfaces that would touch if those of one map were strewn over the known ground of the other, as they are
/// turned now: much where cells are large and surfaces many.
pub(super) fn chance(maps: [&Surfaces<'_>; 2], points: [&[usize]; 2], turn: f64) -> f64 {
    let [from, to] = maps;
    let motion = |turn| RigidMotion { shift: Vector::zeros(), turn };
    let one_way = |from: &Surfaces<'_>, to: &Surfaces<'_>, points: &[usize], motion: RigidMotion| {
        let known = to.grid.cells().iter().enumerate().filter(|(_, cell)| **cell != Occupancy::Unknown);
        let known: Vec<usize> = known.map(|(cell, _)| cell).collect();
        let touches = |&&index: &&usize| {
            let cell = known[(unit(split_mix(index as u64)) * known.len() as f64) as usize];
            let place = to.grid.center(cell % to.grid.width(), cell / to.grid.width());
            let found = contact(to, place, motion.turned(from.normals[index]));
            found.is_some_and(|found| found.distance <= touch(maps))
        };
        points.iter().filter(touches).count() as f64 / points.len().max(1) as f64
    };
    f64::midpoint(one_way(from, to, points[0], motion(turn)), one_way(to, from, points[1], motion(-turn)))
}

/// Counts of surface points.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Tally {
    /// They touch a surface of the other map.
    pub touching: f64,
    /// They stand on known ground of the other map where it has no surface.
    pub missing: f64,
    /// They lie where the other map knows nothing.
    pub outside: f64,
    /// Sum of squared distances along the normals of those that touch, square metres.
    squares: f64,
}

impl Tally {
    /// Counts the points of both maps, those of walls by themselves and all together with the same weight: walls stay,
    /// goods move, and some sites have no walls.
    pub fn of_walls_and_all(maps: [&Surfaces<'_>; 2], points: [&[usize]; 2], motion: &RigidMotion) -> Self {
        let walls = [0, 1].map(|map| -> Vec<usize> {
            points[map].iter().copied().filter(|&index| maps[map].is_wall[index]).collect()
        });
        let all = Self::of(maps, points, motion);
        if walls.iter().any(|walls| walls.len() < LEAST_WALL_POINTS) {
            return all;
        }
        all.plus(Self::of(maps, [&walls[0], &walls[1]], motion)).scaled(0.5)
    }

    /// Counts the points of both maps, given by index, under a motion of the first onto the second.
    fn of(maps: [&Surfaces<'_>; 2], points: [&[usize]; 2], motion: &RigidMotion) -> Self {
        let [from, to] = maps;
        let there = Self::one_way(from, to, points[0], motion);
        let back = Self::one_way(to, from, points[1], &motion.inverse());
        // Each map counts the same, however fine its cells are.
        let share = |tally: Self, points: &[usize]| tally.scaled(0.5 / points.len().max(1) as f64);
        share(there, points[0]).plus(share(back, points[1]))
    }

    fn one_way(from: &Surfaces<'_>, to: &Surfaces<'_>, points: &[usize], motion: &RigidMotion) -> Self {
        let touch = touch([from, to]);
        let tally = |&index: &usize| Self::of_point(from, to, index, motion, touch);
        // Collected in order: a sum in any other would depend on the threads.
        let tallies: Vec<Self> = points.par_iter().map(tally).collect();
        tallies.into_iter().fold(Self::default(), Self::plus)
    }

    /// Counts one point of `from`, given by index; `touch` in metres.
    pub fn of_point(from: &Surfaces<'_>, to: &Surfaces<'_>, index: usize, motion: &RigidMotion, touch: f64) -> Self {
        let moved = motion.apply(from.points[index]);
        let found = contact(to, moved, motion.turned(from.normals[index])).filter(|found| found.distance <= touch);
        let is_known = || {
            let cell = to.grid.cell_at(moved);
            cell.is_some_and(|(column, row)| to.grid.at(column as i64, row as i64) != Occupancy::Unknown)
        };
        match found {
            Some(found) => Self { touching: 1.0, squares: found.offset.powi(2), ..Self::default() },
            None if is_known() => Self { missing: 1.0, ..Self::default() },
            None => Self { outside: 1.0, ..Self::default() },
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            touching: self.touching + other.touching,
            missing: self.missing + other.missing,
            outside: self.outside + other.outside,
            squares: self.squares + other.squares,
        }
    }

    fn scaled(self, by: f64) -> Self {
        Self {
            touching: self.touching * by,
            missing: self.missing * by,
            outside: self.outside * by,
            squares: self.squares * by,
        }
    }

    /// Share of the points on ground that both maps know which touch, 0 to 1.
    pub fn agreement(&self) -> f64 {
        self.touching / (self.touching + self.missing).max(f64::MIN_POSITIVE)
    }

    /// Share of the points on ground that both maps know, 0 to 1.
    pub fn overlap(&self) -> f64 {
        let known = self.touching + self.missing;
        known / (known + self.outside).max(f64::MIN_POSITIVE)
    }

    /// Root mean square distance of those that touch, metres.
    pub fn residual(&self) -> f64 {
        (self.squares / self.touching.max(f64::MIN_POSITIVE)).sqrt()
    }

    /// What motions are ranked by: agreement where both maps know the ground, more of it before less.
    pub fn rank(&self) -> f64 {
        self.touching - self.missing / 2.0
    }
}
