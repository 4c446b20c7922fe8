//! Radiography: the occupied cells of a region are projected along its orientations; peaks become lines.
//!
//! Source: the paper, II-B "Cell Decomposition". The author's published code (Hann window, peaks of at least 0.15 of
//! the highest, a least distance between them) gives the defaults, turned into metres.
//!
//! Departures: cell centres are projected, each shared between its two nearest bins, where the author rotates the
//! picture, which blurs it and cuts its corners; and each region is projected by itself, so a line ends where its
//! region ends (II-D gives the reason). As in the paper a line is otherwise infinite, and its peak is compared with the
//! highest of the radiogram, even where that is the outer wall of the building: alignments far weaker than a wall are
//! not found.
//!
//! Cost: O(cells + occupied cells x orientations + lines x tiles crossed). Limits: alignments closer than the least
//! distance are one line.

use serde::{Deserialize, Serialize};

use crate::geometry::{Point, direction, fold_half_turn, normal};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::line::Line;
use crate::segmentation::RegionMap;
use crate::signal::{self, Boundary, Peak};
use crate::spec::DecompositionOptions;
use crate::watch::{Stopped, Watch};

/// Lengths below this count as 0, cells: distances of a line from the border of a region, and intervals and gaps where
/// a line meets the corner of a tile.
const TOLERANCE_CELLS: f64 = 1e-6;

/// Projection of the occupied cells of a region on the normal of an orientation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Radiogram {
    /// Region whose cells are projected.
    pub region: u8,
    /// Direction of projection (and of its lines), radians.
    pub orientation: f64,
    /// Offset of the lower edge of the first bin along the normal, metres.
    pub start: f64,
    /// Width of a bin, metres.
    pub bin: f64,
    /// Occupied length per bin after smoothing, metres (occupied cells x resolution).
    pub values: Vec<f64>,
}

/// Takes the radiograms of every region and reads the lines from their peaks.
///
/// Lines are ordered by region, orientation and offset.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn lines(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    options: &DecompositionOptions,
    watch: &Watch<'_>,
) -> Result<(Vec<Radiogram>, Vec<Line>), Stopped> {
    let radiograms = radiograms(grid, regions, options, watch)?;
    let mut lines = Vec::new();
    for radiogram in &radiograms {
        for peak in radiogram.peaks(options) {
            watch.check()?;
            let mut line = Line {
                region: radiogram.region,
                orientation: fold_half_turn(radiogram.orientation),
                offset: radiogram.offset(peak.position),
                support: peak.height,
                extents: Vec::new(),
            };
            line.extents = extents(&line, grid, regions);
            if !line.extents.is_empty() {
                lines.push(line);
            }
        }
    }
    Ok((radiograms, lines))
}

impl Radiogram {
    /// An empty radiogram that every cell of the grid falls into, with a margin.
    fn new(region: u8, orientation: f64, grid: &OccupancyGrid, margin_bins: f64) -> Self {
        let bin = grid.resolution();
        let normal = normal(orientation);
        let corners = [(0, 0), (grid.width(), 0), (0, grid.height()), (grid.width(), grid.height())];
        let offsets = corners.map(|(column, row)| normal.x * column as f64 + normal.y * row as f64);
        let low = offsets.iter().copied().fold(f64::INFINITY, f64::min) - margin_bins;
        let high = offsets.iter().copied().fold(f64::NEG_INFINITY, f64::max) + margin_bins;
        // Edges at multiples of the bin: rows of cells along an axis of the grid fall into one bin each.
        let (first, last) = (low.floor(), high.ceil());
        Self { region, orientation, start: first * bin, bin, values: vec![0.0; (last - first) as usize + 1] }
    }

    /// Offset of a position in bins, whose whole numbers are centres of bins, metres.
    fn offset(&self, position: f64) -> f64 {
        self.start + (position + 0.5) * self.bin
    }

    /// Drops the empty bins at either end, except a margin.
    fn trim(&mut self, margin: usize) {
        let is_filled = |value: &f64| *value > 0.0;
        let first = self.values.iter().position(is_filled).unwrap_or(self.values.len()).saturating_sub(margin);
        let end = self.values.iter().rposition(is_filled).map_or(0, |last| last + 1) + margin;
        self.values.truncate(end);
        self.values.drain(..first.min(self.values.len()));
        self.start += first as f64 * self.bin;
    }

    /// The maxima that become lines, by position.
    fn peaks(&self, options: &DecompositionOptions) -> Vec<Peak> {
        let mut peaks = signal::local_maxima(&self.values, Boundary::Open);
        let highest = peaks.iter().map(|peak| peak.height).fold(0.0, f64::max);
        peaks.retain(|peak| peak.height >= options.min_peak * highest);
        let distance = options.min_distance_m / self.bin;
        let mut peaks = signal::keep_apart(peaks, distance, self.values.len(), Boundary::Open);
        peaks.sort_by(|one, other| one.position.total_cmp(&other.position));
        peaks
    }
}

/// The smoothed projections of all regions, in one pass over the grid.
fn radiograms(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    options: &DecompositionOptions,
    watch: &Watch<'_>,
) -> Result<Vec<Radiogram>, Stopped> {
    let window = options.smoothing_m / grid.resolution();
    let margin = (window / 2.0).ceil() + 1.0;
    let mut of_region: Vec<Vec<Projection>> = (0_u8..)
        .zip(&regions.regions)
        .map(|(id, region)| {
            let empty = |&angle: &f64| Projection::new(Radiogram::new(id, angle, grid, margin));
            region.orientations.iter().map(empty).collect()
        })
        .collect();
    for row in 0..grid.height() {
        watch.check()?;
        let tiles = regions.tiles.get(row / regions.tile_cells * regions.columns..).unwrap_or_default();
        for (tile, (cells, &region)) in grid.row(row).chunks(regions.tile_cells).zip(tiles).enumerate() {
            let Some(projections) = of_region.get_mut(usize::from(region)) else { continue };
            for (column, _) in cells.iter().enumerate().filter(|&(_, &cell)| cell == Occupancy::Occupied) {
                for projection in projections.iter_mut() {
                    projection.add(tile * regions.tile_cells + column, row);
                }
            }
        }
    }
    let smoothed = |Projection { mut radiogram, .. }: Projection| {
        radiogram.trim(margin as usize);
        for value in &mut radiogram.values {
            *value *= grid.resolution();
        }
        radiogram.values = signal::smooth_hann(&radiogram.values, window, Boundary::Open);
        radiogram
    };
    Ok(of_region.into_iter().flatten().map(smoothed).collect())
}

/// A radiogram that is being filled, in cells.
struct Projection {
    radiogram: Radiogram,
    normal: [f64; 2],
    /// Position of the grid's corner among the bins.
    origin: f64,
}

impl Projection {
    fn new(radiogram: Radiogram) -> Self {
        let normal = normal(radiogram.orientation);
        let origin = -radiogram.start / radiogram.bin - 0.5;
        Self { radiogram, normal: [normal.x, normal.y], origin }
    }

    /// Shares a cell between the two nearest bins.
    fn add(&mut self, column: usize, row: usize) {
        let position = self.normal[0] * (column as f64 + 0.5) + self.normal[1] * (row as f64 + 0.5) + self.origin;
        let (bin, share) = (position as usize, position.fract());
        self.radiogram.values[bin] += 1.0 - share;
        self.radiogram.values[bin + 1] += share;
    }
}

/// The intervals of an infinite line that lie in the tiles of its region and in the grid.
fn extents(line: &Line, grid: &OccupancyGrid, regions: &RegionMap) -> Vec<[f64; 2]> {
    let resolution = grid.resolution();
    let size = [grid.width() as f64 * resolution, grid.height() as f64 * resolution];
    let across = normal(line.orientation);
    let foot = Point::from(across * line.offset);
    let along = direction(line.orientation);
    let cuts = tile_crossings(foot, along, size, regions.tile_cells as f64 * resolution);
    let is_inside = |point: Point| {
        let cell = grid.cell_at(point);
        cell.is_some_and(|(column, row)| regions.region_of_cell(column, row) == Some(line.region))
    };
    let tolerance = TOLERANCE_CELLS * resolution;
    let beside = across * tolerance;
    let mut intervals: Vec<[f64; 2]> = Vec::new();
    for pair in cuts.windows(2) {
        let middle = foot + along * f64::midpoint(pair[0], pair[1]);
        if !(is_inside(middle + beside) || is_inside(middle - beside)) {
            continue;
        }
        match intervals.last_mut() {
            Some(last) if pair[0] - last[1] <= tolerance => last[1] = pair[1],
            _ => intervals.push([pair[0], pair[1]]),
        }
    }
    intervals.retain(|[start, end]| end - start > tolerance);
    intervals
}

/// Where a line enters and leaves the rectangle from the origin to `size` and crosses the sides of tiles, ascending.
fn tile_crossings(foot: Point, along: crate::Vector, size: [f64; 2], tile: f64) -> Vec<f64> {
    // A component this small is rounding: the line stays in its column or row over any grid.
    let is_parallel = |component: f64| component.abs() < 1e-12;
    let (mut start, mut end) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..2 {
        if is_parallel(along[axis]) {
            continue;
        }
        let [near, far] = [0.0, size[axis]].map(|side| (side - foot[axis]) / along[axis]);
        (start, end) = (start.max(near.min(far)), end.min(near.max(far)));
    }
    if start >= end {
        return Vec::new();
    }
    let mut cuts = vec![start, end];
    for axis in (0..2).filter(|&axis| !is_parallel(along[axis])) {
        let sides = (1..).map(|count| f64::from(count) * tile).take_while(|&side| side < size[axis]);
        let crossings = sides.map(|side| (side - foot[axis]) / along[axis]);
        cuts.extend(crossings.filter(|&crossing| start < crossing && crossing < end));
    }
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    cuts
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::OrientedBox;
    use crate::segmentation::Region;

    /// Regions from digits, one tile of `tile_cells` cells per character, first line on top.
    fn regions(picture: &str, tile_cells: usize, orientations_deg: &[f64]) -> RegionMap {
        let rows: Vec<&str> = picture.split_whitespace().rev().collect();
        let tile = |byte: u8| if byte.is_ascii_digit() { byte - b'0' } else { RegionMap::NONE };
        let tiles: Vec<u8> = rows.iter().flat_map(|row| row.bytes()).map(tile).collect();
        let count =
            tiles.iter().filter(|&&tile| tile != RegionMap::NONE).max().map_or(0, |&last| usize::from(last) + 1);
        let region = Region {
            orientations: orientations_deg.iter().map(|angle| angle.to_radians()).collect(),
            bounds: OrientedBox { center: Point::origin(), half_extents: [0.0; 2], angle: 0.0 },
            share: 1.0,
        };
        let columns = rows.first().map_or(0, |row| row.len());
        RegionMap { tile_cells, columns, rows: rows.len(), tiles, regions: vec![region; count] }
    }

    fn find(grid: &OccupancyGrid, regions: &RegionMap, smoothing_m: f64) -> (Vec<Radiogram>, Vec<Line>) {
        let options =
            DecompositionOptions { smoothing_m, min_distance_m: 0.9, min_peak: 0.3, ..DecompositionOptions::default() };
        lines(grid, regions, &options, &Watch::unwatched()).unwrap()
    }

    /// One line of text per line: region, direction, offset, support, extents.
    fn check(grid: &OccupancyGrid, regions: &RegionMap, wanted: &Expect) {
        let text = |line: &Line| {
            let extents: Vec<String> =
                line.extents.iter().map(|[start, end]| format!("{start:.1}..{end:.1}")).collect();
            let Line { region, orientation, offset, support, .. } = line;
            format!(
                "{region} at {:.0}, {offset:.2} m: {support:.1} m in {}\n",
                orientation.to_degrees(),
                extents.join(" ")
            )
        };
        wanted.assert_eq(&find(grid, regions, 0.0).1.iter().map(text).collect::<String>());
    }

    const ROOMS: &str = "
        ##########
        #....#...#
        #....#...#
        #........#
        ##########
        #........#
        ##########
        ";

    #[test]
    fn walls_become_lines_within_their_cells() {
        let grid = OccupancyGrid::from_ascii(ROOMS, 0.5);
        check(
            &grid,
            &regions("00000 00000 00000 00000", 2, &[-90.0, 0.0]),
            &expect![[r#"
            0 at -90, 0.32 m: 3.5 m in -3.5..0.0
            0 at -90, 1.75 m: 1.5 m in -3.5..0.0
            0 at -90, 2.75 m: 2.5 m in -3.5..0.0
            0 at -90, 4.68 m: 3.5 m in -3.5..0.0
            0 at 0, 0.28 m: 5.0 m in 0.0..5.0
            0 at 0, 1.25 m: 5.0 m in 0.0..5.0
            0 at 0, 3.21 m: 5.0 m in 0.0..5.0
        "#]],
        );
    }

    #[test]
    fn lines_end_with_their_region() {
        let grid = OccupancyGrid::from_ascii(ROOMS, 1.0);
        check(
            &grid,
            &regions("00-11 00-11 00011 00011", 2, &[0.0]),
            &expect![[r#"
            0 at 0, 0.55 m: 6.0 m in 0.0..6.0
            0 at 0, 2.50 m: 6.0 m in 0.0..6.0
            0 at 0, 6.43 m: 4.0 m in 0.0..4.0
            1 at 0, 0.57 m: 4.0 m in 6.0..10.0
            1 at 0, 2.50 m: 4.0 m in 6.0..10.0
            1 at 0, 6.43 m: 4.0 m in 6.0..10.0
        "#]],
        );
    }

    #[test]
    fn a_slanted_line_is_cut_at_the_sides_of_tiles() {
        let grid = OccupancyGrid::from_ascii(
            "
            .......#
            ......#.
            .....#..
            ....#...
            ...#....
            ..#.....
            .#......
            #.......
            ",
            1.0,
        );
        check(
            &grid,
            &regions("0- 00", 4, &[45.0]),
            &expect![[r#"
            0 at 45, 0.00 m: 2.0 m in 0.0..5.7
        "#]],
        );
        check(
            &grid,
            &regions("-0 0-", 4, &[45.0]),
            &expect![[r#"
            0 at 45, 0.00 m: 4.0 m in 0.0..11.3
        "#]],
        );
    }

    #[test]
    fn a_radiogram_keeps_the_occupied_length() {
        let grid = OccupancyGrid::from_ascii(ROOMS, 0.5);
        let (radiograms, _) = find(&grid, &regions("00000 00000 00000 00000", 2, &[0.0, 31.0]), 1.3);
        let occupied = grid.count(Occupancy::Occupied) as f64 * grid.resolution();
        for radiogram in &radiograms {
            assert!((radiogram.values.iter().sum::<f64>() - occupied).abs() < 1e-9);
        }
        assert_eq!(radiograms.len(), 2);
    }

    #[test]
    fn grids_without_regions_or_structure_have_no_lines() {
        let nothing = OccupancyGrid::from_ascii("", 0.05);
        assert_eq!(find(&nothing, &regions("", 2, &[0.0]), 0.25), (vec![], vec![]));
        let free = OccupancyGrid::from_ascii("....", 0.05);
        let (radiograms, lines) = find(&free, &regions("00", 2, &[0.0]), 0.25);
        assert_eq!((radiograms.len(), lines.len()), (1, 0));
        assert_eq!(find(&free, &regions("00", 2, &[]), 0.25), (vec![], vec![]));
    }

    proptest! {
        #[test]
        fn lines_lie_in_the_grid_and_extents_are_apart(
            width in 1_usize..24,
            cells in proptest::collection::vec(0_u8..3, 1..400),
            angle_deg in -90.0..90.0,
            tile_cells in 1_usize..7,
        ) {
            let height = cells.len() / width;
            let cell = |&cell: &u8| [Occupancy::Free, Occupancy::Occupied, Occupancy::Unknown][usize::from(cell)];
            let frame = crate::GridFrame { resolution: 0.3, origin: Point::origin(), yaw: 0.0 };
            let grid = OccupancyGrid::new(width, height, frame, cells[..width * height].iter().map(cell).collect());
            let mut map = regions("0", tile_cells, &[angle_deg]);
            (map.columns, map.rows) = (width.div_ceil(tile_cells), height.div_ceil(tile_cells));
            map.tiles = (0..map.columns * map.rows).map(|tile| if tile % 5 == 3 { RegionMap::NONE } else { 0 }).collect();
            let (_, lines) = find(&grid, &map, 0.7);
            for pair in lines.windows(2) {
                prop_assert!(pair[1].offset - pair[0].offset > 0.9 - 1e-9);
            }
            for line in &lines {
                prop_assert!(line.extents.windows(2).all(|pair| pair[0][1] < pair[1][0]));
                for &[start, end] in &line.extents {
                    prop_assert!(start < end);
                    let middle = normal(line.orientation) * line.offset
                        + direction(line.orientation) * f64::midpoint(start, end);
                    let (column, row) = (middle.x / 0.3, middle.y / 0.3);
                    prop_assert!(column >= -1e-6 && column <= width as f64 + 1e-6, "{column}");
                    prop_assert!(row >= -1e-6 && row <= height as f64 + 1e-6, "{row}");
                }
            }
        }
    }
}
