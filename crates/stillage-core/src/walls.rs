//! Walls: occupied cells that are connected over many metres.
//!
//! Goods and racks are short components or rows of dots; a wall is long, straight and thin, and outshines them in every
//! projection. Where a stage asks how goods stand, walls are left out. Cost: O(cells). Limits: goods that touch one
//! another over many metres are taken for walls, so no stage relies on what is left alone.

use crate::grid::{Occupancy, OccupancyGrid};
use crate::watch::{Stopped, Watch};

/// Components longer than this are walls, metres: two pallets in a row are shorter.
const WALL_M: f64 = 4.0;

/// For every cell, row-major, whether it is part of a wall.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub(crate) fn find(grid: &OccupancyGrid, watch: &Watch<'_>) -> Result<Vec<bool>, Stopped> {
    let (width, height) = (grid.width(), grid.height());
    let mut is_seen = vec![false; width * height];
    let mut is_wall = vec![false; width * height];
    let long = WALL_M / grid.resolution();
    let (mut open, mut members) = (Vec::new(), Vec::new());
    for row in 0..height {
        watch.check()?;
        for column in 0..width {
            if is_seen[row * width + column] || grid.cells()[row * width + column] != Occupancy::Occupied {
                continue;
            }
            is_seen[row * width + column] = true;
            open.push((column, row));
            members.clear();
            let (mut low, mut high) = ([column, row], [column, row]);
            while let Some((column, row)) = open.pop() {
                members.push(row * width + column);
                low = [low[0].min(column), low[1].min(row)];
                high = [high[0].max(column), high[1].max(row)];
                for row in row.saturating_sub(1)..height.min(row + 2) {
                    for column in column.saturating_sub(1)..width.min(column + 2) {
                        let near = row * width + column;
                        if !is_seen[near] && grid.cells()[near] == Occupancy::Occupied {
                            is_seen[near] = true;
                            open.push((column, row));
                        }
                    }
                }
            }
            let size = [high[0] - low[0], high[1] - low[1]].map(|side| side as f64);
            if size[0].hypot(size[1]) > long {
                for &cell in &members {
                    is_wall[cell] = true;
                }
            }
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
