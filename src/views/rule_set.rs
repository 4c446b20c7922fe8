//! Rule sets.

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use stillage_core::semantics::{Cogency, CogencyRule, Functionality, Label, RuleSetDraft};
use utoipa::ToSchema;

use super::link::Link;
use crate::records::RuleSetRecord;

/// A label that a person may give to places.
#[derive(Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = Label)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct LabelView {
    /// Short id, unique in its rule set.
    #[schema(example = "co")]
    id: String,
    /// Name for people.
    #[schema(example = "corridor")]
    name: String,
    /// `#rrggbb`
    #[schema(pattern = "^#[0-9a-fA-F]{6}$", example = "#4e9a06")]
    color: String,
    /// What such a place is for.
    #[serde(default)]
    #[schema(value_type = Vec<FunctionalityView>)]
    functionality: Vec<Functionality>,
    /// Ids of the labels it may connect to.
    #[serde(default)]
    connects_to: Vec<String>,
}

/// What a place is for.
#[derive(Debug, ToSchema)]
#[schema(as = Functionality, rename_all = "kebab-case")]
#[allow(dead_code, reason = "it describes the words that the core reads")]
pub enum FunctionalityView {
    /// Robots may drive here.
    Drivable,
    /// Storage is reached from here.
    StorageAccess,
    /// Joins corridors.
    Connection,
    /// Rooms are reached from here.
    Access,
    /// Goods stand here.
    Storage,
    /// People work here.
    WorkPlace,
}

/// An edge between these labels, in either order, has this cogency.
#[derive(Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = CogencyRule)]
#[serde(deny_unknown_fields)]
pub struct CogencyRuleView {
    /// The two label ids; `*` for any.
    #[schema(value_type = Vec<String>, min_items = 2, max_items = 2, example = json!(["co", "pc"]))]
    when: [String; 2],
    /// What such an edge is.
    #[schema(value_type = CogencyView)]
    then: Cogency,
}

/// What an edge means to its two faces: an obstruction, storage access, or nothing.
#[derive(Debug, ToSchema)]
#[schema(as = Cogency, rename_all = "kebab-case")]
#[allow(dead_code, reason = "it describes the words that the core reads")]
pub enum CogencyView {
    /// An obstruction.
    Cogent,
    /// Where storage is reached.
    StorageAccess,
    /// Open.
    Invalid,
}

/// A rule set.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = RuleSet)]
#[serde(rename_all = "camelCase")]
pub struct RuleSetView {
    #[schema(example = "site")]
    id: String,
    /// Whether it is built in and cannot be changed.
    built_in: bool,
    /// Raised with every change.
    version: u64,
    labels: Vec<LabelView>,
    /// Explicit rules, first match wins; derived from the labels where absent or without a match.
    #[serde(skip_serializing_if = "Option::is_none")]
    cogency: Option<Vec<CogencyRuleView>>,
    links: Vec<Link>,
}

impl RuleSetView {
    /// A stored rule set.
    #[must_use]
    pub fn new(record: RuleSetRecord, links: Vec<Link>) -> Self {
        let label = |label: Label| LabelView {
            id: label.id,
            name: label.name,
            color: label.color,
            functionality: label.functionality,
            connects_to: label.connects_to,
        };
        let rule = |rule: CogencyRule| CogencyRuleView { when: rule.when, then: rule.then };
        Self {
            id: record.id,
            built_in: record.built_in,
            version: record.version,
            labels: record.draft.labels.into_iter().map(label).collect(),
            cogency: record.draft.cogency.map(|rules| rules.into_iter().map(rule).collect()),
            links,
        }
    }
}

/// A rule set as it is sent. What a read adds (`builtIn`, `version`, `links`) may be sent back and is ignored.
#[derive(Debug, Deserialize, ToSchema)]
#[schema(as = RuleSetDraft)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct RuleSetBody {
    /// The id: needed by POST, and by PUT only that of the address.
    #[schema(pattern = "^[a-z0-9][a-z0-9-]{0,63}$", example = "cold-store")]
    pub id: Option<String>,
    #[schema(min_items = 1)]
    labels: Vec<LabelView>,
    /// Explicit rules, first match wins; derived from the labels where absent or without a match.
    cogency: Option<Vec<CogencyRuleView>>,
    #[serde(default, rename = "builtIn")]
    #[schema(read_only, value_type = serde_json::Value)]
    _built_in: IgnoredAny,
    #[serde(default, rename = "version")]
    #[schema(read_only, value_type = serde_json::Value)]
    _version: IgnoredAny,
    #[serde(default, rename = "links")]
    #[schema(read_only, value_type = serde_json::Value)]
    _links: IgnoredAny,
}

impl RuleSetBody {
    /// The labels and rules, not checked yet.
    #[must_use]
    pub fn into_draft(self) -> RuleSetDraft {
        let label = |label: LabelView| Label {
            id: label.id,
            name: label.name,
            color: label.color,
            functionality: label.functionality,
            connects_to: label.connects_to,
        };
        let rule = |rule: CogencyRuleView| CogencyRule { when: rule.when, then: rule.then };
        RuleSetDraft {
            labels: self.labels.into_iter().map(label).collect(),
            cogency: self.cogency.map(|rules| rules.into_iter().map(rule).collect()),
        }
    }
}

/// The rule sets.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct RuleSetList {
    /// The built-in ones first.
    pub rule_sets: Vec<RuleSetView>,
    /// Itself.
    pub links: Vec<Link>,
}
