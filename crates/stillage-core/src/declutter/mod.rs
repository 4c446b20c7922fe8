//! Declutter: single hits and small holes are removed before any stage relies on free space.
//!
//! Scanners leave single hits in free space, and one of them would close an aisle for every stage that measures widths.
//! Size alone does not tell them from structure: a rack post of 0.09 m is one to four cells. So the occupied cells
//! around a small component decide, and how many components are like it:
//!
//! 1. The rate of speckle is measured on the cleanest tiles of the map, which hold nothing but floor.
//! 2. A small component is *lone* unless the occupied area around it is more than speckle of that rate would bring.
//!    Lone components are removed, except large ones (posts).
//! 3. The others are classed by size and surroundings. Speckle of the rate would bring a known number of each class;
//!    where that is most of the class, the whole class is removed. So hits on the floor before a rack are removed, and
//!    the legs at the border of what the scanner saw are not.
//! 4. Where most small components stand in rows at equal distances, or, on a map without speckle, have one step in common,
//!    they are posts, and none is removed.
//! 5. Removed cells take the state of the cells around them. Small unknown holes in free space become free; small free
//!    specks in unknown ground become unknown, so that ground nobody saw stays outside the site.
//!
//! Source: the connected-component filters of document analysis (kFill, L. O'Gorman 1992), with the local density in
//! place of a fixed size, and the false discovery rate (Y. Benjamini and Y. Hochberg 1995, doi
//! 10.1111/j.2517-6161.1995.tb02031.x) in place of a threshold. Cost: O(cells). Limits: lone posts below three cells
//! are removed; hits that touch structure stay.

mod repetition;

use std::borrow::Cow;

use repetition::Repetition;
use serde::{Deserialize, Serialize};

use crate::components::{Component, Components, Neighbours};
use crate::geometry::Point;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::spec::{DeclutterMethod, DeclutterOptions};
use crate::watch::{Stopped, Watch};

/// Area above which a component is structure, whatever is around it, square metres: that of a block of a pallet.
const SMALL_AREA: f64 = 0.02;
/// Fewest cells of a lone component that is kept as a post: three touching hits are rarely speckle.
const POST_CELLS: usize = 3;
/// Least area of a lone component that is kept as a post, square metres: a post of 0.09 m has 0.008.
const POST_AREA: f64 = 0.006;
/// Half the side of the square in which occupied cells are counted, metres: the blocks of a pallet are 0.35 to 0.6 m
/// apart.
const NEIGHBOURHOOD_REACH_M: f64 = 0.5;
/// Occupied area around a component that is not lone, square metres: two posts, or three blocks of a pallet that are
/// hardly seen.
const NEIGHBOUR_AREA: f64 = 0.015;
/// Poisson deviations by which the cells around must exceed the expected speckle as well.
/// No measurement is recorded for this value.
const DEVIATIONS: f64 = 4.0;
/// Side of the tiles in which the rate of speckle is measured, metres.
const RATE_TILE_M: f64 = 4.0;
/// Rank of the tile whose rate is taken, as a share of the tiles: a fifth of them hold nothing but floor.
const RATE_RANK: f64 = 0.2;
/// Rate below which a map has no speckle, hits per cell: one in 2000.
const CLEAN_RATE: f64 = 5e-4;
/// Number of eight-connected shapes of one, two, three and four cells (fixed polyplets): the ways in which hits can
/// touch.
const SHAPES: [f64; 4] = [1.0, 4.0, 20.0, 110.0];
/// Share of the small components that stand in rows at equal distances from which on they are the posts of racks: the
/// majority.
const IN_ROWS_SHARE: f64 = 0.5;
/// Share of the small components of a map without speckle from which one step leads to another one: the legs of pods have it,
/// however many places are empty.
const COMMON_STEP_SHARE: f64 = 0.7;
/// Expected speckle above which a class of components is removed, as a share of the class: the majority.
const SPECKLE_SHARE: f64 = 0.5;
/// Largest area of a hole or speck, square metres.
const HOLE_AREA: f64 = 0.03;

/// A grid without clutter, and what was removed.
#[derive(Debug, Clone, PartialEq)]
pub struct Decluttered {
    /// The grid, with the clutter as free or unknown as the cells around it.
    pub grid: OccupancyGrid,
    /// What was removed.
    pub removed: Removed,
}

/// Cells whose state was changed.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Removed {
    /// Occupied cells (row-major index) taken for speckle, ascending.
    pub occupied: Vec<u32>,
    /// Unknown cells (row-major index) taken for holes, ascending.
    pub unknown: Vec<u32>,
    /// Rate of speckle: hits of one cell per free cell of clean floor.
    pub rate: f64,
}

impl Removed {
    /// A map without what was taken for clutter: all of it counts as free, as nearly all of it stands on free ground.
    pub(crate) fn taken_from<'a>(&self, grid: &'a OccupancyGrid) -> Cow<'a, OccupancyGrid> {
        if self.occupied.is_empty() && self.unknown.is_empty() {
            return Cow::Borrowed(grid);
        }
        let mut cells = grid.cells().to_vec();
        for &cell in self.occupied.iter().chain(&self.unknown) {
            cells[cell as usize] = Occupancy::Free;
        }
        Cow::Owned(OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), cells))
    }
}

/// Removes single hits, small holes and specks, if the options say so.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn declutter(grid: &OccupancyGrid, options: &DeclutterOptions, watch: &Watch<'_>) -> Result<Decluttered, Stopped> {
    match options.method {
        DeclutterMethod::Adaptive => without_clutter(grid, watch),
        DeclutterMethod::None => Ok(Decluttered { grid: grid.clone(), removed: Removed::default() }),
    }
}

fn without_clutter(grid: &OccupancyGrid, watch: &Watch<'_>) -> Result<Decluttered, Stopped> {
    let obstacles = components(grid, Occupancy::Occupied, watch)?;
    let rate = speckle_rate(grid, &obstacles, watch)?;
    let counts = OccupiedCounts::new(grid, watch)?;
    let cell_area = grid.resolution() * grid.resolution();
    let is_lone = |cell: usize, own: usize| {
        let (count, window) = counts.around(cell);
        let expected = rate * window as f64;
        (count.saturating_sub(own) as f64) < NEIGHBOUR_AREA / cell_area + expected + DEVIATIONS * expected.sqrt()
    };
    let speckle = SpeckleClasses::of(grid, &obstacles, rate, is_lone, watch)?;
    let is_clutter = |component: &Component<'_>| {
        let area = component.len() as f64 * cell_area;
        if area > SMALL_AREA {
            false
        } else if is_lone(component.first(), component.len()) {
            let is_post = area >= POST_AREA && (rate < CLEAN_RATE || component.len() >= POST_CELLS);
            !is_post || speckle.explains(component.len(), true, Surroundings::around(grid, component.cells()))
        } else {
            speckle.explains(component.len(), false, Surroundings::around(grid, component.cells()))
        }
    };
    let small = obstacles.iter().filter(|component| component.len() as f64 * cell_area <= SMALL_AREA);
    let places: Vec<Point> = small.map(|component| middle(component, grid)).collect();
    let repetition = Repetition::of(&places, grid.resolution());
    let are_posts = repetition.share_in_rows() >= IN_ROWS_SHARE
        || rate < CLEAN_RATE && repetition.share_with_common_step() >= COMMON_STEP_SHARE;
    let clutter: Vec<Component<'_>> =
        if are_posts { Vec::new() } else { obstacles.iter().filter(is_clutter).collect() };
    let mut occupied: Vec<u32> = clutter.iter().flat_map(Component::cells).map(|cell| cell as u32).collect();
    occupied.sort_unstable();
    let mut unknown: Vec<u32> = components(grid, Occupancy::Unknown, watch)?
        .iter()
        .filter(|hole| {
            hole.len() as f64 * cell_area <= HOLE_AREA
                && is_clear_of_obstacles(grid, *hole)
                && !is_at_border(grid, *hole)
        })
        .flat_map(|hole| hole.cells())
        .map(|cell| cell as u32)
        .collect();
    unknown.sort_unstable();
    let mut cells = grid.cells().to_vec();
    for &cell in &unknown {
        cells[cell as usize] = Occupancy::Free;
    }
    for component in clutter {
        let ground = ground_around(grid, component);
        component.cells().for_each(|cell| cells[cell] = ground);
    }
    let specks = OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), cells.clone());
    for speck in components(&specks, Occupancy::Free, watch)?.iter() {
        let is_small = speck.len() as f64 * cell_area <= HOLE_AREA;
        if is_small && is_clear_of_obstacles(&specks, speck) && ground_around(&specks, speck) == Occupancy::Unknown {
            speck.cells().for_each(|cell| cells[cell] = Occupancy::Unknown);
        }
    }
    let clean = OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), cells);
    Ok(Decluttered { grid: clean, removed: Removed { occupied, unknown, rate } })
}

/// The middle of the first and the last cell of a small component, metres.
fn middle(component: Component<'_>, grid: &OccupancyGrid) -> Point {
    let [columns, rows] = component.bounds().map(|side| f64::midpoint(side.start as f64, side.end as f64));
    Point::new(columns, rows) * grid.resolution()
}

/// What lies around a cell or a small component, beside other occupied cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Surroundings {
    /// Free cells only: on the floor.
    Free,
    /// Unknown cells only: behind what the scanner saw.
    Unknown,
    /// Both.
    Mixed,
}

impl Surroundings {
    fn around(grid: &OccupancyGrid, cells: impl Iterator<Item = usize>) -> Self {
        let (mut is_free, mut is_unknown) = (false, false);
        for cell in cells {
            let (column, row) = (cell % grid.width(), cell / grid.width());
            for row in row.saturating_sub(1)..grid.height().min(row + 2) {
                for &near in &grid.row(row)[column.saturating_sub(1)..grid.width().min(column + 2)] {
                    is_free |= near == Occupancy::Free;
                    is_unknown |= near == Occupancy::Unknown;
                }
            }
        }
        match (is_free, is_unknown) {
            (true, false) => Self::Free,
            (false, true) => Self::Unknown,
            _ => Self::Mixed,
        }
    }
}

/// The classes of components that are speckle: as many as its rate would bring.
struct SpeckleClasses {
    /// By number of cells less one, then by [`class`].
    explains: [[bool; CLASSES]; SHAPES.len()],
}

/// Number of classes of one size: lone or not, in three kinds of surroundings.
const CLASSES: usize = 6;

fn class(is_lone: bool, ground: Surroundings) -> usize {
    ground as usize + if is_lone { CLASSES / 2 } else { 0 }
}

impl SpeckleClasses {
    fn of(
        grid: &OccupancyGrid,
        components: &Components,
        rate: f64,
        is_lone: impl Fn(usize, usize) -> bool,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let mut explains = [[false; CLASSES]; SHAPES.len()];
        if rate < CLEAN_RATE {
            return Ok(Self { explains });
        }
        let mut cells = [0_usize; CLASSES];
        for row in 0..grid.height() {
            watch.check()?;
            for (column, &cell) in grid.row(row).iter().enumerate() {
                let index = row * grid.width() + column;
                if cell != Occupancy::Occupied {
                    cells[class(is_lone(index, 0), Surroundings::around(grid, std::iter::once(index)))] += 1;
                }
            }
        }
        let mut counts = [[0_usize; CLASSES]; SHAPES.len()];
        for component in components.iter().filter(|component| component.len() <= SHAPES.len()) {
            let is_lone = is_lone(component.first(), component.len());
            counts[component.len() - 1][class(is_lone, Surroundings::around(grid, component.cells()))] += 1;
        }
        for (size, shapes) in SHAPES.iter().enumerate() {
            for class in 0..CLASSES {
                let expected = shapes * rate.powi(size as i32 + 1) * cells[class] as f64;
                explains[size][class] = expected > SPECKLE_SHARE * counts[size][class] as f64;
            }
        }
        Ok(Self { explains })
    }

    fn explains(&self, cells: usize, is_lone: bool, ground: Surroundings) -> bool {
        self.explains.get(cells - 1).is_some_and(|of_size| of_size[class(is_lone, ground)])
    }
}

/// The state that a removed component takes: unknown where most of its free and unknown neighbours are.
fn ground_around(grid: &OccupancyGrid, component: Component<'_>) -> Occupancy {
    let (mut free, mut unknown) = (0, 0);
    for cell in component.cells() {
        let (column, row) = ((cell % grid.width()) as i64, (cell / grid.width()) as i64);
        for (right, up) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
            let (column, row) = (column + right, row + up);
            let in_grid = (0..grid.width() as i64).contains(&column) && (0..grid.height() as i64).contains(&row);
            match grid.at(column, row) {
                Occupancy::Free => free += 1,
                Occupancy::Unknown if in_grid => unknown += 1,
                _ => {}
            }
        }
    }
    if unknown > free { Occupancy::Unknown } else { Occupancy::Free }
}

/// Whether no occupied cell touches a component.
fn is_clear_of_obstacles(grid: &OccupancyGrid, component: Component<'_>) -> bool {
    component.cells().all(|cell| {
        let (column, row) = ((cell % grid.width()) as i64, (cell / grid.width()) as i64);
        let beside = [(1, 0), (-1, 0), (0, 1), (0, -1)].map(|(right, up)| grid.at(column + right, row + up));
        beside.into_iter().all(|near| near != Occupancy::Occupied)
    })
}

/// Whether a component reaches the border of the grid.
fn is_at_border(grid: &OccupancyGrid, component: Component<'_>) -> bool {
    component.cells().any(|cell| {
        let (column, row) = (cell % grid.width(), cell / grid.width());
        column == 0 || row == 0 || column + 1 == grid.width() || row + 1 == grid.height()
    })
}

/// Rate of speckle: hits of one cell per free cell, of the tile at [`RATE_RANK`] in ascending order.
fn speckle_rate(grid: &OccupancyGrid, components: &Components, watch: &Watch<'_>) -> Result<f64, Stopped> {
    let side = ((RATE_TILE_M / grid.resolution()) as usize).max(1);
    let (columns, rows) = (grid.width().div_ceil(side), grid.height().div_ceil(side));
    let tile_of = |column: usize, row: usize| row / side * columns + column / side;
    let (mut free, mut lone) = (vec![0_usize; columns * rows], vec![0_usize; columns * rows]);
    for row in 0..grid.height() {
        watch.check()?;
        for (column, &cell) in grid.row(row).iter().enumerate() {
            free[tile_of(column, row)] += usize::from(cell == Occupancy::Free);
        }
    }
    for component in components.iter().filter(|component| component.len() == 1) {
        let cell = component.first();
        lone[tile_of(cell % grid.width(), cell / grid.width())] += 1;
    }
    let mut rates: Vec<f64> = free
        .iter()
        .zip(&lone)
        .filter(|&(&free, _)| 2 * free > side * side)
        .map(|(&free, &lone)| lone as f64 / free as f64)
        .collect();
    rates.sort_by(f64::total_cmp);
    let rank = (RATE_RANK * rates.len() as f64) as usize;
    Ok(rates.get(rank).copied().unwrap_or(0.0))
}

/// Eight-connected components of the cells of one occupancy.
fn components(grid: &OccupancyGrid, occupancy: Occupancy, watch: &Watch<'_>) -> Result<Components, Stopped> {
    let cells = grid.cells();
    Components::of([grid.width(), cells.len()], Neighbours::Eight, |cell| cells[cell] == occupancy, watch)
}

/// Counts of occupied cells in any rectangle, by a summed-area table (F. C. Crow 1984, doi 10.1145/800031.808600).
struct OccupiedCounts {
    width: usize,
    height: usize,
    reach: usize,
    /// Occupied cells below and left of each corner of the cells, `(width + 1) * (height + 1)` of them.
    sums: Vec<u32>,
}

impl OccupiedCounts {
    fn new(grid: &OccupancyGrid, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let (width, height) = (grid.width(), grid.height());
        let mut sums = vec![0_u32; (width + 1) * (height + 1)];
        for row in 0..height {
            watch.check()?;
            let mut along = 0;
            for (column, &cell) in grid.row(row).iter().enumerate() {
                along += u32::from(cell == Occupancy::Occupied);
                sums[(row + 1) * (width + 1) + column + 1] = sums[row * (width + 1) + column + 1] + along;
            }
        }
        let reach = (NEIGHBOURHOOD_REACH_M / grid.resolution()).round() as usize;
        Ok(Self { width, height, reach, sums })
    }

    /// Occupied cells in the square around a cell, and all cells of that square.
    fn around(&self, cell: usize) -> (usize, usize) {
        let (column, row) = (cell % self.width, cell / self.width);
        let (left, right) = (column.saturating_sub(self.reach), (column + self.reach + 1).min(self.width));
        let (low, high) = (row.saturating_sub(self.reach), (row + self.reach + 1).min(self.height));
        let at = |column: usize, row: usize| self.sums[row * (self.width + 1) + column] as usize;
        (at(right, high) + at(left, low) - at(left, high) - at(right, low), (right - left) * (high - low))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::hash::split_mix;

    fn removed(picture: &str, resolution: f64) -> (usize, usize) {
        let grid = OccupancyGrid::from_ascii(picture, resolution);
        let found = without_clutter(&grid, &Watch::unwatched()).expect("nobody stops it");
        (found.removed.occupied.len(), found.removed.unknown.len())
    }

    #[test]
    fn a_lone_hit_goes_and_a_wall_stays() {
        let wall = "#".repeat(60);
        let floor = format!("#{}#", ".".repeat(58));
        let hit = format!("#{}#{}#", ".".repeat(29), ".".repeat(28));
        let rows: Vec<&str> = (0..40)
            .map(|row| match row {
                0 | 39 => wall.as_str(),
                20 => &hit,
                _ => &floor,
            })
            .collect();
        assert_eq!(removed(&rows.join("\n"), 0.05), (1, 0));
    }

    #[test]
    fn the_blocks_of_a_pallet_stay() {
        let row = "................##.....##.....##................\n";
        let gap = "................................................\n";
        let picture: String = (0..30).map(|line| if line % 7 == 3 && line < 20 { row } else { gap }).collect();
        assert_eq!(removed(&picture, 0.05), (0, 0));
    }

    #[test]
    fn a_small_hole_in_free_space_is_free() {
        assert_eq!(removed("......\n..?...\n......", 0.05), (0, 1));
        assert_eq!(removed("......\n.#?...\n......", 0.05), (1, 0));
    }

    #[test]
    fn hits_before_a_rack_go_and_the_legs_of_its_pallets_stay() {
        // A hit on one of 128 cells anywhere, and three rows of legs of two by two cells.
        let hit = |row: usize, column: usize| split_mix((200 * row + column) as u64).is_multiple_of(128);
        let leg = |row: usize, column: usize| {
            (58..80).contains(&row) && row % 8 < 2 && (20..180).contains(&column) && column % 8 < 2
        };
        let cell = |row, column| if hit(row, column) || leg(row, column) { '#' } else { '.' };
        let rows: Vec<String> = (0..160).map(|row| (0..200).map(|column| cell(row, column)).collect()).collect();
        let grid = OccupancyGrid::from_ascii(&rows.join("\n"), 0.05);
        let found = without_clutter(&grid, &Watch::unwatched()).expect("nobody stops it");
        expect_test::expect!["171 of 436 hits and legs stay"].assert_eq(&format!(
            "{} of {} hits and legs stay",
            found.grid.count(Occupancy::Occupied),
            grid.count(Occupancy::Occupied)
        ));
    }

    #[test]
    fn specks_in_unknown_ground_are_unknown() {
        let grid = OccupancyGrid::from_ascii("?????\n?#?.?\n?????", 0.05);
        let found = without_clutter(&grid, &Watch::unwatched()).expect("nobody stops it");
        assert_eq!(found.grid.count(Occupancy::Unknown), 15);
    }

    #[test]
    fn degenerate_grids_keep_their_cells() {
        for picture in ["", "?", "..", "??\n??"] {
            assert_eq!(removed(picture, 0.05), (0, 0), "{picture}");
        }
    }
}
