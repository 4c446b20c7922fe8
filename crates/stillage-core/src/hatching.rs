//! Hatched areas are solid.
//!
//! Drawings show what is solid by lines across it. Between these lines and the outline lie small holes of free cells that
//! nothing enters. A hole thinner than any place is part of what encloses it; bays and pallets that are drawn by their outline
//! are wider. A few such holes are none: a scan has some by chance. Cost: O(cells).

use crate::components::{Component, Components, Neighbours};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::watch::{Stopped, Watch};

/// No place is thinner than this, metres: half a pallet.
const THINNEST_PLACE_M: f64 = 0.6;
/// Longest hole of a hatching, metres: lines at 45 degrees across two rows back to back.
const LONGEST_M: f64 = 4.5;
/// Holes below this are what a scan leaves of things, square metres.
const LEAST_HOLE_M2: f64 = 0.02;
/// In coarser cells a line is as wide as the goods, metres.
const COARSEST_CELL_M: f64 = 0.12;
/// Least number of holes of a hatching.
const LEAST_HOLES: usize = 12;

/// The grid with its hatched areas solid; `None` where there are none.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub(crate) fn solid(grid: &OccupancyGrid, watch: &Watch<'_>) -> Result<Option<OccupancyGrid>, Stopped> {
    if grid.resolution() > COARSEST_CELL_M {
        return Ok(None);
    }
    let size = [grid.width(), grid.cells().len()];
    let parts = Components::of(size, Neighbours::Four, |cell| grid.cells()[cell] == Occupancy::Free, watch)?;
    let holes: Vec<Component<'_>> = parts.iter().filter(|&part| is_thin(part, grid)).collect();
    if holes.len() < LEAST_HOLES {
        return Ok(None);
    }
    let mut cells = grid.cells().to_vec();
    holes.into_iter().flat_map(|hole| hole.cells()).for_each(|cell| cells[cell] = Occupancy::Occupied);
    Ok(Some(OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), cells)))
}

/// Whether a hole is too thin for a place.
fn is_thin(part: Component<'_>, grid: &OccupancyGrid) -> bool {
    let cell = grid.resolution();
    let [columns, rows] = part.bounds();
    let touches_border =
        columns.start == 0 || rows.start == 0 || columns.end == grid.width() || rows.end == grid.height();
    if touches_border || part.diagonal() * cell > LONGEST_M || part.len() as f64 * cell * cell < LEAST_HOLE_M2 {
        return false;
    }
    part.smallest_box(cell).sides()[1] < THINNEST_PLACE_M
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rack of 1.2 m with lines across it, and a row of three outlined places of 0.9 by 0.8 m; a cell is 0.1 m.
    const DRAWING: &str = "
        .............................................
        .##########################################..
        .#.##.##.##.##.##.##.##.##.##.##.##.##.##.#..
        .#.##.##.##.##.##.##.##.##.##.##.##.##.##.#..
        .#.##.##.##.##.##.##.##.##.##.##.##.##.##.#..
        .##########################################..
        .............................................
        ..###############################............
        ..#.........#.........#.........#............
        ..#.........#.........#.........#............
        ..#.........#.........#.........#............
        ..#.........#.........#.........#............
        ..#.........#.........#.........#............
        ..#.........#.........#.........#............
        ..#.........#.........#.........#............
        ..###############################............
        .............................................
        ";

    #[test]
    fn holes_thinner_than_a_place_are_solid() {
        let grid = OccupancyGrid::from_ascii(DRAWING, 0.1);
        let solid = solid(&grid, &Watch::unwatched()).expect("nobody stops it").expect("it is hatched");
        let row = |row: usize| -> String {
            let cell = |&cell: &Occupancy| if cell == Occupancy::Free { '.' } else { '#' };
            solid.row(grid.height() - 1 - row).iter().map(cell).collect()
        };
        assert_eq!(row(3), ".##########################################..");
        assert_eq!(row(10), "..#.........#.........#.........#............");
    }

    #[test]
    fn a_few_holes_are_none() {
        let few: String = DRAWING.replace(".##.##.##", "#########");
        let grid = OccupancyGrid::from_ascii(&few, 0.1);
        assert_eq!(solid(&grid, &Watch::unwatched()).expect("nobody stops it"), None);
    }
}
