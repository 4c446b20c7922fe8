//! What a relaxation did.

use serde::{Deserialize, Serialize};

/// What a relaxation did.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct RelaxationReport {
    /// Cells or faces that have a distribution.
    pub nodes: usize,
    /// Number of them that changed their category, by iteration.
    pub changed_by_iteration: Vec<usize>,
    /// Number of them whose category at the end is not that at the start.
    pub changed: usize,
    /// Mean entropy of a distribution before, bits.
    pub entropy_before: f64,
    /// Mean entropy of a distribution after, bits.
    pub entropy_after: f64,
}
