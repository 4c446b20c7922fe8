//! The ground around a building, whatever it is painted with: unknown, as where nobody painted it.
//!
//! Drawings and cleaned-up scans paint what lies outside black or white. A person sees that it is outside: it is one
//! large piece of one value that holds most of the border of the map, and walls part it from the rest. Here it is what
//! discs wider than a gate cover that are moved in from beyond the border over cells of that value only (the opening of
//! G. Matheron, 1975, and what is connected with the border), and a little more in the corners. White ground is outside
//! only if there is a building: walls line most of its rim, and a good part of the free ground lies behind them. Of black
//! ground a wall stays. All stages see the result, so nothing can be found outside.
//!
//! Cost: O(border) for maps whose border is unknown for the most part, else O(cells). Limits: white ground behind an
//! opening wider than a gate is outside; goods longer than a gate is wide that stand along a wall before black ground are
//! taken for that ground.

use std::collections::VecDeque;

use crate::components::{Components, Neighbours};
use crate::distance_transform::DistanceTransform;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::watch::{Stopped, Watch};

/// Side of a coarse cell, metres: less than gaps between goods.
const COARSE_M: f64 = 0.25;
/// Diameter of the discs, metres: wider than gates, which have up to 4.
const DISC_M: f64 = 4.5;
/// How far the ground goes on beyond the discs, metres: into corners, and up to walls that no disc touches, but hardly
/// through a gate.
const CORNER_M: f64 = 0.5;
/// Thickness of the wall that stays of black ground, metres: that of walls in drawings.
const WALL_M: f64 = 0.15;
/// Least share of the border of the map with the value of the ground around: the majority.
const BORDER_SHARE: f64 = 0.5;
/// Greatest share of the rim of white ground that lies open: gates. In a hall whose own floor reaches the border, the
/// aisles between its racks open to it along a fifth of the rim and more.
const OPEN_SHARE: f64 = 0.1;
/// Least share of all free cells that lies in the building. No measurement is recorded for this value.
const INSIDE_SHARE: f64 = 0.2;

/// Ground around a building that was not unknown.
pub(crate) struct PaintedGround {
    /// The grid with that ground unknown.
    pub grid: OccupancyGrid,
    /// What it was painted with.
    pub painted: Occupancy,
    /// How many cells it has.
    pub cells: usize,
}

/// Finds the painted ground around a building; `None` where there is none.
pub(crate) fn find(grid: &OccupancyGrid, watch: &Watch<'_>) -> Result<Option<PaintedGround>, Stopped> {
    let Some(painted) = value_of_border(grid) else { return Ok(None) };
    let mut is_outside = swept(grid, painted, watch)?;
    let reach = cells_of(CORNER_M, grid);
    spread(grid, painted, &mut is_outside, reach);
    if painted == Occupancy::Free {
        if !surrounds_a_building(grid, &is_outside) {
            return Ok(None);
        }
    } else {
        keep_walls(grid, &mut is_outside, watch)?;
    }
    let cells = is_outside.iter().filter(|&&is_outside| is_outside).count();
    if cells == 0 {
        return Ok(None);
    }
    let occupancy = grid.cells().iter().zip(&is_outside);
    let occupancy = occupancy.map(|(&cell, &is_outside)| if is_outside { Occupancy::Unknown } else { cell }).collect();
    let grid = OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), occupancy);
    Ok(Some(PaintedGround { grid, painted, cells }))
}

fn cells_of(metres: f64, grid: &OccupancyGrid) -> usize {
    ((metres / grid.resolution()).round() as usize).max(1)
}

/// The value, free or occupied, of most of the cells along the border of the map.
fn value_of_border(grid: &OccupancyGrid) -> Option<Occupancy> {
    let (width, height) = (grid.width() as i64, grid.height() as i64);
    let level = (0..width).flat_map(|column| [(column, 0), (column, height - 1)]);
    let upright = (0..height).flat_map(|row| [(0, row), (width - 1, row)]);
    let mut counts = [0_usize; 3];
    level.chain(upright).for_each(|(column, row)| counts[grid.at(column, row) as usize] += 1);
    let all: usize = counts.iter().sum();
    [Occupancy::Free, Occupancy::Occupied]
        .into_iter()
        .find(|&value| counts[value as usize] as f64 > BORDER_SHARE * all as f64)
}

/// The cells that discs cover which come in from beyond the border over cells of one value, in coarse cells.
fn swept(grid: &OccupancyGrid, painted: Occupancy, watch: &Watch<'_>) -> Result<Vec<bool>, Stopped> {
    let side = ((COARSE_M / grid.resolution()).round() as usize).max(1);
    let reach = DISC_M / 2.0 / (side as f64 * grid.resolution());
    let margin = reach.ceil() as usize + 2;
    let [columns, rows] = [grid.width(), grid.height()].map(|cells| cells.div_ceil(side) + 2 * margin);
    // Beyond the border all is painted alike.
    let mut is_painted = vec![true; columns * rows];
    let coarse = |column: usize, row: usize| (row / side + margin) * columns + column / side + margin;
    for row in 0..grid.height() {
        watch.check()?;
        for (column, _) in grid.row(row).iter().enumerate().filter(|&(_, &cell)| cell != painted) {
            is_painted[coarse(column, row)] = false;
        }
    }
    let is_far = |squared: u32| f64::from(squared) > reach * reach;
    let around = DistanceTransform::of(columns, is_painted.len(), |cell| !is_painted[cell], watch)?;
    let size = [columns, is_painted.len()];
    let middles = Components::of(size, Neighbours::Four, |cell| is_far(around.squared[cell]), watch)?;
    let mut is_middle = vec![false; is_painted.len()];
    if let Some(outer) = middles.iter().find(|middles| middles.first() == 0) {
        outer.cells().for_each(|cell| is_middle[cell] = true);
    }
    let covered = DistanceTransform::of(columns, is_painted.len(), |cell| is_middle[cell], watch)?;
    let mut is_outside = Vec::with_capacity(grid.cells().len());
    for row in 0..grid.height() {
        let is_covered = |cell: usize| is_painted[cell] && !is_far(covered.squared[cell]);
        is_outside.extend((0..grid.width()).map(|column| is_covered(coarse(column, row))));
    }
    Ok(is_outside)
}

/// Cells up, down, left and right of a cell that lie on the grid.
fn beside(grid: &OccupancyGrid, cell: usize) -> impl Iterator<Item = usize> + use<> {
    let (width, count) = (grid.width(), grid.cells().len());
    let left = (!cell.is_multiple_of(width)).then(|| cell - 1);
    let right = (!(cell + 1).is_multiple_of(width)).then_some(cell + 1);
    [left, right, cell.checked_sub(width), Some(cell + width).filter(|&above| above < count)].into_iter().flatten()
}

/// Adds cells of the same value that some steps lead to.
fn spread(grid: &OccupancyGrid, painted: Occupancy, is_outside: &mut [bool], reach: usize) {
    let mut open: VecDeque<(usize, usize)> =
        (0..is_outside.len()).filter(|&cell| is_outside[cell]).map(|cell| (cell, 0)).collect();
    while let Some((cell, steps)) = open.pop_front() {
        for near in beside(grid, cell).filter(|_| steps < reach) {
            if !is_outside[near] && grid.cells()[near] == painted {
                is_outside[near] = true;
                open.push_back((near, steps + 1));
            }
        }
    }
}

/// Whether walls line white ground, with free ground behind them.
fn surrounds_a_building(grid: &OccupancyGrid, is_outside: &[bool]) -> bool {
    let (mut walls, mut open, mut inside, mut free) = (0_usize, 0_usize, 0_usize, 0_usize);
    for (cell, _) in grid.cells().iter().enumerate().filter(|&(_, &cell)| cell == Occupancy::Free) {
        free += 1;
        if !is_outside[cell] {
            inside += 1;
            continue;
        }
        for near in beside(grid, cell).filter(|&near| !is_outside[near]) {
            match grid.cells()[near] {
                Occupancy::Occupied => walls += 1,
                Occupancy::Free => open += 1,
                Occupancy::Unknown => {}
            }
        }
    }
    open as f64 <= OPEN_SHARE * (walls + open) as f64 && inside as f64 >= INSIDE_SHARE * free as f64
}

/// Leaves a wall of black ground where it borders on the building.
fn keep_walls(grid: &OccupancyGrid, is_outside: &mut [bool], watch: &Watch<'_>) -> Result<(), Stopped> {
    let is_other = |cell: usize| grid.cells()[cell] != Occupancy::Occupied;
    let near = DistanceTransform::of(grid.width(), is_outside.len(), is_other, watch)?;
    let wall = cells_of(WALL_M, grid) as u32;
    for (is_outside, squared) in is_outside.iter_mut().zip(near.squared) {
        *is_outside &= squared > wall * wall;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;

    /// The map without its painted surroundings; a cell is 0.5 m.
    fn check(picture: &str, expected: &Expect) {
        let grid = OccupancyGrid::from_ascii(picture, 0.5);
        let found = find(&grid, &Watch::unwatched()).expect("nobody stops it");
        let found = found.as_ref().map_or(&grid, |found| &found.grid);
        let letter = |&cell: &Occupancy| match cell {
            Occupancy::Free => '.',
            Occupancy::Occupied => '#',
            Occupancy::Unknown => '?',
        };
        let rows: Vec<String> =
            (0..found.height()).rev().map(|row| found.row(row).iter().map(letter).collect()).collect();
        expected.assert_eq(&(rows.join("\n") + "\n"));
    }

    #[test]
    fn white_ground_around_a_building_is_unknown_up_to_its_gate() {
        check(
            "
            ........................
            ........................
            ...##################...
            ...#................#...
            ...#................#...
            ...#....#####.......#...
            ...#.....................
            ...#.....................
            ...#.....................
            ...#................#...
            ...##################...
            ........................
            ",
            &expect![[r#"
                ........................?
                ........................?
                ...##################...?
                ...#................#...?
                ...#................#...?
                ...#....#####.......#...?
                ...#.....................
                ...#.....................
                ...#.....................
                ...#................#...?
                ...##################...?
                ........................?
            "#]],
        );
    }

    #[test]
    fn of_black_ground_a_wall_stays() {
        check(
            "
            ####################
            ####################
            ####################
            ####............####
            ####............####
            ####......##....####
            ####......##....####
            ####............####
            ####............####
            ####################
            ####################
            ",
            &expect![[r#"
                ????????????????????
                ????????????????????
                ????############????
                ???#............#???
                ???#............#???
                ???#......##....#???
                ???#......##....#???
                ???#............#???
                ???#............#???
                ????############????
                ????????????????????
            "#]],
        );
    }

    #[test]
    fn floor_that_reaches_the_border_between_racks_is_no_surroundings() {
        let hall = "
            ........................
            ........................
            ..######..######..######
            ..######..######..######
            ........................
            ........................
            ..######..######..######
            ..######..######..######
            ........................
            ........................
            ";
        check(
            hall,
            &expect![[r#"
            ........................
            ........................
            ..######..######..######
            ..######..######..######
            ........................
            ........................
            ..######..######..######
            ..######..######..######
            ........................
            ........................
        "#]],
        );
    }
}
