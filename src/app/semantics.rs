//! The human decision on a map.
//!
//! Until somebody decides, the suggestion is in force, as version 0. A decision is a new immutable version; it keeps the
//! rule set as it was. It belongs to the analysis whose categories it names: when another analysis comes into force, its
//! own newest decision is (or its suggestion, version 0 again). Versions of decisions count on over all analyses of a
//! map.

use std::sync::Arc;

use stillage_core::semantics;
use uuid::Uuid;

use super::context::read_rule_set;
use super::{App, AppError, Caller, MapContext, NewSemantics, SemanticsRecord};
use crate::blocking::off_the_runtime;
use crate::store::{NewSemanticsRow, now};

impl App {
    /// The semantics in force: the newest assigned version, or the suggestion (version 0).
    pub async fn semantics(&self, caller: &Caller, map: Uuid) -> Result<SemanticsRecord, AppError> {
        Ok(self.context(caller, map).await?.semantics.clone())
    }

    /// Makes a new version; needs `if_match`, the version in force.
    pub async fn put_semantics(
        &self,
        caller: &Caller,
        map: Uuid,
        new: NewSemantics,
        if_match: Option<u64>,
    ) -> Result<SemanticsRecord, AppError> {
        let context = self.context(caller, map).await?;
        let replaces = if_match.ok_or(AppError::PreconditionRequired)?;
        if replaces != context.semantics.version {
            return Err(AppError::PreconditionFailed { current: context.semantics.version });
        }
        let row = self.checked_semantics(caller, &context, new).await?;
        match self.store.insert_semantics(caller.tenant(), &row, now()).await? {
            None => Err(AppError::not_found("map", map)),
            Some(Err(current)) => Err(AppError::PreconditionFailed { current }),
            Some(Ok(record)) => Ok(record),
        }
    }

    /// All assigned versions, newest first.
    pub async fn semantics_versions(&self, caller: &Caller, map: Uuid) -> Result<Vec<SemanticsRecord>, AppError> {
        self.map(caller, map).await?;
        Ok(self.store.semantics_versions(caller.tenant(), map).await?)
    }

    /// A decision that can be applied to the analysis in force.
    async fn checked_semantics(
        &self,
        caller: &Caller,
        context: &Arc<MapContext>,
        new: NewSemantics,
    ) -> Result<NewSemanticsRow, AppError> {
        let (rule_set, draft) = match new.rule_set {
            None => (context.semantics.rule_set.clone(), context.semantics.draft.clone()),
            Some(id) => match self.rule_set(caller, &id).await {
                Ok(record) => (record.id, record.draft),
                Err(AppError::NotFound { .. }) => {
                    return Err(AppError::invalid("/ruleSet", format!("there is no rule set {id}")));
                }
                Err(error) => return Err(error),
            },
        };
        let checked = read_rule_set(&draft)?;
        let (analysis, assignment) = (Arc::clone(&context.analysis), new.assignment);
        let assignment = off_the_runtime(move || {
            semantics::apply(&analysis, &checked, &assignment).map(|_| assignment).map_err(AppError::from)
        })
        .await?;
        let (map, analysis, replaces) = (context.record.id, context.analysis_id, context.semantics.version);
        Ok(NewSemanticsRow { map, analysis, replaces, rule_set, draft, assignment })
    }
}
