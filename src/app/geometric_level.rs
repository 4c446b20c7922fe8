//! The part of a context that follows from the cells alone, and the corrections that people made to it.
//!
//! The arrangement that everything is read off is the corrected one. The analysis as it was made stays beside it, because
//! another list of corrections begins there; without corrections the two are one. The faces of its cells do not stay: they
//! are read anew when the corrections change.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use stillage_core::arrangement::{CellFaces, FaceId};
use stillage_core::clearance::Clearance;
use stillage_core::corrections::{self, Corrected, CorrectedBefore, Correction, Outcome, Said};
use stillage_core::semantics::{AnalysisGround, Assignment};
use stillage_core::{Analysis, OccupancyGrid, SiteCells};
use uuid::Uuid;

use super::{AnalysisRecord, AppError};
use crate::ingest::{self, Limits, MapSource};
use crate::store::Blob;

/// The cells of a map, its analysis, and the analysis as people corrected it.
#[derive(Debug, Clone)]
pub(super) struct GeometricLevel {
    pub(super) grid: Arc<OccupancyGrid>,
    /// The analysis as it was made.
    pub(super) analysed: Arc<Analysis>,
    /// The corrected analysis.
    pub(super) analysis: Arc<Analysis>,
    /// What is read off its cells.
    pub(super) cells: Arc<SiteCells>,
    pub(super) corrections: Arc<AppliedCorrections>,
}

/// Corrections, and what they say of the corrected faces.
#[derive(Debug, Default)]
pub struct AppliedCorrections {
    /// The corrections, in metres of the map frame.
    pub list: Vec<Correction>,
    /// What became of each.
    pub outcomes: Vec<Outcome>,
    /// Ids of the labels that they give to faces.
    pub labels: BTreeMap<FaceId, String>,
    /// Names that they give to faces.
    pub names: BTreeMap<FaceId, String>,
    /// For more of them.
    said: Said,
}

impl AppliedCorrections {
    /// The names of faces, by number.
    #[must_use]
    pub(super) fn named_faces(&self) -> BTreeMap<u32, String> {
        self.names.iter().map(|(face, name)| (face.0, name.clone())).collect()
    }

    /// A decision with the labels that the corrections give to faces to which the decision gives none.
    #[must_use]
    pub fn labelled<'a>(&self, decision: &'a Assignment) -> Cow<'a, Assignment> {
        if self.labels.is_empty() {
            return Cow::Borrowed(decision);
        }
        let mut labelled = decision.clone();
        for (face, label) in &self.labels {
            labelled.overrides.entry(face.0).or_insert_with(|| label.clone());
        }
        Cow::Owned(labelled)
    }
}

impl GeometricLevel {
    /// An analysis without corrections.
    pub(super) fn new(grid: Arc<OccupancyGrid>, analysis: Analysis, cells: SiteCells) -> Self {
        let analysis = Arc::new(analysis);
        let corrections = Arc::default();
        Self { grid, analysed: Arc::clone(&analysis), analysis, cells: Arc::new(cells), corrections }
    }

    /// Reads a map and its analysis.
    pub(super) fn read(source: &Blob, blob: &Blob, record: &AnalysisRecord, limits: &Limits) -> Result<Self, AppError> {
        let grid = ingest::decode(&source.decode::<MapSource>()?, &record.options.grid, limits)?.grid;
        let analysis: Analysis = blob.decode()?;
        let cells = SiteCells::of(&grid, &analysis);
        Ok(Self::new(Arc::new(grid), analysis, cells))
    }

    /// Another analysis of the same cells, without corrections.
    pub(super) fn with_analysis(&self, analysis: Analysis) -> Self {
        let cells = cells_of(&self.grid, &analysis, &self.cells.clearance);
        Self::new(Arc::clone(&self.grid), analysis, cells)
    }

    /// The analysis as it was made, under these corrections instead of those that it has. O(cells).
    pub(super) fn corrected(self, list: Vec<Correction>) -> Self {
        if self.corrections.list == list {
            return self;
        }
        let Self { grid, analysed, analysis: before, cells, corrections } = self;
        let clearance = Arc::clone(&cells.clearance);
        let cells_analysed = if corrections.list.is_empty() {
            cells
        } else {
            drop(cells);
            Arc::new(cells_of(&grid, &analysed, &clearance))
        };
        if list.is_empty() {
            return Self {
                grid,
                analysis: Arc::clone(&analysed),
                analysed,
                cells: cells_analysed,
                corrections: Arc::default(),
            };
        }
        let faces_analysed = &cells_analysed.faces;
        let corrected = match list.strip_prefix(corrections.list.as_slice()) {
            Some(more) if !corrections.list.is_empty() => {
                let AppliedCorrections { outcomes, said, .. } = &*corrections;
                let before = CorrectedBefore { analysis: &before, outcomes, said };
                corrections::apply_after(before, &grid, &analysed, faces_analysed, more)
            }
            _ => corrections::apply(&grid, &analysed, faces_analysed, &list),
        };
        let Corrected { analysis, faces, labels, names, outcomes, said } = corrected;
        let cells = if analysis.subdivision == analysed.subdivision {
            cells_analysed
        } else {
            Arc::new(SiteCells { faces, clearance })
        };
        Self {
            grid,
            analysed,
            analysis: Arc::new(analysis),
            cells,
            corrections: Arc::new(AppliedCorrections { list, outcomes, labels, names, said }),
        }
    }

    /// The corrected faces with their cells.
    pub(super) fn ground(&self) -> AnalysisGround<'_> {
        AnalysisGround { analysis: &self.analysis, cells: &self.cells.faces }
    }
}

/// The cells of an analysis of a grid whose clearance is known.
fn cells_of(grid: &OccupancyGrid, analysis: &Analysis, clearance: &Arc<Clearance>) -> SiteCells {
    SiteCells { faces: CellFaces::of_grid(&analysis.subdivision, grid), clearance: Arc::clone(clearance) }
}

/// The level that was corrected last and is about to be put in force, so that it is not corrected again for the next
/// question.
#[derive(Debug, Default)]
pub(super) struct LastCorrected(Mutex<Option<(Uuid, GeometricLevel)>>);

impl LastCorrected {
    /// Keeps the level of an analysis in the place of the one before.
    pub(super) fn keep(&self, analysis: Uuid, level: GeometricLevel) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some((analysis, level));
    }

    /// The level of an analysis under these corrections, which is no longer kept then.
    pub(super) fn take(&self, analysis: Uuid, list: &[Correction]) -> Option<GeometricLevel> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.take_if(|(of, level)| *of == analysis && level.corrections.list == list).map(|(_, level)| level)
    }
}
