//! Rules of people about the navigation graph of their site.
//!
//! A rule names nodes and lanes by where they lie, so that it outlives the graph: after a new analysis or a new scan it holds for
//! those that are there then. Kept in the frame of the site, applied in that of the grid ([`LaneRule::moved`]).

use serde::{Deserialize, Serialize};

use crate::geometry::{Point, RigidMotion};

/// A rule about a node or a lane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "rule", rename_all = "kebab-case")]
pub enum LaneRule {
    /// No vehicle drives over the node at a place.
    NoNode {
        /// Where it lies, metres.
        at: Point,
    },
    /// No vehicle drives over a lane, in either direction.
    NoLane {
        /// A place on it, metres.
        from: Point,
        /// Another one, metres.
        to: Point,
    },
    /// Vehicles drive over a lane in one direction only.
    OneWay {
        /// A place on it, metres.
        from: Point,
        /// A place further on, metres.
        to: Point,
    },
}

impl LaneRule {
    /// The same rule in another frame.
    #[must_use]
    pub fn moved(&self, motion: &RigidMotion) -> Self {
        let at = |point: Point| motion.apply(point);
        match *self {
            Self::NoNode { at: place } => Self::NoNode { at: at(place) },
            Self::NoLane { from, to } => Self::NoLane { from: at(from), to: at(to) },
            Self::OneWay { from, to } => Self::OneWay { from: at(from), to: at(to) },
        }
    }
}
