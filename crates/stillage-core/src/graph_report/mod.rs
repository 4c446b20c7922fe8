//! What there is to say of a navigation graph before vehicles drive on it: the design check of a fleet.
//!
//! | module | what comes out |
//! | --- | --- |
//! | [`report`] | the whole report |
//! | [`options`] | what is asked for |
//! | [`components`] | drivable faces, and nodes of the graph, that belong together |
//! | [`dead_ends`] | lanes that a vehicle leaves the way it came |
//! | [`mod@unreachable`] | locations that no lane leads to, and why |
//! | [`passages`] | stretches narrower than a width |
//! | [`disagreements`] | borders between drivable faces where labels and obstacles disagree |
//! | [`figures`], [`coverage`], [`structure`], [`paths`], [`validation`] | nineteen figures of a graph |
//! | [`lane_network`] | the lanes by node |
//!
//! Source: the figures are those of the evaluation of NVIDIA's SWAGGER (`docs/evaluation.md` and
//! `swagger/graph_evaluator.py`, Apache-2.0), by its keys; each says where its definition differs. What all have in common:
//! SWAGGER counts pixels, here lengths are metres; its edges are straight, lanes here may bend and are measured along their
//! course; its unknown cells are free above a grey level, here only free cells are; its random pairs differ at each call,
//! here they follow from a seed.
//!
//! Cost: O(cells) for the coverage, and again where something is cut off; the rest is small. Limits: vehicles are discs;
//! nodes that lanes join in one direction only count as joined.

mod components;
mod coverage;
mod dead_ends;
mod disagreements;
mod figures;
mod lane_network;
mod options;
mod passages;
mod paths;
mod report;
mod structure;
mod unreachable;
mod validation;

#[cfg(test)]
mod tests;

pub use components::{FaceComponent, GraphComponent};
pub use coverage::CoverageFigures;
pub use dead_ends::DeadEnd;
pub use disagreements::{LinkDisagreement, LinkDisagreementKind};
pub use figures::GraphFigures;
pub use options::ReportOptions;
pub use passages::NarrowPassage;
pub use paths::PathFigures;
pub use report::{GraphReport, graph_report};
pub use structure::StructureFigures;
pub use unreachable::{UnreachableLocation, UnreachableReason};
pub use validation::ValidationFigures;
