//! How well a map fits the truth of its site.

use stillage_core::Watch;
use stillage_core::evaluation::{self, Evaluation, EvaluationError, GroundTruth};
use uuid::Uuid;

use super::{App, AppError, Caller, SemanticsOrigin};
use crate::blocking::off_the_runtime;

impl App {
    /// Compares the analysis in force with the truth: under the suggested labels, under one decision per category, and
    /// under the labels in force where a person assigned them. Nothing is stored.
    pub async fn evaluate(&self, caller: &Caller, map: Uuid, truth: GroundTruth) -> Result<Evaluation, AppError> {
        let context = self.context(caller, map).await?;
        let _permit = self.decoders.acquire().await.map_err(|_| AppError::Unavailable)?;
        off_the_runtime(move || {
            let assigned = (context.semantics.origin != SemanticsOrigin::Suggested).then_some(&context.semantic);
            let rule_set = &context.semantic.rule_set;
            evaluation::evaluate(&context.analysis, rule_set, assigned, &truth, &Watch::unwatched())
                .map_err(AppError::from)
        })
        .await
    }
}

impl From<EvaluationError> for AppError {
    fn from(error: EvaluationError) -> Self {
        match error {
            EvaluationError::Stopped(_) => Self::Unavailable,
            EvaluationError::MissingLabel(missing) => Self::Conflict(missing.to_string()),
        }
    }
}
