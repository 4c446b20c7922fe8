//! What a change of the labels would do, without doing it.

use std::sync::Arc;

use stillage_core::compare::{self, LabelChange};

use super::comparisons::face_labels;
use super::context::GeometricLevel;
use super::{App, AppError, Caller, MapContext, SemanticsChange};
use crate::blocking::off_the_runtime;
use crate::store::now;

/// A map under other labels, which are not stored.
#[derive(Debug)]
pub struct LabelPreview {
    /// The map as it is.
    pub before: Arc<MapContext>,
    /// The map as it would be. Its locations have the codes of a fresh numbering.
    pub after: MapContext,
    /// The faces whose label would change, by id.
    pub faces: Vec<LabelChange>,
}

impl App {
    /// Tries a change of the labels of a map that was `seen`. Nothing is stored, and nothing is raised.
    pub async fn preview_semantics(
        &self,
        caller: &Caller,
        seen: Arc<MapContext>,
        change: SemanticsChange,
    ) -> Result<LabelPreview, AppError> {
        let row = self.checked_semantics(caller, &seen, change).await?;
        off_the_runtime(move || {
            let (record, analysis) = (seen.record.clone(), (seen.analysis_id, seen.analysed));
            let layout = row.layout.clone();
            let after = GeometricLevel::of(&seen).read_under(record, analysis, Some(row.unsaved(now())), layout)?;
            let faces = compare::compare_labels(face_labels(&seen), face_labels(&after));
            Ok(LabelPreview { before: seen, after, faces })
        })
        .await
    }
}
