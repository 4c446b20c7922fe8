//! The segments that go into the arrangement: the boundaries of the regions and the stretches of the lines.
//!
//! Boundaries run along tile borders: between two regions, and between a region and the part of the map without one.
//! Lines are cut at the boundaries of their region, since decomposition runs per region (paper, II-D), and then made
//! longer by two steps of the lattice, so that no rounding keeps them from meeting the boundary; the part beyond it has
//! a loose end, and [`super::arrange`] drops it. Rooms take precedence over regions: no boundary runs through a room,
//! and the borders of rooms, which are lines of no region, are neither cut nor made longer.
//!
//! Cost: O(tiles + cells of boundaries + stretches x (tile columns + tile rows)).

use super::EdgeSource;
use super::lattice;
use crate::geometry::{Point, Vector, direction, normal};
use crate::grid::OccupancyGrid;
use crate::line::Line;
use crate::runs::runs_where;
use crate::segmentation::RegionMap;
use crate::watch::{Stopped, Watch};

/// A segment that goes into the arrangement, and its source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SourceSegment {
    /// One end, metres.
    pub start: Point,
    /// The other end, metres.
    pub end: Point,
    /// What it comes from.
    pub source: EdgeSource,
}

/// The segments of a decomposition: the boundaries of the regions and the stretches of the lines within their regions.
///
/// `rooms` holds the room, or the stack in a room, of every cell, 0 for none; it is empty where there are no rooms.
/// Lines of a region that are shorter than a cell are left out.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn source_segments(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    lines: &[Line],
    rooms: &[u32],
    watch: &Watch<'_>,
) -> Result<Vec<SourceSegment>, Stopped> {
    let tiles = RegionTiles::new(grid, regions, rooms);
    let mut segments = tiles.boundaries(watch)?;
    for (number, line) in (0..).zip(lines) {
        watch.check()?;
        tiles.stretches(line, grid.resolution(), |start, end| {
            segments.push(SourceSegment { start, end, source: EdgeSource::Line(number) });
        });
    }
    Ok(segments)
}

/// The tiles of a region map with their borders in metres.
struct RegionTiles<'a> {
    grid: &'a OccupancyGrid,
    regions: &'a RegionMap,
    rooms: &'a [u32],
    /// Borders of the tile columns and rows, cut off at the end of the grid.
    x: Vec<f64>,
    y: Vec<f64>,
}

impl<'a> RegionTiles<'a> {
    fn new(grid: &'a OccupancyGrid, regions: &'a RegionMap, rooms: &'a [u32]) -> Self {
        let borders = |tiles: usize, cells: usize| -> Vec<f64> {
            (0..=tiles).map(|tile| (tile * regions.tile_cells).min(cells) as f64 * grid.resolution()).collect()
        };
        let (x, y) = (borders(regions.columns, grid.width()), borders(regions.rows, grid.height()));
        Self { grid, regions, rooms, x, y }
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

    /// The borders between tiles of different regions, in straight runs outside rooms.
    fn boundaries(&self, watch: &Watch<'_>) -> Result<Vec<SourceSegment>, Stopped> {
        let mut segments = Vec::new();
        let mut push = |start, end| {
            if start != end {
                segments.push(SourceSegment { start, end, source: EdgeSource::Boundary });
            }
        };
        let tile = self.regions.tile_cells;
        for (column, &x) in self.x.iter().enumerate() {
            watch.check()?;
            let differs = |row| self.region(column.checked_sub(1), Some(row)) != self.region(Some(column), Some(row));
            let is_in_room = |row| self.is_in_room([column * tile, row], [(column * tile).wrapping_sub(1), row]);
            for run in runs_where(self.regions.rows, differs) {
                self.outside_rooms([self.y[run.start], self.y[run.end]], is_in_room, |from, to| {
                    push(Point::new(x, from), Point::new(x, to));
                });
            }
        }
        for (row, &y) in self.y.iter().enumerate() {
            watch.check()?;
            let differs =
                |column| self.region(Some(column), row.checked_sub(1)) != self.region(Some(column), Some(row));
            let is_in_room = |column| self.is_in_room([column, row * tile], [column, (row * tile).wrapping_sub(1)]);
            for run in runs_where(self.regions.columns, differs) {
                self.outside_rooms([self.x[run.start], self.x[run.end]], is_in_room, |from, to| {
                    push(Point::new(from, y), Point::new(to, y));
                });
            }
        }
        Ok(segments)
    }

    /// Whether two cells (column, row) lie in one room.
    fn is_in_room(&self, one: [usize; 2], other: [usize; 2]) -> bool {
        let room = |[column, row]: [usize; 2]| {
            let is_inside = column < self.grid.width() && row < self.grid.height();
            is_inside.then(|| self.rooms.get(row * self.grid.width() + column).copied()).flatten().unwrap_or(0)
        };
        room(one) != 0 && room(one) == room(other)
    }

    /// The parts of a boundary that are in no room, from metres to metres.
    fn outside_rooms(
        &self,
        [start, end]: [f64; 2],
        is_in_room: impl Fn(usize) -> bool,
        mut found: impl FnMut(f64, f64),
    ) {
        // Borders of rooms are straightened, so they may lie a few cells inside the room: the boundary is made longer
        // to meet them.
        const OVERSHOOT_CELLS: f64 = 3.0;
        let cell = self.grid.resolution();
        let [first, last] = [start, end].map(|side| (side / cell).round() as usize);
        let at = |number: usize| start + (number as f64) * cell;
        for run in runs_where(last - first, |number| !is_in_room(first + number)) {
            let from = if run.start == 0 { start } else { at(run.start) - OVERSHOOT_CELLS * cell };
            let to = if first + run.end == last { end } else { at(run.end) + OVERSHOOT_CELLS * cell };
            found(from.max(start), to.min(end));
        }
    }

    /// The stretches of a line that lie in its region; the whole of a line that has none.
    fn stretches(&self, line: &Line, cell: f64, mut push: impl FnMut(Point, Point)) {
        // Ends may be centres of cells: half a cell more reaches the boundary.
        const OVERSHOOT_CELLS: f64 = 0.5;
        const NANOMETRE: f64 = 1e-9;
        let along = direction(line.orientation);
        let foot = Point::from(normal(line.orientation) * line.offset);
        let overshoot = 2.0 * lattice::step_for(self.reach());
        if line.region == RegionMap::NONE {
            // Borders of rooms share their corners up to rounding, which is removed here. Were they made longer,
            // segments that meet at a blunt angle would cross beyond the corner.
            let exact = |at: f64| (foot + along * at).map(|side| (side / NANOMETRE).round() * NANOMETRE);
            line.extents.iter().for_each(|&[start, end]| push(exact(start), exact(end)));
            return;
        }
        for &[start, end] in line.extents.iter().filter(|[start, end]| end - start >= cell) {
            let extent = [start - OVERSHOOT_CELLS * cell, end + OVERSHOOT_CELLS * cell];
            let cuts = self.cuts(foot, along, extent);
            let is_inside = |piece| {
                let middle = foot + along * f64::midpoint(cuts[piece], cuts[piece + 1]);
                self.region_at(middle) == line.region
            };
            for run in runs_where(cuts.len().saturating_sub(1), is_inside) {
                let [from, to] = [run.start, run.end].map(|cut| cuts[cut]);
                if to - from >= cell {
                    push(foot + along * (from - overshoot), foot + along * (to + overshoot));
                }
            }
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

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_4;

    use expect_test::{Expect, expect};

    use super::*;
    use crate::arrangement::arrange;
    use crate::geometry::OrientedBox;
    use crate::grid::{GridFrame, Occupancy};
    use crate::segmentation::Region;

    /// Digits are the regions of tiles of 2 x 2 cells of 0.5 m, so a character is a metre.
    fn regions(picture: &str) -> RegionMap {
        let rows: Vec<&str> = picture.lines().map(str::trim).filter(|row| !row.is_empty()).collect();
        let tile = |symbol: char| symbol.to_digit(10).map_or(RegionMap::NONE, |digit| digit as u8);
        let tiles = rows.iter().rev().flat_map(|row| row.chars().map(tile)).collect();
        let bounds = OrientedBox { center: Point::origin(), half_extents: [0.0; 2], angle: 0.0 };
        let region = Region { orientations: vec![], bounds, share: 0.5 };
        let columns = rows.first().map_or(0, |row| row.len());
        RegionMap { tile_cells: 2, columns, rows: rows.len(), tiles, regions: vec![region; 2] }
    }

    fn grid(width: usize, height: usize) -> OccupancyGrid {
        let frame = GridFrame { resolution: 0.5, origin: Point::origin(), yaw: 0.0 };
        OccupancyGrid::new(width, height, frame, vec![Occupancy::Free; width * height])
    }

    fn line(region: u8, orientation: f64, offset: f64, extent: [f64; 2]) -> Line {
        Line { region, orientation, offset, support: 1.0, extents: vec![extent] }
    }

    #[expect(clippy::needless_pass_by_value, reason = "expect! makes a value")]
    fn check(grid: &OccupancyGrid, regions: &RegionMap, lines: &[Line], expected: Expect) {
        let text = |segment: &SourceSegment| {
            let SourceSegment { start, end, source } = segment;
            format!("({:.2}, {:.2}) - ({:.2}, {:.2}) {source:?}\n", start.x, start.y, end.x, end.y)
        };
        let found = source_segments(grid, regions, lines, &[], &Watch::unwatched()).expect("nobody stops it");
        expected.assert_eq(&found.iter().map(text).collect::<String>());
    }

    #[test]
    fn boundaries_are_straight_runs_each_once() {
        check(
            &grid(8, 6),
            &regions(
                "
            0011
            00.1
            0000
        ",
            ),
            &[],
            expect![[r#"
            (0.00, 0.00) - (0.00, 3.00) Boundary
            (2.00, 1.00) - (2.00, 3.00) Boundary
            (3.00, 1.00) - (3.00, 2.00) Boundary
            (4.00, 0.00) - (4.00, 3.00) Boundary
            (0.00, 0.00) - (4.00, 0.00) Boundary
            (2.00, 1.00) - (4.00, 1.00) Boundary
            (2.00, 2.00) - (3.00, 2.00) Boundary
            (0.00, 3.00) - (4.00, 3.00) Boundary
        "#]],
        );
    }

    #[test]
    fn the_last_tiles_end_where_the_grid_ends() {
        check(
            &grid(3, 3),
            &regions(
                "
            00
            00
        ",
            ),
            &[],
            expect![[r#"
            (0.00, 0.00) - (0.00, 1.50) Boundary
            (1.50, 0.00) - (1.50, 1.50) Boundary
            (0.00, 0.00) - (1.50, 0.00) Boundary
            (0.00, 1.50) - (1.50, 1.50) Boundary
        "#]],
        );
    }

    #[test]
    fn a_staircase_is_one_face_a_side() {
        let regions = regions(
            "
            0111
            0011
            0001
        ",
        );
        let watch = Watch::unwatched();
        let segments = source_segments(&grid(8, 6), &regions, &[], &[], &watch).expect("nobody stops it");
        let subdivision = arrange(&segments, &watch).expect("nobody stops it");
        subdivision.check_invariants().expect("it is sound");
        let areas: Vec<f64> = subdivision.faces().map(|face| subdivision.area(face)).collect();
        assert_eq!(areas, [6.0, 6.0]);
    }

    /// The first line is cut to its region and reaches its boundary, the second is shorter than a cell, the third lies
    /// in the other region's part.
    #[test]
    fn lines_are_cut_to_their_region() {
        let lines = [
            line(0, 0.0, 1.5, [-9.0, 9.0]),
            line(0, 0.0, 0.5, [1.0, 1.2]),
            line(1, 0.0, 0.7, [0.0, 1.9]),
            line(1, FRAC_PI_4, 0.0, [0.0, 3.0]),
        ];
        check(
            &grid(8, 4),
            &regions(
                "
            0011
            0011
        ",
            ),
            &lines,
            expect![[r#"
            (0.00, 0.00) - (0.00, 2.00) Boundary
            (2.00, 0.00) - (2.00, 2.00) Boundary
            (4.00, 0.00) - (4.00, 2.00) Boundary
            (0.00, 0.00) - (4.00, 0.00) Boundary
            (0.00, 2.00) - (4.00, 2.00) Boundary
            (-0.00, 1.50) - (2.00, 1.50) Line(0)
        "#]],
        );
    }

    #[test]
    fn a_map_without_regions_has_no_segments() {
        check(&grid(0, 0), &regions(""), &[line(0, 0.3, 0.0, [0.0, 5.0])], expect![[""]]);
        check(&grid(4, 2), &regions(".."), &[line(0, 0.3, 0.0, [0.0, 5.0])], expect![[""]]);
    }

    /// Lines at any angle split a region without leaving anything out: the faces fill the box.
    #[test]
    fn faces_of_a_region_fill_it() {
        let regions = regions(&"00000\n".repeat(4));
        for orientation in [0.0, 0.1, 0.8, -1.2, -1.5] {
            let across = orientation + std::f64::consts::FRAC_PI_2;
            let parallel =
                |angle: f64| (-9..9).map(move |offset| line(0, angle, f64::from(offset) * 0.7, [-20.0, 20.0]));
            let lines: Vec<Line> = parallel(orientation).chain(parallel(across)).collect();
            let watch = Watch::unwatched();
            let segments = source_segments(&grid(10, 8), &regions, &lines, &[], &watch).expect("nobody stops it");
            let subdivision = arrange(&segments, &watch).expect("nobody stops it");
            subdivision.check_invariants().expect("it is sound");
            let covered: f64 = subdivision.faces().map(|face| subdivision.area(face)).sum();
            assert!((covered - 20.0).abs() < 1e-9 && subdivision.face_count() > 30, "{orientation}: {covered} m2");
        }
    }
}
