//! Walls: occupied cells that are connected over many metres.
//!
//! Goods and racks are short components or rows of dots. A wall is long, straight and thin, and has more energy than
//! they have in every projection, so stages that look for the directions of goods leave walls out. Cost: O(cells).
//! Limits: goods that touch one another over many metres count as walls, so no stage relies on the other cells alone.

use crate::components::{Components, Neighbours};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::watch::{Stopped, Watch};

/// Length above which a component is a wall, metres: two pallets in a row are shorter.
const WALL_M: f64 = 4.0;

/// For every cell, row-major, whether it is part of a wall.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub(crate) fn find(grid: &OccupancyGrid, watch: &Watch<'_>) -> Result<Vec<bool>, Stopped> {
    let (cells, long) = (grid.cells(), WALL_M / grid.resolution());
    let is_occupied = |cell: usize| cells[cell] == Occupancy::Occupied;
    let mut is_wall = vec![false; cells.len()];
    for component in Components::of([grid.width(), cells.len()], Neighbours::Eight, is_occupied, watch)?.iter() {
        if component.diagonal() > long {
            component.cells().for_each(|cell| is_wall[cell] = true);
        }
    }
    Ok(is_wall)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_long_is_wall() {
        let grid = OccupancyGrid::from_ascii(
            "
            ######...
            .......##
            .........
            ",
            1.0,
        );
        let walls = find(&grid, &Watch::unwatched()).expect("nobody stops it");
        assert_eq!(walls.iter().filter(|&&is_wall| is_wall).count(), 6);
        assert!(find(&OccupancyGrid::from_ascii("", 0.1), &Watch::unwatched()).expect("nobody stops it").is_empty());
    }
}
