//! What goes into the arrangement: the boundaries of the regions and the stretches of the lines.
//!
//! Boundaries run along tile borders: between two regions, and between a region and the part of the map without one.
//! Lines are cut at the boundaries of their region, since decomposition runs per region (paper, II-D), and then made
//! longer by a hair, so that no rounding keeps them from reaching what they end at; what sticks out is loose and dropped
//! by [`super::arrange`]. Cost: O(tiles + lines x (tile columns + tile rows)).

use super::EdgeSource;
use super::lattice;
use crate::geometry::{Point, Vector, direction, normal};
use crate::grid::OccupancyGrid;
use crate::radiography::Line;
use crate::segmentation::RegionMap;

/// A segment that goes into the arrangement, with what it stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SourceSegment {
    /// One end, metres.
    pub start: Point,
    /// The other end, metres.
    pub end: Point,
    /// What it stands for.
    pub source: EdgeSource,
}

/// The segments of a decomposition: the boundaries of the regions and the stretches of the lines within their regions.
///
/// A map without regions has none. Lines shorter than a cell are left out.
#[must_use]
pub fn source_segments(grid: &OccupancyGrid, regions: &RegionMap, lines: &[Line]) -> Vec<SourceSegment> {
    let tiles = Tiles::new(grid, regions);
    let mut segments = tiles.boundaries();
    for (number, line) in (0..).zip(lines) {
        tiles.stretches(line, grid.resolution(), |start, end| {
            segments.push(SourceSegment { start, end, source: EdgeSource::Line(number) });
        });
    }
    segments
}

/// The tiles of a region map with their borders in metres.
struct Tiles<'a> {
    regions: &'a RegionMap,
    /// Borders of the tile columns and rows, cut off at the end of the grid.
    x: Vec<f64>,
    y: Vec<f64>,
}

impl<'a> Tiles<'a> {
    fn new(grid: &OccupancyGrid, regions: &'a RegionMap) -> Self {
        let borders = |tiles: usize, cells: usize| -> Vec<f64> {
            (0..=tiles).map(|tile| (tile * regions.tile_cells).min(cells) as f64 * grid.resolution()).collect()
        };
        Self { regions, x: borders(regions.columns, grid.width()), y: borders(regions.rows, grid.height()) }
    }

    /// Region of a tile; `NONE` outside.
    fn region(&self, column: Option<usize>, row: Option<usize>) -> u8 {
        match (column, row) {
            (Some(column), Some(row)) if column < self.regions.columns && row < self.regions.rows => {
                self.regions.tiles.get(row * self.regions.columns + column).copied().unwrap_or(RegionMap::NONE)
            }
            _ => RegionMap::NONE,
        }
    }

    /// The borders between tiles of different regions, in straight runs.
    fn boundaries(&self) -> Vec<SourceSegment> {
        let mut segments = Vec::new();
        let mut push = |start, end| {
            if start != end {
                segments.push(SourceSegment { start, end, source: EdgeSource::Boundary });
            }
        };
        for (column, &x) in self.x.iter().enumerate() {
            let differs = |row| self.region(column.checked_sub(1), Some(row)) != self.region(Some(column), Some(row));
            runs(self.regions.rows, differs, |from, to| push(Point::new(x, self.y[from]), Point::new(x, self.y[to])));
        }
        for (row, &y) in self.y.iter().enumerate() {
            let differs =
                |column| self.region(Some(column), row.checked_sub(1)) != self.region(Some(column), Some(row));
            runs(self.regions.columns, differs, |from, to| {
                push(Point::new(self.x[from], y), Point::new(self.x[to], y));
            });
        }
        segments
    }

    /// The stretches of a line that lie in its region.
    fn stretches(&self, line: &Line, cell: f64, mut push: impl FnMut(Point, Point)) {
        // Ends may have been found by cells: half a cell more reaches the boundary they stand at.
        const OVERSHOOT_CELLS: f64 = 0.5;
        let along = direction(line.orientation);
        let foot = Point::from(normal(line.orientation) * line.offset);
        for &[start, end] in line.extents.iter().filter(|[start, end]| end - start >= cell) {
            let extent = [start - OVERSHOOT_CELLS * cell, end + OVERSHOOT_CELLS * cell];
            let cuts = self.cuts(foot, along, extent);
            let is_inside = |piece| {
                let middle = foot + along * f64::midpoint(cuts[piece], cuts[piece + 1]);
                self.region_at(middle) == line.region
            };
            runs(cuts.len().saturating_sub(1), is_inside, |from, to| {
                if cuts[to] - cuts[from] >= cell {
                    let hair = 2.0 * lattice::step_for(self.reach());
                    push(foot + along * (cuts[from] - hair), foot + along * (cuts[to] + hair));
                }
            });
        }
    }

    /// Greatest coordinate of any border, metres.
    fn reach(&self) -> f64 {
        let last = |borders: &[f64]| borders.last().copied().unwrap_or(0.0);
        last(&self.x).max(last(&self.y))
    }

    /// The ends of an extent and where it crosses tile borders, ascending, as distances from the foot of the line.
    fn cuts(&self, foot: Point, along: Vector, [start, end]: [f64; 2]) -> Vec<f64> {
        let crossings = |borders: &'_ [f64], foot: f64, along: f64| -> Vec<f64> {
            // A line along the border crosses it at infinity, or nowhere (NaN): neither is within the extent.
            borders.iter().map(|border| (border - foot) / along).filter(|&cut| cut > start && cut < end).collect()
        };
        let mut cuts = vec![start, end];
        cuts.extend(crossings(&self.x, foot.x, along.x));
        cuts.extend(crossings(&self.y, foot.y, along.y));
        cuts.sort_unstable_by(f64::total_cmp);
        cuts
    }

    /// Region at a point; `NONE` outside.
    fn region_at(&self, point: Point) -> u8 {
        // The number of borders at or before the point is one more than the number of its tile.
        let tile = |borders: &[f64], value: f64| {
            let before = borders.partition_point(|&border| border <= value);
            (before < borders.len()).then(|| before.checked_sub(1)).flatten()
        };
        self.region(tile(&self.x, point.x), tile(&self.y, point.y))
    }
}

/// Calls `found(from, to)` for every maximal run `from..to` of numbers below `count` for which `is_in` holds.
fn runs(count: usize, is_in: impl Fn(usize) -> bool, mut found: impl FnMut(usize, usize)) {
    let mut start = None;
    for number in 0..=count {
        match (number < count && is_in(number), start) {
            (true, None) => start = Some(number),
            (false, Some(from)) => {
                found(from, number);
                start = None;
            }
            _ => {}
        }
    }
}
