//! The same map on other cells: turned, with unknown ground before it, or painted outside. Its place in the map frame stays,
//! and so does its truth.

use stillage_core::geometry::{Vector, direction, normal};
use stillage_core::{GridFrame, Occupancy, OccupancyGrid, Point};

/// Samples along each side of a cell.
const SAMPLES: usize = 4;
/// Share of a cell that has to be occupied: a wall of one cell stays a wall on cells that it crosses aslant.
const OCCUPIED: f64 = 1.0 / 3.0;

/// A map whose content is turned counter-clockwise by an angle, radians.
pub fn turned(grid: &OccupancyGrid, angle: f64) -> OccupancyGrid {
    let resolution = grid.resolution();
    let size = Vector::new(grid.width() as f64, grid.height() as f64) * resolution;
    let (sin, cos) = angle.sin_cos();
    let cells = |along: f64, across: f64| ((along * cos.abs() + across * sin.abs()) / resolution).ceil() as usize;
    let (width, height) = (cells(size.x, size.y), cells(size.y, size.x));
    let middle = Vector::new(width as f64, height as f64) * (resolution / 2.0);
    // From the turned grid back to where it came from.
    let back = |point: Vector| {
        let offset = point - middle;
        Point::from(direction(-angle) * offset.x + normal(-angle) * offset.y + size / 2.0)
    };
    let frame = grid.frame();
    let frame = GridFrame { origin: frame.to_map(back(Vector::zeros())), yaw: frame.yaw - angle, ..*frame };
    let at = |column: usize, row: usize| {
        let mut counts = [0_usize; 3];
        for sample in 0..SAMPLES * SAMPLES {
            let [x, y] = [sample % SAMPLES, sample / SAMPLES].map(|index| (index as f64 + 0.5) / SAMPLES as f64);
            let point = back(Vector::new(column as f64 + x, row as f64 + y) * resolution);
            let cell = grid.cell_at(point).map_or(Occupancy::Unknown, |(column, row)| grid.row(row)[column]);
            counts[cell as usize] += 1;
        }
        let [free, occupied, unknown] = counts;
        if occupied as f64 >= OCCUPIED * (SAMPLES * SAMPLES) as f64 {
            Occupancy::Occupied
        } else if free >= unknown {
            Occupancy::Free
        } else {
            Occupancy::Unknown
        }
    };
    let cells = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
    OccupancyGrid::new(width, height, frame, cells.map(|(column, row)| at(column, row)).collect())
}

/// A map with so many unknown columns to the left and rows below.
pub fn padded(grid: &OccupancyGrid, cells: usize) -> OccupancyGrid {
    let (width, height) = (grid.width() + cells, grid.height() + cells);
    let before = Point::new(-(cells as f64), -(cells as f64)) * grid.resolution();
    let frame = GridFrame { origin: grid.frame().to_map(before), ..*grid.frame() };
    let mut padded = vec![Occupancy::Unknown; width * height];
    for row in 0..grid.height() {
        let start = (row + cells) * width + cells;
        padded[start..start + grid.width()].copy_from_slice(grid.row(row));
    }
    OccupancyGrid::new(width, height, frame, padded)
}

/// A map whose unknown ground outside, from its border inwards, is painted.
pub fn painted(grid: &OccupancyGrid, outside: Occupancy) -> OccupancyGrid {
    let (width, height) = (grid.width(), grid.height());
    let mut cells = grid.cells().to_vec();
    let is_border = |cell: usize| {
        let (column, row) = (cell % width, cell / width);
        column == 0 || row == 0 || column + 1 == width || row + 1 == height
    };
    let mut open: Vec<usize> = (0..cells.len()).filter(|&cell| is_border(cell)).collect();
    while let Some(cell) = open.pop() {
        if cells[cell] != Occupancy::Unknown {
            continue;
        }
        cells[cell] = outside;
        let (column, row) = (cell % width, cell / width);
        open.extend((column > 0).then(|| cell - 1));
        open.extend((column + 1 < width).then(|| cell + 1));
        open.extend((row > 0).then(|| cell - width));
        open.extend((row + 1 < height).then(|| cell + width));
    }
    OccupancyGrid::new(width, height, *grid.frame(), cells)
}
