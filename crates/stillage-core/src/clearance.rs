//! Clearance: how far the middle of a cell is from the nearest obstacle.
//!
//! Obstacles are the squares of cells that are occupied or unknown, and everything outside the grid. The distance is that
//! to the square, not to its middle: a disc of that radius around the middle of the cell touches no obstacle.
//!
//! Method: distances within columns by two sweeps, then the lower envelope of parabolas along each row (P. Felzenszwalb
//! and D. Huttenlocher 2012, doi 10.4086/toc.2012.v008a019). A square is half a cell nearer than its middle in both
//! directions, so each cell reads the envelope half a cell to its left and half a cell to its right. Cost: O(cells), rows
//! in parallel. Memory: 4 bytes per cell, 2 of them afterwards. Limits: sides below 32,768 cells; distances above 1,023
//! cells are cut.

use rayon::prelude::*;

use crate::geometry::Point;
use crate::grid::{Occupancy, OccupancyGrid};

/// Parts of a cell in which distances are kept, rounded down: of cells of 5 cm one is below a millimetre.
const STEPS_PER_CELL: f64 = 64.0;
/// Largest distance within a column, half cells.
const FARTHEST: u16 = u16::MAX - 2;

/// The clearance of every cell of a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Clearance {
    width: usize,
    resolution: f64,
    steps: Vec<u16>,
}

impl Clearance {
    /// Measures every cell.
    #[must_use]
    pub fn of(grid: &OccupancyGrid) -> Self {
        let width = grid.width();
        let columns = within_columns(grid);
        let mut steps = vec![0_u16; columns.len()];
        let lines = steps.par_chunks_mut(width.max(1)).zip(columns.par_chunks(width.max(1)));
        lines.for_each_init(Envelope::default, |envelope, (steps, heights)| {
            envelope.draw(heights);
            envelope.read(heights, steps);
        });
        Self { width, resolution: grid.resolution(), steps }
    }

    /// Clearance of a cell by its row-major index, metres: 0 where it is an obstacle itself.
    #[must_use]
    pub fn of_cell(&self, cell: usize) -> f64 {
        f64::from(self.steps[cell]) * (self.resolution / STEPS_PER_CELL)
    }

    /// Clearance of the cell that holds a point of the grid frame; 0 outside the grid.
    #[must_use]
    pub fn at(&self, point: Point) -> f64 {
        let [column, row] = [point.x, point.y].map(|place| (place / self.resolution).floor());
        let height = self.steps.len() / self.width.max(1);
        let is_inside = column >= 0.0 && row >= 0.0 && column < self.width as f64 && row < height as f64;
        if is_inside { self.of_cell(row as usize * self.width + column as usize) } else { 0.0 }
    }

    /// The least of the values of [`Self::steps`] at which a clearance in metres is kept.
    #[must_use]
    pub fn threshold(&self, clearance: f64) -> u16 {
        (clearance / self.resolution * STEPS_PER_CELL).ceil().clamp(1.0, f64::from(u16::MAX)) as u16
    }

    /// Clearances of all cells, row-major, in 64ths of a cell.
    #[must_use]
    pub fn steps(&self) -> &[u16] {
        &self.steps
    }
}

/// Distance from the middle of each cell to the nearest obstacle above or below it, half cells.
fn within_columns(grid: &OccupancyGrid) -> Vec<u16> {
    let width = grid.width();
    let mut distances = vec![0_u16; grid.cells().len()];
    // An obstacle in the next row begins half a cell from the middle; each further row adds a whole one.
    let next = |before: u16| if before == 0 { 1 } else { before.min(FARTHEST) + 2 };
    let outside = vec![0_u16; width];
    for row in 0..grid.height() {
        let (done, rest) = distances.split_at_mut(row * width);
        let before = if row == 0 { &outside[..] } else { &done[(row - 1) * width..] };
        for ((distance, &before), &cell) in rest.iter_mut().zip(before).zip(grid.row(row)) {
            *distance = if cell == Occupancy::Free { next(before) } else { 0 };
        }
    }
    for row in (0..grid.height()).rev() {
        let (rest, done) = distances.split_at_mut((row + 1) * width);
        let before = if done.is_empty() { &outside[..] } else { &done[..width] };
        for (distance, &before) in rest[row * width..].iter_mut().zip(before) {
            *distance = next(before).min(*distance);
        }
    }
    distances
}

/// The lower envelope of the parabolas of one row, in half cells.
#[derive(Default)]
struct Envelope {
    /// Middle and height of each parabola that is somewhere the lowest.
    parabolas: Vec<(i64, i64)>,
    /// Where each begins to be the lowest.
    starts: Vec<i64>,
}

impl Envelope {
    /// Draws the parabolas of all cells of a row, and of the obstacles at both of its ends.
    fn draw(&mut self, heights: &[u16]) {
        self.parabolas.clear();
        self.starts.clear();
        self.add(-2, 0);
        for (column, &height) in heights.iter().enumerate() {
            self.add(2 * column as i64, i64::from(height) * i64::from(height));
        }
        self.add(2 * heights.len() as i64, 0);
    }

    fn add(&mut self, middle: i64, height: i64) {
        let mut start = i64::MIN;
        while let Some(&(other, lowest)) = self.parabolas.last() {
            // From here on the new parabola is lower than the last one.
            let rise = (height + middle * middle) - (lowest + other * other);
            start = rise.div_euclid(2 * (middle - other)) + 1;
            if start > *self.starts.last().expect("each parabola has a start") {
                break;
            }
            self.parabolas.pop();
            self.starts.pop();
            start = i64::MIN;
        }
        self.parabolas.push((middle, height));
        self.starts.push(start);
    }

    /// Writes the distance of each cell of the row.
    fn read(&self, heights: &[u16], steps: &mut [u16]) {
        let mut at = 0;
        let mut lowest = |place: i64| {
            while self.starts.get(at + 1).is_some_and(|&start| start <= place) {
                at += 1;
            }
            let (middle, height) = self.parabolas[at];
            (place - middle) * (place - middle) + height
        };
        let mut left = lowest(-1);
        for (column, (&own, step)) in heights.iter().zip(steps).enumerate() {
            let right = lowest(2 * column as i64 + 1);
            let squared = left.min(right).min(i64::from(own) * i64::from(own));
            left = right;
            *step = ((squared as f64).sqrt() * (STEPS_PER_CELL / 2.0)).min(f64::from(u16::MAX)) as u16;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Distance from the middle of a free cell to the nearest square of an obstacle, cells.
    fn nearest(grid: &OccupancyGrid, column: i64, row: i64) -> f64 {
        let reach = -1..=(grid.width().max(grid.height()) as i64);
        let gap = |one: i64, other: i64| (one.abs_diff(other) as f64 - 0.5).max(0.0);
        let obstacles = reach.clone().flat_map(|other| reach.clone().map(move |across| (across, other)));
        let distances = obstacles
            .filter(|&(across, up)| grid.at(across, up) != Occupancy::Free)
            .map(|(across, up)| gap(column, across).hypot(gap(row, up)));
        distances.fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #[test]
        fn no_obstacle_is_nearer(width in 1_usize..9, free in proptest::collection::vec(prop::bool::weighted(0.8), 1..80)) {
            let height = free.len() / width;
            let cells = free[..width * height]
                .iter()
                .map(|&free| if free { Occupancy::Free } else { Occupancy::Occupied })
                .collect();
            let frame = crate::grid::GridFrame { resolution: 0.5, origin: Point::origin(), yaw: 0.0 };
            let grid = OccupancyGrid::new(width, height, frame, cells);
            let clearance = Clearance::of(&grid);
            for cell in 0..width * height {
                let (column, row) = (cell % width, cell / width);
                let is_free = grid.cells()[cell] == Occupancy::Free;
                let expected = if is_free { 0.5 * nearest(&grid, column as i64, row as i64) } else { 0.0 };
                let found = clearance.of_cell(cell);
                prop_assert!(found <= expected + 1e-12 && found > expected - 0.5 / 32.0, "{} at {}", found, cell);
            }
        }
    }

    #[test]
    fn a_distance_is_kept_from_its_threshold_on() {
        let grid = OccupancyGrid::from_ascii(".....", 1.0);
        let clearance = Clearance::of(&grid);
        assert_eq!((clearance.of_cell(2), clearance.at(Point::new(9.0, 0.5))), (0.5, 0.0));
        let keeps = |radius: f64| clearance.steps()[2] >= clearance.threshold(radius);
        assert_eq!([0.0, 0.5, 0.51].map(keeps), [true, true, false]);
    }
}
