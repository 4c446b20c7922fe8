//! The labels of a map.

use std::collections::BTreeMap;

use jiff::Timestamp;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use stillage_core::geometry::RigidMotion;
use utoipa::ToSchema;

use super::carried::CarriedView;
use super::layout::LayoutView;
use super::link::Link;
use crate::records::{SemanticsOrigin, SemanticsRecord};

/// The labels of a map.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Semantics)]
#[serde(rename_all = "camelCase")]
pub struct SemanticsView {
    #[schema(example = "site")]
    rule_set: String,
    /// Label by category.
    #[schema(value_type = BTreeMap<String, String>, example = json!({"0": "co", "1": "pc"}))]
    assignment: BTreeMap<u8, String>,
    overrides: Vec<OverrideView>,
    layout: LayoutView,
    /// 0 is the suggestion; assigned versions count from 1.
    version: u64,
    origin: OriginView,
    #[serde(skip_serializing_if = "Option::is_none")]
    carried: Option<CarriedView>,
    /// How many corrections it has: `…/corrections` lists those in force.
    correction_count: u32,
    /// The version that it equals, where a person went back or forth to it; 0 is the suggestion.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(required = false, nullable = false)]
    restores: Option<u64>,
    #[schema(value_type = String, format = DateTime)]
    created: Timestamp,
}

/// The label of a single face, stronger than that of its category.
#[derive(Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = LabelOverride)]
#[serde(deny_unknown_fields)]
pub struct OverrideView {
    /// Id of the face.
    pub face: u32,
    /// Id of the label.
    #[schema(example = "ju")]
    pub label: String,
}

/// Who decided: nobody (the suggestion is in force), or a person, maybe on another analysis of the map or an
/// earlier map of its site.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = SemanticsOrigin)]
#[serde(rename_all = "lowercase")]
pub enum OriginView {
    /// Nobody, or a person who went back to the suggestion.
    Suggested,
    /// A person.
    Assigned,
    /// A person, on another analysis of the map or on an earlier map of the site.
    Carried,
}

impl SemanticsView {
    /// The labels of a map that `to_site` carries to the frame of its site.
    #[must_use]
    pub fn new(record: SemanticsRecord, to_site: &RigidMotion) -> Self {
        let overrides = record.assignment.overrides.into_iter().map(|(face, label)| OverrideView { face, label });
        Self {
            rule_set: record.rule_set,
            assignment: record.assignment.assignment,
            overrides: overrides.collect(),
            layout: LayoutView::new(&record.layout, to_site),
            version: record.version,
            origin: match record.origin {
                SemanticsOrigin::Suggested => OriginView::Suggested,
                SemanticsOrigin::Assigned => OriginView::Assigned,
                SemanticsOrigin::Carried => OriginView::Carried,
            },
            carried: record.carried.map(CarriedView::from),
            correction_count: record.corrections.map_or(0, |list| list.count),
            restores: record.restores,
            created: record.created,
        }
    }
}

/// New labels of a map. What a read adds (`version`, `origin`, `carried`, `correctionCount`,
/// `restores`, `created`) may be sent back and is ignored.
#[derive(Debug, Deserialize, ToSchema)]
#[schema(as = NewSemantics)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct SemanticsBody {
    /// The rule set; the one in force when absent.
    #[schema(example = "site")]
    pub rule_set: Option<String>,
    /// Label by category. Categories that are not named keep the label in force. Under another rule set, those that nobody
    /// decided on, or whose label it has not, get its suggestion.
    #[serde(default)]
    #[schema(example = json!({"0": "co", "1": "pc"}))]
    pub assignment: BTreeMap<String, String>,
    /// Labels of single faces, all of them; as in force when absent.
    #[schema(required = false)]
    pub overrides: Option<Vec<OverrideView>>,
    /// How locations are cut and numbered; as in force when absent. Another template, entrance or width of places is a wish
    /// for new codes: only those that people gave stay.
    #[schema(required = false)]
    pub layout: Option<LayoutView>,
    #[serde(default, rename = "version")]
    #[schema(read_only, value_type = serde_json::Value)]
    _version: IgnoredAny,
    #[serde(default, rename = "origin")]
    #[schema(read_only, value_type = serde_json::Value)]
    _origin: IgnoredAny,
    #[serde(default, rename = "carried")]
    #[schema(read_only, value_type = serde_json::Value)]
    _carried: IgnoredAny,
    #[serde(default, rename = "correctionCount")]
    #[schema(read_only, value_type = serde_json::Value)]
    _correction_count: IgnoredAny,
    #[serde(default, rename = "restores")]
    #[schema(read_only, value_type = serde_json::Value)]
    _restores: IgnoredAny,
    #[serde(default, rename = "created")]
    #[schema(read_only, value_type = serde_json::Value)]
    _created: IgnoredAny,
}

/// The versions of the labels of a map.
#[derive(Debug, Serialize, ToSchema)]
pub struct SemanticsHistory {
    /// Newest first.
    pub versions: Vec<SemanticsView>,
    /// Itself, and the labels in force.
    pub links: Vec<Link>,
}
