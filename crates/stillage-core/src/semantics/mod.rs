//! The human level: labels, rule sets, cogency, connectivity and places.
//!
//! | item | what it does |
//! | --- | --- |
//! | [`RuleSet`] | the labels there are, and what an edge between two of them means |
//! | [`Assignment`] | the label of each category of an analysis |
//! | [`suggest`] | proposes a label for each category |
//! | [`apply()`] | an analysis, a rule set and an assignment give a [`SemanticMap`] |
//! | [`carry()`] | labels that people gave to one analysis, on another analysis of the same map |

mod apply;
mod assignment;
mod carry;
mod cogency;
mod draft;
mod evidence;
mod label;
#[cfg(test)]
pub(crate) mod pictures;
mod rule_set;
mod semantic_map;
mod suggestion;
mod traits;
mod view;

pub use apply::apply;
pub use assignment::{Assignment, AssignmentProblem};
pub use carry::{AnalysisGround, CarriedLabels, LabelSubject, LostLabel, carry};
pub use cogency::{Cogency, CogencyRule, Connectivity};
pub use draft::{RuleSetDraft, RuleSetProblem};
pub use evidence::CategoryEvidence;
pub use label::{Functionality, Label, LabelId};
pub use rule_set::RuleSet;
pub use semantic_map::{Place, SemanticMap};
pub use suggestion::{Suggestion, suggest};
