//! Analyses of a map.

use jiff::Timestamp;
use serde::Serialize;
use stillage_core::AnalysisOptions;
use utoipa::ToSchema;
use uuid::Uuid;

use super::carried::CarriedView;
use super::id::Id;
use super::link::Link;
use super::options::AnalysisOptionsView;
use super::remarks::{DiagnosticView, StageView};
use crate::records::{AnalysisRecord, CarryRecord, SemanticsRecord};

/// A finished analysis.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Analysis)]
#[serde(rename_all = "camelCase")]
pub struct AnalysisView {
    id: Id,
    map_id: Id,
    /// Whether it is the one that answers; the others are proposals.
    in_force: bool,
    #[schema(value_type = String, format = DateTime)]
    created: Timestamp,
    /// The options, with every default filled in.
    #[schema(value_type = AnalysisOptionsView)]
    options: AnalysisOptions,
    /// What became of the labels of the analysis that answered before, when they were last carried over to this one.
    #[serde(skip_serializing_if = "Option::is_none")]
    carried: Option<CarriedView>,
    /// What would become of the labels that people gave if the analysis was activated now. Told of a proposal that is asked
    /// for by itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    would_carry: Option<CarriedView>,
    /// What each stage cost.
    stages: Vec<StageView>,
    /// Remarks on the result.
    diagnostics: Vec<DiagnosticView>,
    /// Itself, its faces, what would change, and where a `POST` activates it.
    links: Vec<Link>,
}

impl AnalysisView {
    /// An analysis of a map whose analysis in force has the id `in_force`, and whose labels have these versions, newest
    /// first.
    #[must_use]
    pub fn new(record: AnalysisRecord, in_force: Option<Uuid>, versions: &[SemanticsRecord], links: Vec<Link>) -> Self {
        let mut on_it = versions.iter().filter(|version| version.analysis == record.id);
        Self {
            carried: on_it.find_map(|version| version.carried.clone()).map(CarriedView::from),
            would_carry: None,
            links,
            in_force: in_force == Some(record.id),
            id: Id(record.id),
            map_id: Id(record.map),
            created: record.created,
            stages: record.stages.iter().map(Into::into).collect(),
            diagnostics: record.diagnostics.iter().map(Into::into).collect(),
            options: record.options,
        }
    }

    /// Tells what would become of the labels that people gave.
    #[must_use]
    pub fn with_prospect(self, would_carry: Option<CarryRecord>) -> Self {
        Self { would_carry: would_carry.map(CarriedView::from), ..self }
    }
}

/// The analyses of a map.
#[derive(Debug, Serialize, ToSchema)]
pub struct AnalysisList {
    /// Newest first.
    pub analyses: Vec<AnalysisView>,
    /// Itself.
    pub links: Vec<Link>,
}
