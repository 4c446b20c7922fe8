//! The plane cut into square tiles, and the portals between them.
//!
//! Method: hierarchical path finding (A. Botea, M. Müller and J. Schaeffer, *Near optimal hierarchical path-finding*,
//! 2004). Along the border of two tiles, cells that can be driven across and along each other form a run; every run gets
//! portals, one for every few cells of its length. Whatever path crosses the border crosses a run, so no way is lost.

use std::ops::Range;

use super::drive_grid::DriveGrid;

/// Side of a tile, cells: a tile has 4,096 cells, which a search crosses in some microseconds and a cache holds.
pub(super) const TILE: usize = 64;
/// Greatest distance between two portals of a run, cells: half a side. With 16, a search takes half as long again, and
/// paths pulled tight are 0.3 % shorter in the mean.
const SPACING: usize = 32;

/// A border between two tiles: the right one of a tile (even) or the upper one (odd).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Border(pub usize);

/// Tiles by column and row, numbered row by row from below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct SearchTiles {
    pub columns: usize,
    pub rows: usize,
    /// Cells of a row of the grid, and rows of the grid.
    cells: [usize; 2],
}

impl SearchTiles {
    pub fn of(grid: &DriveGrid) -> Self {
        let cells = [grid.width, grid.height];
        let [columns, rows] = cells.map(|cells| cells.div_ceil(TILE));
        Self { columns, rows, cells }
    }

    pub fn count(&self) -> usize {
        self.columns * self.rows
    }

    pub fn of_cell(&self, cell: usize) -> usize {
        let (column, row) = (cell % self.cells[0], cell / self.cells[0]);
        row / TILE * self.columns + column / TILE
    }

    /// Whether a cell lies beside another tile, or would if there were one.
    pub fn is_on_border(&self, cell: usize) -> bool {
        let on_side = |place: usize| place.is_multiple_of(TILE) || place % TILE == TILE - 1;
        on_side(cell % self.cells[0]) || on_side(cell / self.cells[0])
    }

    /// Columns and rows of the cells of a tile.
    pub fn window(&self, tile: usize) -> [Range<usize>; 2] {
        let range = |place: usize, count: usize| place * TILE..((place + 1) * TILE).min(count);
        [range(tile % self.columns, self.cells[0]), range(tile / self.columns, self.cells[1])]
    }

    /// The tiles on both sides of a border; `None` at the end of the grid.
    pub fn sides(&self, border: Border) -> Option<[usize; 2]> {
        let tile = border.0 / 2;
        let is_upper = border.0 % 2 == 1;
        let has_neighbour =
            if is_upper { tile / self.columns + 1 < self.rows } else { tile % self.columns + 1 < self.columns };
        has_neighbour.then(|| [tile, if is_upper { tile + self.columns } else { tile + 1 }])
    }

    /// The borders of a tile: right, upper, left, lower.
    pub fn borders(&self, tile: usize) -> impl Iterator<Item = Border> + use<> {
        let left = (!tile.is_multiple_of(self.columns)).then(|| Border(2 * (tile - 1)));
        let lower = (tile >= self.columns).then(|| Border(2 * (tile - self.columns) + 1));
        [Some(Border(2 * tile)), Some(Border(2 * tile + 1)), left, lower].into_iter().flatten()
    }

    /// The portals of a border: the cell on the side of its first tile and the one beyond.
    pub fn portals(&self, grid: &DriveGrid, border: Border) -> Vec<[u32; 2]> {
        if self.sides(border).is_none() {
            return Vec::new();
        }
        let [columns, rows] = self.window(border.0 / 2);
        let width = self.cells[0];
        let is_upper = border.0 % 2 == 1;
        // The cells of the first tile along the border, the step along it and the step across it.
        let (first, count, along, across) = if is_upper {
            ((rows.end - 1) * width + columns.start, columns.len(), 1, width)
        } else {
            (rows.start * width + columns.end - 1, rows.len(), width, 1)
        };
        let pair = |place: usize| [first + place * along, first + place * along + across];
        let is_open = |place: usize| {
            let [near, far] = pair(place);
            grid.fits(near) && grid.fits(far) && grid.allows(near, far)
        };
        let goes_on = |place: usize| {
            let ([near, far], [next_near, next_far]) = (pair(place - 1), pair(place));
            grid.allows(near, next_near) && grid.allows(far, next_far)
        };
        let mut portals = Vec::new();
        let mut place = 0;
        while place < count {
            if !is_open(place) {
                place += 1;
                continue;
            }
            let start = place;
            place += 1;
            while place < count && is_open(place) && goes_on(place) {
                place += 1;
            }
            portals.extend(spread(start..place).map(|place| pair(place).map(|cell| cell as u32)));
        }
        portals
    }
}

/// Places along a run, no more than [`SPACING`] apart and away from its ends.
fn spread(run: Range<usize>) -> impl Iterator<Item = usize> {
    let count = run.len().div_ceil(SPACING);
    (0..count).map(move |index| run.start + run.len() * (2 * index + 1) / (2 * count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn portals_are_spread_over_a_run() {
        let places = |run| spread(run).collect::<Vec<_>>();
        assert_eq!((places(3..4), places(0..16), places(0..64)), (vec![3], vec![8], vec![16, 48]));
    }
}
