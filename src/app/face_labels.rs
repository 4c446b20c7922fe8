//! The label of a single face, stronger than that of its category.

use std::collections::BTreeMap;
use std::sync::Arc;

use stillage_core::excerpt;

use super::context::read_rule_set;
use super::{App, AppError, Caller, MapContext, SemanticsChange};

impl App {
    /// Gives a face a label of its own, or takes it away (`None`): a new version of the labels, as long as the map has those
    /// that were `seen`. What changes nothing makes no version. Answers the map as it is now.
    pub async fn label_face(
        &self,
        caller: &Caller,
        seen: &Arc<MapContext>,
        face: u32,
        label: Option<String>,
    ) -> Result<Arc<MapContext>, AppError> {
        let rule_set = read_rule_set(&seen.semantics.draft)?;
        if let Some(label) = label.as_ref().filter(|label| rule_set.find(label).is_none()) {
            let known: Vec<&str> = rule_set.labels().iter().map(|label| label.id.as_str()).collect();
            let of = &seen.semantics.rule_set;
            let label = excerpt(label);
            let detail = format!("the rule set {of} has no label {label:?}: it has {}", known.join(", "));
            return Err(AppError::invalid("/label", detail));
        }
        if seen.semantics.assignment.overrides.get(&face) == label.as_ref() {
            return Ok(Arc::clone(seen));
        }
        let map = seen.record.id;
        let change = SemanticsChange { overrides: BTreeMap::from([(face, label)]), ..SemanticsChange::default() };
        self.change_semantics(caller, map, change, Some(seen.semantics.version)).await?;
        self.context(caller, map).await
    }
}
