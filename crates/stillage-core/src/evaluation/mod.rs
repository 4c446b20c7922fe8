//! How well an analysis agrees with the truth of its site: Table III of the paper, made precise.
//!
//! Source: the paper, section III-C and Table III, which counts the pallet cells that are detected correctly, with
//! "systematic" and other errors. Departure: the paper looks at the labels of places; users of places also need each
//! place to be *one face*, so that is counted as well.
//!
//! | figure | meaning |
//! | --- | --- |
//! | strict | one face labelled pallet cell has an intersection over union above one half with the place |
//! | lax | the centre of the place lies in such a face of less than twice its area |
//! | by area | more than half of the place is covered by such faces: the nearest to the paper's count |
//! | systematic | share of places that are missed laxly and were empty: no shape shows them |
//! | precision | share of the faces labelled pallet cell that strictly fit a true place, without slivers |
//! | slivers | faces below a quarter of the median place, counted apart |
//! | F1 | harmonic mean of strict recall and precision: the main figure |
//! | cogency | share of the length of edges whose cogency is that of the true labels |
//!
//! Lax and by area alone mean little: faces that are cut too small pass both. Only places count whose surroundings the
//! robot saw by half or more; the paper leaves unexplored margins out.
//!
//! Areas are those of the polygons, not of cells. [`evaluate`] gives all figures. [`Evaluator`] compares the geometry
//! once; [`Evaluator::score`] then scores any labels in milliseconds, and [`Evaluator::decision`] gives the decision
//! per category of a person who knows the truth. [`LayoutScores`] compare the storage layout: places, codes, approaches.
//!
//! Cost: O(true areas x faces they meet), seconds for a site of 6,000 places. Limits: true areas of one label must not
//! overlap.

mod boundary;
mod box_index;
mod evaluator;
mod layout_scores;
mod occupancy;
mod overlap;
mod scores;
mod truth;
mod truth_labels;

#[cfg(test)]
mod tests;

use crate::analysis::Analysis;
use crate::semantics::{self, Assignment, RuleSet, SemanticMap};
use crate::watch::{Stopped, Watch};
use truth_labels::TruthLabels;

pub use evaluator::Evaluator;
pub use layout_scores::{AisleOrder, LayoutScores};
pub use occupancy::OccupancyScores;
pub use scores::{GeometryScores, LabelOverlap, LabelScores, PlaceScores};
pub use truth::{GroundTruth, TrueArea, TruePlace, TrueRegion};
pub use truth_labels::MissingLabel;

/// How well an analysis fits the truth of its site, under labels of several origins.
#[derive(Debug, Clone, PartialEq)]
pub struct Evaluation {
    /// The decomposition, whatever the labels.
    pub geometry: GeometryScores,
    /// Under the suggested labels, without a human decision.
    pub automatic: LabelScores,
    /// Under the best decision per category: the most a person can reach.
    pub decided: LabelScores,
    /// That decision.
    pub decision: Assignment,
    /// Under labels that a person assigned, where there are any.
    pub assigned: Option<LabelScores>,
}

/// Why an analysis cannot be compared with a truth.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum EvaluationError {
    /// The watch stopped it.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The rule set lacks a label that the truth uses.
    #[error(transparent)]
    MissingLabel(#[from] MissingLabel),
}

/// Compares an analysis with the truth of its site: under the suggested labels, under one human decision per category,
/// and under assigned labels where there are any.
///
/// # Errors
/// [`EvaluationError`] when the watch stops it, or when the rule set lacks a label.
///
/// # Panics
/// Never: suggestions and decision name the analysis' own categories and labels of the rule set.
pub fn evaluate(
    analysis: &Analysis,
    rule_set: &RuleSet,
    assigned: Option<&SemanticMap>,
    truth: &GroundTruth,
    watch: &Watch<'_>,
) -> Result<Evaluation, EvaluationError> {
    let evaluator = Evaluator::new(analysis, truth, watch)?;
    let score = |assignment: &Assignment| {
        let semantic = semantics::apply(analysis, rule_set, assignment)
            .expect("an assignment of the analysis' own categories to labels of the rule set applies");
        evaluator.score(&semantic)
    };
    let decision = evaluator.decision(rule_set)?;
    Ok(Evaluation {
        geometry: *evaluator.geometry(),
        automatic: score(&Assignment::suggested(&semantics::suggest(analysis, rule_set), rule_set))?,
        decided: score(&decision)?,
        decision,
        assigned: assigned.map(|semantic| evaluator.score(semantic)).transpose()?,
    })
}

/// Checks that a rule set has all labels that a truth uses.
///
/// # Errors
/// [`MissingLabel`] names what it lacks.
pub fn check_rule_set(rule_set: &RuleSet) -> Result<(), MissingLabel> {
    TruthLabels::of(rule_set).map(|_| ())
}
