//! The analysis of a map: its geometric level.

use serde::{Deserialize, Serialize};
use serde_json::json;
use stillage_core::analysis::ALGORITHM_VERSION;
use stillage_core::{AnalysisOptions, Watch};
use uuid::Uuid;

use super::{ComputeError, Parameter, Process, ProcessDescription, Work};
use crate::fail_point;
use crate::ingest::{self, Limits};
use crate::store::queue::JobResult;
use crate::store::{Blob, BlobId, NewAnalysis, NewJob, ResultAddress};

/// What the analysis is.
pub const ANALYSIS: ProcessDescription = ProcessDescription {
    id: "semantic-map",
    title: "Analysis of a map",
    description: "Reads the map, finds its place categories, orientations, rows, rooms and faces. The first result of \
                  a map comes into force at once, later ones when a person says so.",
    version: ALGORITHM_VERSION,
    inputs: &[Parameter { name: "options", title: "Options of every stage", schema: "AnalysisOptions" }],
    outputs: &[Parameter { name: "analysis", title: "Id of the analysis", schema: "string" }],
};

/// The inputs of an analysis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AnalysisInputs {
    /// The options, whole.
    pub options: AnalysisOptions,
}

/// Reads the map and analyses it.
#[derive(Debug, Clone, Copy)]
pub struct AnalysisProcess {
    /// Limits of the ingest.
    pub limits: Limits,
}

impl AnalysisProcess {
    /// A job that analyses a map with some options; `source` is the map's upload. The result comes into force at once where
    /// the job `activates` it, and is a proposal otherwise.
    #[must_use]
    pub fn job(map: Uuid, source: &BlobId, options: &AnalysisOptions, activates: bool) -> NewJob {
        let (process, inputs) = (ANALYSIS.id, json!({"options": options}));
        let address = ResultAddress::of(source, process, ANALYSIS.version, &inputs);
        NewJob { id: Uuid::now_v7(), map, process, inputs, address, activates }
    }
}

impl Process for AnalysisProcess {
    fn description(&self) -> &ProcessDescription {
        &ANALYSIS
    }

    fn compute(&self, work: &Work<'_>, watch: &Watch<'_>) -> Result<JobResult, ComputeError> {
        let AnalysisInputs { options } = AnalysisInputs::deserialize(work.inputs)
            .map_err(|error| ComputeError::Inputs(format!("the inputs of an analysis cannot be read: {error}")))?;
        let spec = options.check().map_err(|problems| {
            let all: Vec<String> = problems.iter().map(ToString::to_string).collect();
            ComputeError::Inputs(format!("the options are out of range: {}", all.join("; ")))
        })?;
        let map = ingest::decode(work.source, &spec.options().grid, &self.limits)?;
        fail_point::pass("during-compute");
        let analysis = stillage_core::analyze(&map.grid, &spec, watch)?;
        drop(map);
        let blob = Blob::encode(&analysis);
        let (options, diagnostics) = (analysis.options, analysis.diagnostics);
        let new = NewAnalysis { id: Uuid::now_v7(), options, diagnostics };
        Ok(JobResult::Analysis(Box::new(new), blob))
    }
}
