//! What a change of labels and corrections would do, without doing it.

use std::sync::Arc;

use stillage_core::compare::FaceDifference;

use super::comparisons::face_differences;
use super::context::Decided;
use super::semantics::CheckedSemantics;
use super::{App, AppError, Caller, CorrectionId, MapContext, SemanticsChange};
use crate::blocking::off_the_runtime;
use crate::records::LostDecision;
use crate::store::{NewCorrections, now};

/// A map under other labels or corrections, which are not stored.
#[derive(Debug)]
pub struct LabelPreview {
    /// The map as it is.
    pub before: Arc<MapContext>,
    /// The map as it would be. Its locations have the codes of a fresh numbering.
    pub after: MapContext,
    /// The ids of the corrections that it would have, in their order; `None` for new ones.
    pub correction_ids: Vec<Option<CorrectionId>>,
    /// The faces that would come, change or go.
    pub faces: Vec<FaceDifference>,
    /// Labels of single faces that would be lost because their ground would be cut otherwise.
    pub lost: Vec<LostDecision>,
}

impl App {
    /// Tries a change of the labels and corrections of a map that was `seen`. Nothing is stored, and nothing is raised.
    pub async fn preview_semantics(
        &self,
        caller: &Caller,
        seen: Arc<MapContext>,
        change: SemanticsChange,
    ) -> Result<LabelPreview, AppError> {
        let CheckedSemantics { row, level, lost } = self.checked_semantics(caller, &seen, change, true).await?;
        off_the_runtime(move || {
            let (record, analysis) = (seen.record.clone(), (seen.analysis_id, seen.analysed_at));
            let correction_ids = match &row.corrections {
                NewCorrections::Stored(_) => seen.correction_ids.iter().copied().map(Some).collect(),
                NewCorrections::Changed(wanted) => wanted.iter().map(|(id, _)| *id).collect(),
            };
            let layout = row.layout.clone();
            let decided = Decided { semantics: Some(row.unsaved(now())), ..Decided::default() };
            let after = level.read_under(record, analysis, decided, layout)?;
            let faces = face_differences(&seen, &after);
            Ok(LabelPreview { before: seen, after, correction_ids, faces, lost })
        })
        .await
    }
}
