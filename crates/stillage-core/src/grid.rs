//! The occupancy grid, in the terms of `nav_msgs/OccupancyGrid`.

use serde::{Deserialize, Serialize};

use crate::geometry::{OrientedBox, Point, RigidMotion, direction, normal};

/// State of one cell of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[repr(u8)]
pub enum Occupancy {
    /// Seen to be empty.
    Free = 0,
    /// Seen to hold an obstacle.
    Occupied = 1,
    /// Never seen, or seen without a clear result.
    Unknown = 2,
}

/// Where a grid lies in the map frame: the pose of its lower left corner, and the size of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GridFrame {
    /// Side of a cell, metres.
    pub resolution: f64,
    /// Position of the grid's lower left corner in the map frame, metres.
    pub origin: Point,
    /// Counter-clockwise rotation of the grid in the map frame, radians.
    pub yaw: f64,
}

impl GridFrame {
    /// Carries a point of the grid frame into the map frame.
    #[must_use]
    pub fn to_map(&self, point: Point) -> Point {
        self.origin + direction(self.yaw) * point.x + normal(self.yaw) * point.y
    }

    /// Carries a point of the map frame into the grid frame.
    #[must_use]
    pub fn to_grid(&self, point: Point) -> Point {
        let offset = point - self.origin;
        Point::new(direction(self.yaw).dot(&offset), normal(self.yaw).dot(&offset))
    }

    /// The motion that carries the grid frame into the map frame.
    #[must_use]
    pub fn motion(&self) -> RigidMotion {
        RigidMotion { shift: self.origin.coords, turn: self.yaw }
    }

    /// Carries an angle of the grid frame into the map frame.
    #[must_use]
    pub fn angle_to_map(&self, angle: f64) -> f64 {
        angle + self.yaw
    }
}

/// A rectangle of cells. Row 0 is the lowest (smallest y), as in `nav_msgs/OccupancyGrid`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OccupancyGrid {
    width: usize,
    height: usize,
    frame: GridFrame,
    cells: Vec<Occupancy>,
}

impl OccupancyGrid {
    /// Builds a grid from its cells in row-major order, lowest row first.
    ///
    /// # Panics
    /// When the number of cells is not `width * height`.
    #[must_use]
    pub fn new(width: usize, height: usize, frame: GridFrame, cells: Vec<Occupancy>) -> Self {
        assert_eq!(cells.len(), width * height, "a grid has width * height cells");
        Self { width, height, frame, cells }
    }

    /// Reads a picture in characters, first line on top: `#` occupied, `.` free, anything else unknown.
    ///
    /// Blank first and last lines and the common indentation are dropped, short lines are filled with unknown cells.
    /// The origin is (0, 0) without yaw.
    #[must_use]
    pub fn from_ascii(picture: &str, resolution: f64) -> Self {
        let lines: Vec<&str> = picture.lines().collect();
        let first = lines.iter().position(|line| !line.trim().is_empty()).unwrap_or(0);
        let last = lines.iter().rposition(|line| !line.trim().is_empty()).map_or(first, |index| index + 1);
        let lines = &lines[first..last];
        let indent = lines
            .iter()
            .filter(|line| !line.trim().is_empty())
            .map(|line| line.len() - line.trim_start().len())
            .min()
            .unwrap_or(0);
        let rows: Vec<&[u8]> =
            lines.iter().map(|line| line.trim_end().as_bytes().get(indent..).unwrap_or_default()).collect();
        let width = rows.iter().map(|row| row.len()).max().unwrap_or(0);
        let cells = rows
            .iter()
            .rev()
            .flat_map(|row| {
                (0..width).map(|column| match row.get(column) {
                    Some(b'#') => Occupancy::Occupied,
                    Some(b'.') => Occupancy::Free,
                    _ => Occupancy::Unknown,
                })
            })
            .collect();
        let frame = GridFrame { resolution, origin: Point::origin(), yaw: 0.0 };
        Self::new(width, rows.len(), frame, cells)
    }

    /// Number of columns.
    #[must_use]
    pub const fn width(&self) -> usize {
        self.width
    }

    /// Number of rows.
    #[must_use]
    pub const fn height(&self) -> usize {
        self.height
    }

    /// Pose and resolution.
    #[must_use]
    pub const fn frame(&self) -> &GridFrame {
        &self.frame
    }

    /// Side of a cell, metres.
    #[must_use]
    pub const fn resolution(&self) -> f64 {
        self.frame.resolution
    }

    /// All cells, row-major, lowest row first.
    #[must_use]
    pub fn cells(&self) -> &[Occupancy] {
        &self.cells
    }

    /// The cells of one row.
    #[must_use]
    pub fn row(&self, row: usize) -> &[Occupancy] {
        &self.cells[row * self.width..(row + 1) * self.width]
    }

    /// The cell at a column and row; unknown outside the grid.
    #[must_use]
    pub fn at(&self, column: i64, row: i64) -> Occupancy {
        match (usize::try_from(column), usize::try_from(row)) {
            (Ok(column), Ok(row)) if column < self.width && row < self.height => self.cells[row * self.width + column],
            _ => Occupancy::Unknown,
        }
    }

    /// How many cells have this occupancy.
    #[must_use]
    pub fn count(&self, occupancy: Occupancy) -> usize {
        self.cells.iter().filter(|&&cell| cell == occupancy).count()
    }

    /// Centre of a cell in the grid frame, metres.
    #[must_use]
    pub fn center(&self, column: usize, row: usize) -> Point {
        Point::new((column as f64 + 0.5) * self.resolution(), (row as f64 + 0.5) * self.resolution())
    }

    /// Column and row of the cell that holds a point of the grid frame; `None` outside the grid.
    #[must_use]
    pub fn cell_at(&self, point: Point) -> Option<(usize, usize)> {
        let (column, row) = ((point.x / self.resolution()).floor(), (point.y / self.resolution()).floor());
        let inside = column >= 0.0 && row >= 0.0 && column < self.width as f64 && row < self.height as f64;
        inside.then_some((column as usize, row as usize))
    }

    /// Columns and rows of the cells with their centre in a box.
    pub(crate) fn cells_within(&self, bounds: &OrientedBox) -> impl Iterator<Item = (usize, usize)> + use<> {
        let corners = bounds.corners();
        let cell = self.resolution();
        let range = |axis: usize, count: usize| {
            let places = corners.iter().map(|corner| corner.coords[axis] / cell);
            let low = places.clone().fold(f64::INFINITY, f64::min).floor().max(0.0) as usize;
            let high = places.fold(f64::NEG_INFINITY, f64::max).ceil().clamp(0.0, count as f64) as usize;
            low.min(count)..high
        };
        let (columns, rows) = (range(0, self.width), range(1, self.height));
        let bounds = *bounds;
        let is_in = move |&(column, row): &(usize, usize)| {
            bounds.contains(Point::new(column as f64 + 0.5, row as f64 + 0.5) * cell)
        };
        rows.flat_map(move |row| columns.clone().map(move |column| (column, row))).filter(is_in)
    }

    /// First and one-past-last column and row of the cells that are not unknown; `None` when all are unknown.
    #[must_use]
    pub fn known_bounds(&self) -> Option<CellBounds> {
        let mut bounds: Option<CellBounds> = None;
        for row in 0..self.height {
            let known = |cell: &Occupancy| *cell != Occupancy::Unknown;
            let cells = self.row(row);
            let Some(first) = cells.iter().position(known) else { continue };
            let end = cells.iter().rposition(known).map_or(first, |last| last) + 1;
            let so_far = bounds.get_or_insert(CellBounds { columns: first..end, rows: row..row + 1 });
            so_far.columns = so_far.columns.start.min(first)..so_far.columns.end.max(end);
            so_far.rows.end = row + 1;
        }
        bounds
    }
}

/// A half-open rectangle of cells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellBounds {
    /// First and one-past-last column.
    pub columns: std::ops::Range<usize>,
    /// First and one-past-last row.
    pub rows: std::ops::Range<usize>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_read_with_its_first_line_on_top() {
        let grid = OccupancyGrid::from_ascii(
            "
            ##.
            #.
            ",
            0.5,
        );
        assert_eq!((grid.width(), grid.height()), (3, 2));
        assert_eq!(grid.row(0), [Occupancy::Occupied, Occupancy::Free, Occupancy::Unknown]);
        assert_eq!(grid.at(2, 1), Occupancy::Free);
        assert_eq!(grid.at(3, 1), Occupancy::Unknown);
        assert_eq!(grid.center(2, 1), Point::new(1.25, 0.75));
        assert_eq!(grid.known_bounds(), Some(CellBounds { columns: 0..3, rows: 0..2 }));
    }

    #[test]
    fn the_map_frame_is_turned_about_the_lower_left_corner() {
        let frame = GridFrame { resolution: 0.1, origin: Point::new(2.0, 3.0), yaw: std::f64::consts::FRAC_PI_2 };
        let point = frame.to_map(Point::new(1.0, 0.0));
        assert!((point - Point::new(2.0, 4.0)).norm() < 1e-12);
        assert!((frame.to_grid(point) - Point::new(1.0, 0.0)).norm() < 1e-12);
    }
}
