//! The face of every cell: the paper's membership function M(f), inverted. A cell lies in the face of its centre.
//!
//! Method: where an edge crosses a row of cell centres, the face changes from the one on its left to the one on its
//! right. The exclusive or of both ids is written to the first centre at or beyond the crossing. The running exclusive
//! or along the row then gives the id of the face, because every id that was left has been written twice. The order of
//! crossings between two centres does not matter, so nothing is sorted, and each centre lies in exactly one face. A
//! centre on an edge belongs to the face on its right, one on a level edge to the face above.
//!
//! Cost: O(cells + crossings), in parallel by bands of rows; 2 bytes for each cell, 4 where a map has more than 65,536 faces.

use std::ops::{BitXorAssign, Range};

use rayon::prelude::*;

use super::ids::{EdgeId, FaceId};
use super::subdivision::Subdivision;
use crate::geometry::{Point, RigidMotion};
use crate::grid::OccupancyGrid;

/// Rows that one task fills: 64 rows of 4,000 cells of 4 bytes at most are 1 MB and fit a second-level cache.
const BAND_ROWS: usize = 64;

/// The face of every cell of a grid, by its centre.
#[derive(Debug, Clone, PartialEq)]
pub struct CellFaces {
    width: usize,
    numbers: FaceNumbers,
}

/// The numbers of the faces, row-major, lowest row first.
#[derive(Debug, Clone, PartialEq)]
enum FaceNumbers {
    Narrow(Vec<u16>),
    Wide(Vec<u32>),
}

impl CellFaces {
    /// Finds the face of every cell centre of a grid.
    #[must_use]
    pub fn of_grid(subdivision: &Subdivision, grid: &OccupancyGrid) -> Self {
        Self::rasterize(subdivision, grid.width(), grid.height(), grid.resolution())
    }

    /// Finds the face of every cell centre of a `width` x `height` grid; `resolution` in metres.
    #[must_use]
    pub fn rasterize(subdivision: &Subdivision, width: usize, height: usize, resolution: f64) -> Self {
        let centers = Centers { width, height, resolution };
        let numbers = if subdivision.face_count() <= usize::from(u16::MAX) + 1 {
            FaceNumbers::Narrow(filled(subdivision, centers, |sides| sides as u16))
        } else {
            FaceNumbers::Wide(filled(subdivision, centers, |sides| sides))
        };
        Self { width, numbers }
    }

    /// The faces as another grid sees them: each of its cells has the face around its centre, the unbounded one outside of
    /// the cells that are known. `motion` leads from the frame of that grid to the one that the faces are known in, whose cells
    /// have sides of `resolution` metres. O(cells of the other grid).
    #[must_use]
    pub fn seen_on(&self, resolution: f64, grid: &OccupancyGrid, motion: &RigidMotion) -> Self {
        let (width, height) = (grid.width(), self.len() / self.width.max(1));
        let known = |index: usize| {
            let center = motion.apply(grid.center(index % width, index / width));
            let [column, row] = [center.x, center.y].map(|along| (along / resolution).floor());
            let is_known = column >= 0.0 && row >= 0.0 && column < self.width as f64 && row < height as f64;
            is_known.then(|| row as usize * self.width + column as usize)
        };
        let cells = (0..grid.cells().len()).into_par_iter().map(known);
        let numbers = match &self.numbers {
            FaceNumbers::Narrow(faces) => {
                FaceNumbers::Narrow(cells.map(|cell| cell.map_or(0, |cell| faces[cell])).collect())
            }
            FaceNumbers::Wide(faces) => {
                FaceNumbers::Wide(cells.map(|cell| cell.map_or(0, |cell| faces[cell])).collect())
            }
        };
        Self { width, numbers }
    }

    /// Whether the four cells that are `reach` cells away along the axes lie in a face, too.
    pub(crate) fn holds_around(&self, face: FaceId, column: usize, row: usize, reach: usize) -> bool {
        let height = self.len() / self.width.max(1);
        column >= reach
            && row >= reach
            && column + reach < self.width
            && row + reach < height
            && self.at(column - reach, row) == face
            && self.at(column + reach, row) == face
            && self.at(column, row - reach) == face
            && self.at(column, row + reach) == face
    }

    /// The face of a cell; [`FaceId::OUTER`] outside the decomposed part of the map.
    #[must_use]
    pub fn at(&self, column: usize, row: usize) -> FaceId {
        self.of_cell(row * self.width + column)
    }

    /// The face of a cell by its index: row-major, lowest row first.
    #[must_use]
    #[inline]
    pub fn of_cell(&self, cell: usize) -> FaceId {
        match &self.numbers {
            FaceNumbers::Narrow(numbers) => FaceId(u32::from(numbers[cell])),
            FaceNumbers::Wide(numbers) => FaceId(numbers[cell]),
        }
    }

    /// The faces of all cells, row-major, lowest row first.
    #[must_use = "iterators are lazy"]
    pub fn iter(&self) -> impl ExactSizeIterator<Item = FaceId> {
        (0..self.len()).map(|cell| self.of_cell(cell))
    }

    /// The stretches of cells of one face among some cells, by index, as long as they can be.
    pub fn runs(&self, cells: Range<usize>) -> impl Iterator<Item = (FaceId, Range<usize>)> {
        let mut start = cells.start;
        std::iter::from_fn(move || {
            let first = start;
            (first < cells.end).then(|| {
                start += match &self.numbers {
                    FaceNumbers::Narrow(numbers) => run_length(&numbers[first..cells.end]),
                    FaceNumbers::Wide(numbers) => run_length(&numbers[first..cells.end]),
                };
                (self.of_cell(first), first..start)
            })
        })
    }

    /// How many cells there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match &self.numbers {
            FaceNumbers::Narrow(numbers) => numbers.len(),
            FaceNumbers::Wide(numbers) => numbers.len(),
        }
    }

    /// Whether there is no cell.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// How many of the values are as the first one before another comes.
fn run_length<T: PartialEq>(values: &[T]) -> usize {
    values.iter().position(|value| *value != values[0]).unwrap_or(values.len())
}

/// The number of the face of every cell centre. `narrowed` keeps the bits that numbers have.
fn filled<T: Copy + Default + Send + BitXorAssign>(
    subdivision: &Subdivision,
    centers: Centers,
    narrowed: impl Fn(u32) -> T + Sync,
) -> Vec<T> {
    let Centers { width, height, .. } = centers;
    let crossers: Vec<Crosser> =
        subdivision.edges().filter_map(|edge| Crosser::new(subdivision, edge, centers)).collect();
    let mut bands = vec![Vec::new(); height.div_ceil(BAND_ROWS)];
    for (crosser, number) in crossers.iter().zip(0_u32..) {
        for band in &mut bands[crosser.first_row / BAND_ROWS..=(crosser.end_row - 1) / BAND_ROWS] {
            band.push(number);
        }
    }
    let mut ids = vec![T::default(); width * height];
    ids.par_chunks_mut((BAND_ROWS * width).max(1)).zip(&bands).enumerate().for_each(|(band, (ids, numbers))| {
        let rows = band * BAND_ROWS..((band + 1) * BAND_ROWS).min(height);
        for &number in numbers {
            crossers[number as usize].mark(ids, rows.clone(), centers, &narrowed);
        }
        for row in ids.chunks_exact_mut(width.max(1)) {
            let mut face = T::default();
            for id in row {
                face ^= *id;
                *id = face;
            }
        }
    });
    ids
}

/// The centres of the cells of a grid.
#[derive(Debug, Clone, Copy)]
struct Centers {
    width: usize,
    height: usize,
    resolution: f64,
}

impl Centers {
    /// Index of the first centre at or beyond a coordinate, of `count`; `count` when there is none.
    fn first_from(self, coordinate: f64, count: usize) -> usize {
        // Saturates at both ends.
        ((coordinate / self.resolution - 0.5).ceil() as usize).min(count)
    }
}

/// An edge that crosses the level of at least one row of centres.
struct Crosser {
    low: Point,
    high: Point,
    /// Along x per y.
    slope: f64,
    first_row: usize,
    end_row: usize,
    /// Exclusive or of the faces on its two sides.
    sides: u32,
}

impl Crosser {
    fn new(subdivision: &Subdivision, edge: EdgeId, centers: Centers) -> Option<Self> {
        let [low, high] = subdivision.segment(edge);
        let [left, right] = subdivision.sides(edge);
        // Rows follow from the vertices alone, so that edges that meet in a vertex agree on its row.
        let first_row = centers.first_from(low.y, centers.height);
        let end_row = centers.first_from(high.y, centers.height);
        let slope = (high.x - low.x) / (high.y - low.y);
        (first_row < end_row).then_some(Self { low, high, slope, first_row, end_row, sides: left.0 ^ right.0 })
    }

    /// The x at which it crosses a level, computed from the nearer end: rounding then never swaps two edges that leave
    /// the same vertex. Edges that share no vertex are at least half a lattice step apart.
    fn x_at(&self, y: f64) -> f64 {
        let (rise, fall) = (y - self.low.y, self.high.y - y);
        let x = if rise <= fall { self.low.x + rise * self.slope } else { self.high.x - fall * self.slope };
        x.clamp(self.low.x.min(self.high.x), self.low.x.max(self.high.x))
    }

    /// Writes the change of face into the rows of a band.
    fn mark<T: BitXorAssign>(&self, ids: &mut [T], rows: Range<usize>, centers: Centers, narrowed: impl Fn(u32) -> T) {
        for row in self.first_row.max(rows.start)..self.end_row.min(rows.end) {
            let x = self.x_at((row as f64 + 0.5) * centers.resolution);
            let column = centers.first_from(x, centers.width);
            if column < centers.width {
                ids[(row - rows.start) * centers.width + column] ^= narrowed(self.sides);
            }
        }
    }
}
