//! Why there is no route.

use crate::arrangement::FaceId;

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

/// Why there is no route.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoRoute {
    /// The end lies outside the decomposed part of the map.
    #[error("the {0} lies outside the map")]
    Outside(RouteEnd),
    /// The face there is not drivable.
    #[error("the {end} lies in face {face}, which is labelled {label} and not drivable")]
    NotDrivable {
        /// Which end.
        end: RouteEnd,
        /// The face there.
        face: FaceId,
        /// The name of its label.
        label: String,
    },
    /// The cell there is not free, or no cell of the face is.
    #[error("the {0} lies on a cell that is not free")]
    Blocked(RouteEnd),
    /// The location has no storage-access edge.
    #[error("location {code}, the {end}, has no storage-access edge")]
    NoAccess {
        /// Which end.
        end: RouteEnd,
        /// The location's code.
        code: String,
    },
    /// Both ends are fine, but no chain of drivable links joins them.
    #[error("no chain of drivable links joins face {from} and face {to}")]
    Disconnected {
        /// The face of the start.
        from: FaceId,
        /// The face of the goal.
        to: FaceId,
    },
    /// Drivable links join the ends, but obstacles close the way on the cells.
    #[error("drivable links join the ends, but no free path leads through them")]
    Obstructed,
}
