//! Marks: things, and holes in things, no larger than a place.

use std::f64::consts::FRAC_PI_2;

use super::range::length;
use crate::components::{Component, Components, Neighbours};
use crate::digital_lines::for_each_line;
use crate::geometry::{DisjointSets, direction, normal};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::segmentation::RegionMap;
use crate::watch::{Stopped, Watch};

/// Longer than any place and than any row is deep, metres.
const LONGEST_M: f64 = 3.4;
/// A long line may be broken for so many cells.
const BROKEN: usize = 1;
/// Dots are no longer than this, metres, and no further from the next dot of their line than that.
const DOT_M: f64 = 0.4;
const DOTTED_M: f64 = 0.5;
/// What lies mostly within so many cells of a long line is its steps where it lies aslant.
const STEPS: usize = 3;
/// What is left beside a long line is smaller than a mark, metres.
const LEAST_REST_M: f64 = 0.12;

/// A box in the frame of a region, metres along its first direction and across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mark {
    pub sides: [[f64; 2]; 2],
    /// Number of things in it.
    pub things: usize,
}

impl Mark {
    /// The box around cells of a grid, in a frame turned by `angle`; `None` around none.
    fn around(grid: &OccupancyGrid, angle: f64, cells: impl Iterator<Item = usize>) -> Option<Self> {
        let units = [direction(angle), normal(angle)];
        let half = grid.resolution() / 2.0;
        let of_cell = |cell: usize| {
            let center = grid.center(cell % grid.width(), cell / grid.width()).coords;
            units.map(|unit| unit.dot(&center)).map(|place| [place - half, place + half])
        };
        Some(Self { sides: cells.map(of_cell).reduce(around)?, things: 1 })
    }

    fn joined(&self, other: &Self) -> Self {
        Self { sides: around(self.sides, other.sides), things: self.things + other.things }
    }

    fn is_small(&self) -> bool {
        self.sides.iter().all(|&side| length(side) <= LONGEST_M)
    }
}

/// The box around two boxes.
fn around(one: [[f64; 2]; 2], other: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    [0, 1].map(|axis| [one[axis][0].min(other[axis][0]), one[axis][1].max(other[axis][1])])
}

/// The marks of a region: occupied things, what stands off the long lines of larger things, and holes.
pub(super) struct Marks {
    pub things: Vec<Mark>,
    pub holes: Vec<Mark>,
}

/// What is connected on a grid.
pub(super) struct GridParts {
    occupied: Components,
    free: Components,
}

impl GridParts {
    pub fn of(grid: &OccupancyGrid, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let size = [grid.width(), grid.cells().len()];
        let parts = |wanted: Occupancy, neighbours| {
            Components::of(size, neighbours, |cell| grid.cells()[cell] == wanted, watch)
        };
        let occupied = parts(Occupancy::Occupied, Neighbours::Eight)?;
        Ok(Self { occupied, free: parts(Occupancy::Free, Neighbours::Four)? })
    }
}

impl Marks {
    /// Those of a region with a first direction, radians.
    pub fn find(
        grid: &OccupancyGrid,
        parts: &GridParts,
        regions: &RegionMap,
        (region, angle): (u8, f64),
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let size = [grid.width(), grid.cells().len()];
        let is_in_region =
            |cell: usize| regions.region_of_cell(cell % grid.width(), cell / grid.width()) == Some(region);
        let mark_of =
            |part: Component<'_>| is_in_region(part.first()).then(|| Mark::around(grid, angle, part.cells())).flatten();
        let mut things = Vec::new();
        let mut is_large = vec![false; grid.cells().len()];
        for thing in parts.occupied.iter() {
            watch.check()?;
            if may_be_small(thing, grid) {
                things.extend(mark_of(thing).filter(Mark::is_small));
            } else {
                thing.cells().filter(|&cell| is_in_region(cell)).for_each(|cell| is_large[cell] = true);
            }
        }
        let is_near = clear_long_lines(grid, &mut is_large, angle, watch)?;
        let rests = Components::of(size, Neighbours::Eight, |cell| is_large[cell], watch)?;
        let is_seen = |mark: &Mark| mark.sides.iter().any(|&side| length(side) >= LEAST_REST_M);
        let stands_off = |rest: &Component<'_>| 2 * rest.cells().filter(|&cell| is_near[cell]).count() < rest.len();
        things.extend(
            rests.iter().filter(stands_off).filter_map(mark_of).filter(|mark| mark.is_small() && is_seen(mark)),
        );
        let holes = parts
            .free
            .iter()
            .filter(|&hole| may_be_small(hole, grid))
            .filter_map(mark_of)
            .filter(Mark::is_small)
            .collect();
        Ok(Self { things, holes })
    }
}

/// Whether a component fits into the box of a mark, however it is turned.
fn may_be_small(part: Component<'_>, grid: &OccupancyGrid) -> bool {
    part.bounds().iter().all(|side| side.len() as f64 * grid.resolution() <= LONGEST_M * std::f64::consts::SQRT_2)
}

/// Clears the lines along a direction and across it that are longer than any place, walls and the fronts of rows, with the
/// cells beside them; tells which cells are near such lines.
fn clear_long_lines(
    grid: &OccupancyGrid,
    is_in: &mut [bool],
    angle: f64,
    watch: &Watch<'_>,
) -> Result<Vec<bool>, Stopped> {
    let longest = (LONGEST_M / grid.resolution()) as usize;
    let mut long = Vec::new();
    for angle in [angle, angle + FRAC_PI_2] {
        for_each_line([grid.width(), grid.height()], angle, watch, |line| {
            let mut run = 0..0;
            let is_end = std::iter::once((line.len() + BROKEN + 1, None));
            let cells = line.iter().copied().enumerate().filter(|&(_, cell)| is_in[cell]);
            for (place, cell) in cells.map(|(place, cell)| (place, Some(cell))).chain(is_end) {
                if place > run.end + BROKEN {
                    if run.len() >= longest {
                        long.extend_from_slice(&line[run.clone()]);
                    }
                    run.start = place;
                }
                run.end = if cell.is_some() { place + 1 } else { place };
            }
        })?;
    }
    let mut is_near = vec![false; is_in.len()];
    let width = grid.width();
    for cell in long {
        let (column, row) = (cell % width, cell / width);
        let mark = |cells: &mut [bool], reach: usize, value: bool| {
            for row in row.saturating_sub(reach)..(row + reach + 1).min(grid.height()) {
                let start = row * width;
                cells[start + column.saturating_sub(reach)..start + (column + reach + 1).min(width)].fill(value);
            }
        };
        mark(is_in, 1, false);
        mark(&mut is_near, STEPS, true);
    }
    Ok(is_near)
}

/// The same marks, dots in a line across the rows as one frame; rows run along the side `axis`.
pub(super) fn with_dotted_frames(marks: &[Mark], axis: usize, watch: &Watch<'_>) -> Result<Vec<Mark>, Stopped> {
    let (dots, mut found): (Vec<Mark>, Vec<Mark>) =
        marks.iter().partition(|mark| mark.sides.iter().all(|&side| length(side) <= DOT_M));
    let mut order: Vec<usize> = (0..dots.len()).collect();
    order.sort_by(|&one, &other| dots[one].sides[axis][0].total_cmp(&dots[other].sides[axis][0]));
    let mut sets = DisjointSets::new(dots.len());
    let gap = |one: [f64; 2], other: [f64; 2]| one[0].max(other[0]) - one[1].min(other[1]);
    for (index, &one) in order.iter().enumerate() {
        watch.check()?;
        let near =
            order[index + 1..].iter().take_while(|&&other| dots[other].sides[axis][0] <= dots[one].sides[axis][1]);
        for &other in near.filter(|&&other| gap(dots[one].sides[1 - axis], dots[other].sides[1 - axis]) <= DOTTED_M) {
            sets.join(one, other);
        }
    }
    let mut frames: Vec<Option<Mark>> = vec![None; dots.len()];
    for (number, dot) in dots.iter().enumerate() {
        let frame = &mut frames[sets.find(number)];
        *frame = Some(frame.map_or(*dot, |frame| frame.joined(dot)));
    }
    found.extend(frames.into_iter().flatten().filter(Mark::is_small));
    Ok(found)
}
