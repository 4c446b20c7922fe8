//! A way through the map.

use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::Point;

/// A way through the map.
#[derive(Debug, Clone, PartialEq)]
pub struct Route {
    /// The path, grid frame, metres: at least two points.
    pub path: Vec<Point>,
    /// Length of the path, metres.
    pub length: f64,
    /// Faces crossed, in order.
    pub faces: Vec<FaceId>,
    /// Edges crossed between them, in order.
    pub edges: Vec<EdgeId>,
    /// Least distance between the path and an obstacle, metres, to within a cell.
    pub clearance: f64,
    /// Where the vehicle looks at the goal, radians, grid frame; at locations only.
    pub goal_heading: Option<f64>,
}

/// What a route should be like.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Preferences {
    /// What is best.
    pub profile: RouteProfile,
    /// Factors on the length of ways over faces of a label, by its index; at least 1, and 1 where there is none.
    pub label_costs: Vec<f64>,
}

/// What makes a route the best.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RouteProfile {
    /// The least length.
    #[default]
    Shortest,
    /// Distance from obstacles, where that costs no long way around.
    Clearance,
}
