//! The navigation graph of a semantic map: lanes along corridors, nodes where they meet, spurs to locations.
//!
//! | module | what comes out |
//! | --- | --- |
//! | [`navigation_graph`] | nodes and directed lanes |

mod navigation_graph;

pub use navigation_graph::{GraphNode, Lane, LaneKind, NavigationGraph, NodeKind};
