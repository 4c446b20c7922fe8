//! Why there is no route, where, and what would do.

use crate::arrangement::FaceId;
use crate::geometry::Point;

/// Which end of a route a problem is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RouteEnd {
    /// `from`.
    Start,
    /// `to`.
    Goal,
}

impl std::fmt::Display for RouteEnd {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Start => "start",
            Self::Goal => "goal",
        })
    }
}

/// What is wrong with the ground at an end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EndGround {
    /// It is outside the map.
    Outside,
    /// An obstacle stands there.
    Occupied,
    /// Nobody knows what is there.
    Unknown,
    /// The vehicle does not fit: the clearance there, metres.
    Narrow(f64),
}

/// Why there is no route. Points lie in the grid frame.
#[derive(Debug, Clone, PartialEq)]
pub enum NoRoute {
    /// The vehicle cannot stand at an end.
    CannotStand {
        /// Which end.
        end: RouteEnd,
        /// What is there.
        ground: EndGround,
        /// The nearest point that would do, if any is near.
        nearest: Option<Point>,
    },
    /// The face there is not drivable, and no way leads out of it.
    NotDrivable {
        /// Which end.
        end: RouteEnd,
        /// The face there.
        face: FaceId,
        /// The name of its label.
        label: String,
        /// The nearest point that would do, if any is near.
        nearest: Option<Point>,
    },
    /// A vehicle of this width cannot stand before the location.
    NoApproach {
        /// Which end.
        end: RouteEnd,
        /// The location's code.
        code: String,
    },
    /// The request blocks the ground at an end.
    EndBlocked {
        /// Which end.
        end: RouteEnd,
        /// The face there.
        face: FaceId,
    },
    /// Without what the request blocks there would be a way.
    CutOff,
    /// A narrower vehicle would find a way.
    TooNarrow {
        /// The clearance of the widest way at its narrowest point, metres.
        clearance: f64,
        /// That point.
        at: Point,
    },
    /// A narrow vehicle finds a way, but not one on which the outline touches nothing.
    CannotTurn {
        /// Where it touches something.
        at: Point,
        /// The clearance there, metres.
        clearance: f64,
    },
    /// Not even a point finds a way: nothing drivable joins the ends.
    Disconnected {
        /// The face of the start.
        from: FaceId,
        /// The face of the goal.
        to: FaceId,
    },
}
