//! The navigation graph of a semantic map: lanes along corridors, nodes where they meet, spurs to locations.
//!
//! | module | what comes out |
//! | --- | --- |
//! | [`mod@navigation_graph`] | nodes and directed lanes |
//! | [`build`] | the graph of a map |
//! | [`ruled`] | the same under the rules of people |
//! | [`side_by_side`] | two directed lanes where two vehicles have room to pass |
//! | [`mod@gates`] | where vehicles drive from one face to another |
//! | [`face_ways`] | the course of vehicles through one face |
//! | [`open_ground`] | ways over a face that is wide in every direction |
//! | [`thinning`], [`thin_lines`] | the lines with the most room |

mod build;
mod face_ways;
mod gates;
mod navigation_graph;
mod open_ground;
mod ruled;
mod side_by_side;
mod thin_lines;
mod thinning;

#[cfg(test)]
mod tests;

pub use build::navigation_graph;
pub use navigation_graph::{GraphNode, Lane, LaneKind, NavigationGraph, NodeKind};
pub use ruled::NODE_REACH_M;
