//! Remarks and costs that several documents carry.

use serde::Serialize;
use stillage_core::analysis::Diagnostic;
use utoipa::ToSchema;

use crate::records::StageReport;

/// A remark on something that is valid but may surprise.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Diagnostic)]
pub struct DiagnosticView {
    /// Stable, for programs.
    #[schema(example = "no-orientation")]
    code: String,
    /// For people: what it is, and how to mend it.
    message: String,
}

impl From<&Diagnostic> for DiagnosticView {
    fn from(diagnostic: &Diagnostic) -> Self {
        Self { code: diagnostic.code.clone(), message: diagnostic.message.clone() }
    }
}

/// What a stage of an analysis cost.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = StageReport)]
#[serde(rename_all = "camelCase")]
pub struct StageView {
    /// Name of the stage.
    #[schema(example = "radiography")]
    name: String,
    /// Wall-clock seconds.
    wall_s: f64,
    /// CPU seconds of the process.
    cpu_s: f64,
}

impl From<&StageReport> for StageView {
    fn from(report: &StageReport) -> Self {
        Self { name: report.name.clone(), wall_s: report.wall_s, cpu_s: report.cpu_s }
    }
}
