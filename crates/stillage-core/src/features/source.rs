//! The features of a map, part by part, by either profile.

use rayon::prelude::*;

use super::cell_features::CellFeatures;
use super::halmstad::{self, HalmstadFeatures};
use super::lattice::has_measured_cells;
use super::paper::{self, PaperFeatures, Workspace};
use crate::grid::OccupancyGrid;
use crate::spec::{CategorizationOptions, FeatureProfile};
use crate::vectors::Vectors;
use crate::watch::{Stopped, Watch};

/// Measures the features of a map part by part; those of a large site together would fill a gigabyte.
#[derive(Debug)]
pub struct FeatureSource<'a> {
    profile: Profile<'a>,
}

/// Share of the first sweep over the whole grid in the time of all features of `paper13`: measured 0.19 at 0.9 million
/// cells and 0.17 at 20 million, on two threads.
const PREPARATION: f64 = 0.18;

/// How the features are measured.
#[derive(Debug)]
enum Profile<'a> {
    Paper(PaperFeatures<'a>),
    Halmstad(HalmstadFeatures),
}

impl<'a> FeatureSource<'a> {
    /// Share of the work, 0 to 1, that is done when the source is ready and no part is measured, if a share `parts` of
    /// the parts will be.
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

    /// Number of parts. Every measured cell is in one of them.
    #[must_use]
    pub fn parts(&self) -> usize {
        match &self.profile {
            Profile::Paper(features) => features.tiles(),
            Profile::Halmstad(features) => features.chunks(),
        }
    }

    /// Measures the cells of one part; the result does not depend on what was measured before.
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
