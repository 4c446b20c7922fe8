//! What jobs compute: a registry of processes, one file each.
//!
//! A job names its process and holds the inputs. The worker looks the process up, lets it compute on the threads of the
//! job's slot, and stores what it makes. A new kind of job is a new [`Process`] in the list of [`Processes::standard`].

mod analysis;
mod process;

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::ingest::Limits;

pub use analysis::{ANALYSIS, AnalysisInputs, AnalysisProcess};
pub use process::{ComputeError, Parameter, Process, ProcessDescription, Work};

/// The processes of a service, by id.
#[derive(Debug, Clone)]
pub struct Processes(BTreeMap<&'static str, Arc<dyn Process>>);

impl Processes {
    /// The processes of this program.
    #[must_use]
    pub fn standard(limits: Limits) -> Self {
        Self::new([Arc::new(AnalysisProcess { limits }) as Arc<dyn Process>])
    }

    /// A registry of these processes.
    #[must_use]
    pub fn new(processes: impl IntoIterator<Item = Arc<dyn Process>>) -> Self {
        Self(processes.into_iter().map(|process| (process.description().id, process)).collect())
    }

    /// The process with an id.
    ///
    /// # Errors
    /// A message that names the processes there are.
    pub fn find(&self, id: &str) -> Result<&Arc<dyn Process>, String> {
        let known = || self.0.keys().copied().collect::<Vec<_>>().join(", ");
        self.0.get(id).ok_or_else(|| format!("there is no process {id}: this release has {}", known()))
    }

    /// What the processes are, by id.
    pub fn descriptions(&self) -> impl Iterator<Item = &ProcessDescription> {
        self.0.values().map(|process| process.description())
    }
}
