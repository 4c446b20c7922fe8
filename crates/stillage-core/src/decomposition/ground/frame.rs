//! A region in its own frame: u along its first direction, v to the left of it, in square cells of a few centimetres.
//!
//! A cell of the frame takes the state of the grid cell at its centre. Occupied cells of the grid are carried over one by
//! one as well, since objects of a cell or two could lie between the samples. Cost: O(cells of the frame + cells of the
//! grid).

use crate::geometry::{Point, direction, normal};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::segmentation::RegionMap;
use crate::site_ground::SiteGround;
use crate::watch::{Stopped, Watch};

use super::cell::Cell;
use super::patch::Patch;
use super::rect::{Axis, Rect};

/// Side of a cell of the frame, metres: posts of 0.09 m are then two cells wide, which the comb needs (accuracy study).
const CELL_M: f64 = 0.05;
/// Side of a frame cell as a share of a grid cell, at least: coarse grids are not refined further.
const FINEST_SHARE: f64 = 0.5;
/// Margin around the region, metres: wider than a vehicle, so that the border of the frame does not close a passage.
const MARGIN_M: f64 = 2.0;

/// A region in its own frame.
pub(crate) struct RegionFrame {
    /// Direction of u, radians.
    pub angle: f64,
    /// Side of a cell, metres.
    pub cell: f64,
    /// Position of the lower left corner along u and v, metres.
    pub start: [f64; 2],
    pub columns: usize,
    pub rows: usize,
    pub cells: Vec<Cell>,
    /// Width of the vehicle that drivable cells have room for, metres; 0 until they are marked.
    pub vehicle_m: f64,
}

impl RegionFrame {
    pub(crate) fn new(
        grid: &OccupancyGrid,
        regions: &RegionMap,
        region: u8,
        angle: f64,
        site: &SiteGround,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let mut frame = Self::empty(grid, regions, region, angle);
        let resolution = grid.resolution();
        let (along, across) = (direction(angle), normal(angle));
        let step = [along.x, along.y].map(|step| fixed(step * frame.cell / resolution));
        for (row, cells) in frame.cells.chunks_exact_mut(frame.columns.max(1)).enumerate() {
            watch.check()?;
            let [u, v] = [frame.start[0], frame.start[1] + row as f64 * frame.cell].map(|low| low + frame.cell / 2.0);
            let first = (along * u + across * v) / resolution;
            let mut place = [fixed(first.x), fixed(first.y)];
            for cell in cells {
                let [x, y] = place.map(|place| place >> FRACTION_BITS);
                *cell = Cell::new(grid.at(x, y), site.holds(x, y, region));
                place = [place[0] + step[0], place[1] + step[1]];
            }
        }
        frame.carry_occupied_over(grid, watch)?;
        Ok(frame)
    }

    /// The frame of a grid that is all of its site, drawn in characters, and the rectangle that it takes there.
    #[cfg(test)]
    pub(crate) fn of_picture(picture: &str, cell: f64) -> (Self, Rect) {
        use crate::{geometry::OrientedBox, segmentation::Region};
        let grid = OccupancyGrid::from_ascii(picture, cell);
        let bounds = OrientedBox { center: Point::origin(), half_extents: [0.0; 2], angle: 0.0 };
        let region = Region { orientations: vec![0.0], bounds, share: 1.0 };
        let tile_cells = grid.width().max(grid.height());
        let regions = RegionMap { tile_cells, columns: 1, rows: 1, tiles: vec![0], regions: vec![region] };
        let watch = Watch::unwatched();
        let site = SiteGround::of(&grid, &regions, &watch).expect("nobody stops it");
        let frame = Self::new(&grid, &regions, 0, 0.0, &site, &watch).expect("nobody stops it");
        let side = |axis: usize, cells: usize| {
            let margin = frame.cells_of(-frame.start[axis]);
            margin..margin + cells
        };
        let rect = Rect { u: side(0, grid.width()), v: side(1, grid.height()) };
        (frame, rect)
    }

    /// A frame around the tiles of a region.
    fn empty(grid: &OccupancyGrid, regions: &RegionMap, region: u8, angle: f64) -> Self {
        let side = regions.tile_cells as f64 * grid.resolution();
        let (along, across) = (direction(angle), normal(angle));
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for (tile, _) in regions.tiles.iter().enumerate().filter(|&(_, &of)| of == region) {
            let (column, row) = (tile % regions.columns, tile / regions.columns);
            for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let corner = Point::new((column + x) as f64 * side, (row + y) as f64 * side);
                for (axis, unit) in [along, across].iter().enumerate() {
                    low[axis] = low[axis].min(unit.dot(&corner.coords));
                    high[axis] = high[axis].max(unit.dot(&corner.coords));
                }
            }
        }
        let cell = CELL_M.max(FINEST_SHARE * grid.resolution());
        let size = [0, 1].map(|axis| {
            let extent = high[axis] - low[axis] + 2.0 * MARGIN_M;
            if extent.is_finite() { (extent / cell).ceil().max(0.0) as usize } else { 0 }
        });
        let cells = vec![Cell::new(Occupancy::Unknown, false); size[0] * size[1]];
        Self {
            angle,
            cell,
            start: low.map(|low| low - MARGIN_M),
            columns: size[0],
            rows: size[1],
            cells,
            vehicle_m: 0.0,
        }
    }

    /// Marks the cells that occupied cells of the grid have their centre in.
    fn carry_occupied_over(&mut self, grid: &OccupancyGrid, watch: &Watch<'_>) -> Result<(), Stopped> {
        let (along, across) = (direction(self.angle), normal(self.angle));
        for row in 0..grid.height() {
            watch.check()?;
            for (column, _) in grid.row(row).iter().enumerate().filter(|&(_, &cell)| cell == Occupancy::Occupied) {
                let center = grid.center(column, row).coords;
                let u = (along.dot(&center) - self.start[0]) / self.cell;
                let v = (across.dot(&center) - self.start[1]) / self.cell;
                if u >= 0.0 && v >= 0.0 && u < self.columns as f64 && v < self.rows as f64 {
                    self.cells[v as usize * self.columns + u as usize].mark_occupied();
                }
            }
        }
        Ok(())
    }

    /// Makes all cells of a rectangle occupied.
    pub fn fill(&mut self, rect: &Rect) {
        for row in rect.v.clone() {
            self.cells[row * self.columns..][rect.u.clone()].iter_mut().for_each(Cell::mark_occupied);
        }
    }

    pub fn row(&self, row: usize) -> &[Cell] {
        &self.cells[row * self.columns..(row + 1) * self.columns]
    }

    /// Metres in cells, rounded.
    pub fn cells_of(&self, metres: f64) -> usize {
        (metres / self.cell).round() as usize
    }

    /// The whole frame.
    pub fn whole(&self) -> Rect {
        Rect { u: 0..self.columns, v: 0..self.rows }
    }

    /// Number of the cells of a rectangle for which `is` holds.
    pub fn count(&self, rect: &Rect, is: impl Fn(Cell) -> bool) -> usize {
        let row = |v| self.row(v)[rect.u.clone()].iter().filter(|&&cell| is(cell)).count();
        rect.v.clone().map(row).sum()
    }

    /// Share of the cells of a rectangle for which `is` holds; 0 for an empty one.
    pub fn share(&self, rect: &Rect, is: impl Fn(Cell) -> bool) -> f64 {
        self.count(rect, is) as f64 / (rect.u.len() * rect.v.len()).max(1) as f64
    }

    /// Number of the cells of each line of a rectangle along `axis` for which `is` holds.
    pub fn counts(&self, rect: &Rect, axis: Axis, is: impl Fn(Cell) -> bool) -> Vec<u32> {
        let rows = rect.v.clone().map(|row| &self.row(row)[rect.u.clone()]);
        match axis {
            Axis::U => rows.map(|cells| cells.iter().map(|&cell| u32::from(is(cell))).sum()).collect(),
            Axis::V => rows.fold(vec![0; rect.u.len()], |mut counts, cells| {
                counts.iter_mut().zip(cells).for_each(|(count, &cell)| *count += u32::from(is(cell)));
                counts
            }),
        }
    }

    /// The strips beside a rectangle at its low and high side along `axis`, from near to far, cells; cut off at the
    /// border of the frame.
    pub fn beside(&self, rect: &Rect, axis: Axis, [near, far]: [usize; 2]) -> [Rect; 2] {
        let (across, end) = (rect.range(axis.other()), self.whole().range(axis.other()).end);
        let low = across.start.saturating_sub(far)..across.start.saturating_sub(near);
        let high = (across.end + near).min(end)..(across.end + far).min(end);
        [low, high].map(|strip| rect.with(axis.other(), strip))
    }

    /// A part of the frame with its rows along `axis`.
    pub fn patch(&self, rect: &Rect, axis: Axis) -> Patch {
        let (along, across) = (rect.range(axis), rect.range(axis.other()));
        let at = |x: usize, y: usize| match axis {
            Axis::U => self.cells[y * self.columns + x],
            Axis::V => self.cells[x * self.columns + y],
        };
        let cells = across.clone().flat_map(|y| along.clone().map(move |x| (x, y))).map(|(x, y)| at(x, y)).collect();
        Patch { width: along.len(), height: across.len(), cells }
    }
}

/// Fractional bits of positions in the grid, cells: after 30,000 steps the error is below 1e-5 of a cell.
const FRACTION_BITS: u32 = 32;

/// A position with [`FRACTION_BITS`] fractional bits, which is stepped and floored as a whole number.
fn fixed(place: f64) -> i64 {
    (place * (1_u64 << FRACTION_BITS) as f64).round() as i64
}
