//! The navigation graph: where vehicles may drive, as nodes and directed lanes.

use serde::{Deserialize, Serialize};

use crate::arrangement::FaceId;
use crate::geometry::Point;
use crate::semantics::LabelId;

/// What a node of the graph is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NodeKind {
    /// Lanes meet there.
    Junction,
    /// A lane bends, or a spur leaves it.
    Waypoint,
    /// A lane ends there.
    DeadEnd,
    /// A vehicle stands there to serve a location.
    Approach,
}

/// A node of the graph.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GraphNode {
    /// Its name, unique in the graph and the same as long as it stays in its place: `N0012`, or the code of the location
    /// that is served there.
    pub name: String,
    /// Where it lies, grid frame, metres.
    pub position: Point,
    /// What it is for.
    pub kind: NodeKind,
    /// The face it lies in.
    pub face: FaceId,
    /// Index of the location that is served there; at approach nodes only.
    pub location: Option<usize>,
    /// Where a vehicle that stands there looks, radians, grid frame; at approach nodes only.
    pub heading: Option<f64>,
    /// Distance from it to the nearest obstacle, metres.
    pub clearance: f64,
}

/// What a lane is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LaneKind {
    /// Along a corridor, over a junction or through a room.
    Way,
    /// From a way to an approach node, or back.
    Spur,
}

/// A directed way between two nodes. A course that may be driven both ways is two lanes, each the other's `twin`; where two
/// vehicles have room to pass, the lanes of both directions lie side by side and have no twin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Lane {
    /// Index of the node it begins at.
    pub from: usize,
    /// Index of the node it ends at.
    pub to: usize,
    /// Its course, both ends included, grid frame, metres.
    pub path: Vec<Point>,
    /// What it is.
    pub kind: LaneKind,
    /// The label of the ground it begins on.
    pub label: LabelId,
    /// Width of the free ground along it at its narrowest, metres.
    pub width: f64,
    /// Index of the lane over the same course in the opposite direction.
    pub twin: Option<usize>,
}

impl Lane {
    /// Length of its course, metres.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.path.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
    }
}

/// Nodes and lanes: the one graph behind all exports.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct NavigationGraph {
    /// Nodes; lanes name them by index.
    pub nodes: Vec<GraphNode>,
    /// Lanes, ascending by `from` and `to`.
    pub lanes: Vec<Lane>,
    /// Indices of the rules of people that no node or lane fits.
    pub unmatched_rules: Vec<usize>,
}

impl NavigationGraph {
    /// Lanes in their order, each between two nodes once, with their twins; the nodes are added by who calls.
    pub(super) fn of_lanes(mut lanes: Vec<Lane>) -> Self {
        lanes.sort_by_key(|lane| (lane.from, lane.to));
        lanes.dedup_by_key(|lane| (lane.from, lane.to));
        let twin = |lane: &Lane| {
            let index = lanes.binary_search_by_key(&(lane.to, lane.from), |other| (other.from, other.to)).ok()?;
            lanes[index].path.iter().eq(lane.path.iter().rev()).then_some(index)
        };
        let twins: Vec<Option<usize>> = lanes.iter().map(twin).collect();
        for (lane, twin) in lanes.iter_mut().zip(twins) {
            lane.twin = twin;
        }
        Self { lanes, ..Self::default() }
    }
}
