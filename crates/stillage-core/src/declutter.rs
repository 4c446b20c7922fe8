//! Declutter: lone hits and thin leaks are told from structure before anything relies on free space.
//!
//! Scanners leave single hits in free space, and one of them closes an aisle for everything that asks how wide it is.
//! Size alone does not tell them from structure: a rack post of 0.09 m is one to four cells. What tells is company.
//! A small component of occupied cells is lone unless more occupied area lies around it than speckle of the rate that
//! this very map shows would bring there; the rate is read from the cleanest tiles, where there is nothing else. Lone
//! ones go. Of those in company, hits are told from structure by their number: speckle falls on the ground beside goods
//! as often as on the open floor, so of so many components of one size on one kind of ground, so many are expected to
//! be speckle. Where that is most of them, all go: hits on the floor before a rack do, legs at the rim of what the
//! scanner saw do not. What goes takes the state of the ground around it. Small unknown holes in free space are free,
//! and small free specks in unknown ground unknown: ground that nobody saw stays outside the site.
//!
//! Source: the connected-component filters of document analysis (kFill and its kin, L. O'Gorman 1992), with the local
//! density in place of a fixed size, and the false discovery rate (Y. Benjamini and Y. Hochberg 1995, doi
//! 10.1111/j.2517-6161.1995.tb02031.x) in place of a threshold. Cost: O(cells). Limits: lone posts below three cells
//! are taken for speckle; hits that touch structure stay.

use serde::{Deserialize, Serialize};

use crate::components::{Component, Components, Neighbours};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::spec::{DeclutterMethod, DeclutterOptions};
use crate::watch::{Stopped, Watch};

/// Components above this area are structure whatever stands around them, square metres (a block of a pallet has 0.02).
const SMALL_AREA: f64 = 0.02;
/// Components of at least so many cells and so much area are seldom speckle: three hits that touch.
const FIRM_CELLS: usize = 3;
/// See [`FIRM_CELLS`]; a post of 0.09 m has 0.008 square metres.
const FIRM_AREA: f64 = 0.006;
/// Half the window in which company is counted, metres: the blocks of a pallet are 0.35 to 0.6 m apart.
const COMPANY_REACH_M: f64 = 0.5;
/// Occupied area that is company, square metres: two posts, or three blocks of a pallet of which little is seen.
const COMPANY_AREA: f64 = 0.015;
/// Deviations of a Poisson count that company must be above the speckle that is expected.
const DEVIATIONS: f64 = 4.0;
/// Side of the tiles in which the rate of speckle is measured, metres.
const RATE_TILE_M: f64 = 4.0;
/// Rank among the tiles that is taken for the rate: a fifth of the tiles hold nothing but floor.
const RATE_RANK: f64 = 0.2;
/// Rate below which a map is clean: a lone hit in 2000 cells.
const CLEAN_RATE: f64 = 5e-4;
/// Number of eight-connected shapes of one cell, two, three and four: so many ways hits have to touch.
const SHAPES: [f64; 4] = [1.0, 4.0, 20.0, 110.0];
/// Share of the components of one size and ground that may be speckle before all of them are taken for it.
const MOST_CHANCE: f64 = 0.5;
/// Unknown holes up to this area are free when free cells surround them, square metres.
const HOLE_AREA: f64 = 0.03;

/// A grid without clutter, and what was taken away.
#[derive(Debug, Clone, PartialEq)]
pub struct Decluttered {
    /// The grid with the clutter turned into the ground around it, free or unknown.
    pub grid: OccupancyGrid,
    /// What was removed.
    pub removed: Removed,
}

/// Cells that were read otherwise than the map says.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Removed {
    /// Occupied cells (row-major index) taken for speckle, ascending.
    pub occupied: Vec<u32>,
    /// Unknown cells (row-major index) taken for holes, ascending.
    pub unknown: Vec<u32>,
    /// Share of the floor's cells that carry a lone hit.
    pub rate: f64,
}

/// Turns lone hits, small holes and specks into the ground around them, if the options say so.
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
    let hits = components(grid, Occupancy::Occupied, watch)?;
    let rate = speckle_rate(grid, &hits, watch)?;
    let company = Company::new(grid, watch)?;
    let cell_area = grid.resolution() * grid.resolution();
    let is_lone = |cell: usize, own: usize| {
        let (count, window) = company.around(cell);
        let expected = rate * window as f64;
        (count.saturating_sub(own) as f64) < COMPANY_AREA / cell_area + expected + DEVIATIONS * expected.sqrt()
    };
    let chance = Chance::of(grid, &hits, rate, is_lone, watch)?;
    let is_clutter = |component: &Component<'_>| {
        let area = component.len() as f64 * cell_area;
        if area > SMALL_AREA {
            false
        } else if is_lone(component.first(), component.len()) {
            let is_firm = area >= FIRM_AREA && (rate < CLEAN_RATE || component.len() >= FIRM_CELLS);
            !is_firm || chance.explains(component.len(), true, Ground::around(grid, component.cells()))
        } else {
            chance.explains(component.len(), false, Ground::around(grid, component.cells()))
        }
    };
    let clutter: Vec<Component<'_>> = hits.iter().filter(is_clutter).collect();
    let mut occupied: Vec<u32> = clutter.iter().flat_map(Component::cells).map(|cell| cell as u32).collect();
    occupied.sort_unstable();
    let mut unknown: Vec<u32> = components(grid, Occupancy::Unknown, watch)?
        .iter()
        .filter(|hole| {
            hole.len() as f64 * cell_area <= HOLE_AREA && stands_off(grid, *hole) && !is_at_border(grid, *hole)
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
        if is_small && stands_off(&specks, speck) && ground_around(&specks, speck) == Occupancy::Unknown {
            speck.cells().for_each(|cell| cells[cell] = Occupancy::Unknown);
        }
    }
    let clean = OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), cells);
    Ok(Decluttered { grid: clean, removed: Removed { occupied, unknown, rate } })
}

/// What lies around a cell or a small component, beside other occupied cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ground {
    /// Free cells only: the floor.
    Free,
    /// Unknown cells only: behind what the scanner saw.
    Unknown,
    /// Both.
    Rim,
}

impl Ground {
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
            _ => Self::Rim,
        }
    }
}

/// Which components are as many as chance would have them.
struct Chance {
    /// By number of cells less one, then by company and ground.
    explains: [[bool; CLASSES]; SHAPES.len()],
}

/// Lone or in company, on three kinds of ground.
const CLASSES: usize = 6;

fn class(is_lone: bool, ground: Ground) -> usize {
    ground as usize + if is_lone { CLASSES / 2 } else { 0 }
}

impl Chance {
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
                    cells[class(is_lone(index, 0), Ground::around(grid, std::iter::once(index)))] += 1;
                }
            }
        }
        let mut counts = [[0_usize; CLASSES]; SHAPES.len()];
        for component in components.iter().filter(|component| component.len() <= SHAPES.len()) {
            let is_lone = is_lone(component.first(), component.len());
            counts[component.len() - 1][class(is_lone, Ground::around(grid, component.cells()))] += 1;
        }
        for (size, shapes) in SHAPES.iter().enumerate() {
            for class in 0..CLASSES {
                let expected = shapes * rate.powi(size as i32 + 1) * cells[class] as f64;
                explains[size][class] = expected > MOST_CHANCE * counts[size][class] as f64;
            }
        }
        Ok(Self { explains })
    }

    fn explains(&self, cells: usize, is_lone: bool, ground: Ground) -> bool {
        self.explains.get(cells - 1).is_some_and(|of_size| of_size[class(is_lone, ground)])
    }
}

/// What surrounds a small component: unknown where most of its neighbours are.
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
fn stands_off(grid: &OccupancyGrid, component: Component<'_>) -> bool {
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

/// Share of the cells of clean floor that are a component of their own: the lower fifth of the tiles.
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

/// Counts of occupied cells in any rectangle.
struct Company {
    width: usize,
    height: usize,
    reach: usize,
    /// Sums over all cells below and left of a corner, `(width + 1) * (height + 1)` of them.
    sums: Vec<u32>,
}

impl Company {
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
        let reach = (COMPANY_REACH_M / grid.resolution()).round() as usize;
        Ok(Self { width, height, reach, sums })
    }

    /// Occupied cells around a cell, and the cells of the window.
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
    fn the_blocks_of_a_pallet_keep_each_other_company() {
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
        // A hit on every sixteenth cell of each eighth row, and three rows of legs of two by two cells.
        let hit = |row: usize, column: usize| row % 8 == 4 && (column + 5 * row) % 16 == 3;
        let leg = |row: usize, column: usize| {
            (58..80).contains(&row) && row % 8 < 2 && (20..180).contains(&column) && column % 8 < 2
        };
        let cell = |row, column| if hit(row, column) || leg(row, column) { '#' } else { '.' };
        let rows: Vec<String> = (0..160).map(|row| (0..200).map(|column| cell(row, column)).collect()).collect();
        let grid = OccupancyGrid::from_ascii(&rows.join("\n"), 0.05);
        let found = without_clutter(&grid, &Watch::unwatched()).expect("nobody stops it");
        expect_test::expect!["160 of 410 hits and legs stay"].assert_eq(&format!(
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
