//! Shape features of the free space seen from a cell.
//!
//! Two profiles. [`Paper13`](FeatureProfile::Paper13), the default, is Table I of the paper (S. Gholami Shahbandi et
//! al., ECMR 2015, doi 10.1109/ECMR.2015.7324207; nine of the thirteen after O. Mozos) in metres, from the direction
//! sweep, in constant time per beam. [`Halmstad2017`](FeatureProfile::Halmstad2017) is the recipe of the author's own
//! published code, whose published categories it reproduces; it is there for that proof and costs many times as much.
//!
//! Only cells on the lattice of the stride are measured (column and row divisible by it). Where that lattice meets no
//! free cell at all, every free cell is measured, so that a map with free cells always has features.

mod halmstad;
mod paper;
mod paper_sums;
mod simd;

use rayon::prelude::*;

use crate::grid::{Occupancy, OccupancyGrid};
use crate::spec::{CategorizationOptions, FeatureProfile};
use crate::vectors::Vectors;
use crate::watch::{Stopped, Watch};
use halmstad::HalmstadFeatures;
use paper::PaperFeatures;

pub use paper::Workspace;

/// Features of measured free cells, one row per cell. The first feature is the mean beam length.
#[derive(Debug, Clone, PartialEq)]
pub struct CellFeatures {
    /// Index (row-major) of each measured cell, ascending.
    pub cells: Vec<u32>,
    /// Names of the features, in the order of a row.
    pub names: &'static [&'static str],
    /// `cells.len()` rows of `names.len()` values.
    pub values: Vec<f32>,
}

/// The features of a map, part by part: those of a big site at once would fill a gigabyte.
#[derive(Debug)]
pub struct FeatureSource<'a> {
    profile: Profile<'a>,
}

/// Share of the first sweep over the whole grid in the time of all features of `paper13` (0.19 of 0.9 million cells,
/// 0.17 of 20 million; two threads).
const PREPARATION: f64 = 0.18;

/// How the features are measured.
#[derive(Debug)]
enum Profile<'a> {
    Paper(PaperFeatures<'a>),
    Halmstad(HalmstadFeatures),
}

impl<'a> FeatureSource<'a> {
    /// How much of the work is done when a source is ready and no part is, 0 to 1, where a share of the parts will be
    /// measured.
    #[must_use]
    pub fn preparation_share(profile: FeatureProfile, parts: f64) -> f64 {
        match profile {
            FeatureProfile::Paper13 => PREPARATION / (PREPARATION + (1.0 - PREPARATION) * parts),
            FeatureProfile::Halmstad2017 => 0.0,
        }
    }

    /// Prepares the measurement of every free cell (of the stride).
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    ///
    /// # Panics
    /// When the grid has 2^32 cells or more.
    pub fn new(
        grid: &'a OccupancyGrid,
        options: &CategorizationOptions,
        vectors: Vectors,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        assert!(u32::try_from(grid.cells().len()).is_ok(), "cells are numbered by 32 bits");
        let stride = if has_measured_cells(grid, options.stride) { options.stride } else { 1 };
        let profile = match options.profile {
            FeatureProfile::Paper13 => Profile::Paper(PaperFeatures::new(grid, stride, options, vectors, watch)?),
            FeatureProfile::Halmstad2017 => Profile::Halmstad(HalmstadFeatures::new(grid, stride, options)),
        };
        Ok(Self { profile })
    }

    /// The names of the features, in their order. The first is the mean beam length.
    #[must_use]
    pub fn names(&self) -> &'static [&'static str] {
        names(match self.profile {
            Profile::Paper(_) => FeatureProfile::Paper13,
            Profile::Halmstad(_) => FeatureProfile::Halmstad2017,
        })
    }

    /// How many parts there are. Every measured cell is in one of them.
    #[must_use]
    pub fn parts(&self) -> usize {
        match &self.profile {
            Profile::Paper(features) => features.tiles(),
            Profile::Halmstad(features) => features.chunks(),
        }
    }

    /// Measures the cells of one part; the same whatever was measured before.
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    pub fn part(&self, index: usize, workspace: &mut Workspace, watch: &Watch<'_>) -> Result<CellFeatures, Stopped> {
        match &self.profile {
            Profile::Paper(features) => features.tile(index, workspace, watch),
            Profile::Halmstad(features) => features.chunk(index, watch),
        }
    }

    /// The features of all measured cells at once, by ascending cell.
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    pub fn all(&self, watch: &Watch<'_>) -> Result<CellFeatures, Stopped> {
        let parts: Result<Vec<CellFeatures>, Stopped> = (0..self.parts())
            .into_par_iter()
            .map_init(Workspace::default, |workspace, index| self.part(index, workspace, watch))
            .collect();
        let columns = self.names().len();
        let parts = parts?;
        let mut rows: Vec<(u32, &[f32])> =
            parts.iter().flat_map(|part| part.cells.iter().copied().zip(part.values.chunks_exact(columns))).collect();
        rows.sort_unstable_by_key(|&(cell, _)| cell);
        Ok(CellFeatures {
            cells: rows.iter().map(|&(cell, _)| cell).collect(),
            names: self.names(),
            values: rows.iter().flat_map(|&(_, values)| values).copied().collect(),
        })
    }
}

/// The names of the features of a profile, in their order.
#[must_use]
pub const fn names(profile: FeatureProfile) -> &'static [&'static str] {
    match profile {
        FeatureProfile::Paper13 => &paper::NAMES,
        FeatureProfile::Halmstad2017 => &halmstad::NAMES,
    }
}

/// Whether some free cell is on the lattice of a stride.
fn has_measured_cells(grid: &OccupancyGrid, stride: usize) -> bool {
    measured_rows(grid, stride).any(|(_, row)| row.iter().step_by(stride).any(|&cell| cell == Occupancy::Free))
}

/// The rows on the lattice of a stride, and where they begin.
fn measured_rows(grid: &OccupancyGrid, stride: usize) -> impl Iterator<Item = (usize, &[Occupancy])> {
    (0..grid.height()).step_by(stride).map(|row| (row * grid.width(), grid.row(row)))
}
