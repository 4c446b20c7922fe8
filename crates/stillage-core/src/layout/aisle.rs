//! Aisles and rows: how locations lie along the corridors.

use serde::{Deserialize, Serialize};

use super::location::Side;
use crate::geometry::{OrientedBox, Point};

/// A straight stretch of drivable ground with locations along it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Aisle {
    /// Its number, from 1; that of its locations.
    pub number: u32,
    /// Its middle line, from its start to its end, grid frame, metres.
    pub center_line: [Point; 2],
    /// Distance between the fronts on both sides, or from the fronts to the other border of the ground, metres.
    pub width: f64,
    /// The place (corridor, junction or room) it runs through.
    pub corridor: u32,
    /// Indices of the locations on its left, from its start; those behind others follow them.
    pub left: Vec<usize>,
    /// Indices of the locations on its right, likewise.
    pub right: Vec<usize>,
}

impl Aisle {
    /// Length of its middle line, metres.
    #[must_use]
    pub fn length(&self) -> f64 {
        (self.center_line[1] - self.center_line[0]).norm()
    }

    /// Its border, grid frame, counter-clockwise, metres.
    #[must_use]
    pub fn outline(&self) -> Vec<Point> {
        strip(self.center_line, self.width)
    }

    /// Its direction, from its start, radians, grid frame.
    #[must_use]
    pub fn heading(&self) -> f64 {
        let along = self.center_line[1] - self.center_line[0];
        along.y.atan2(along.x)
    }
}

/// Locations side by side along one side of an aisle, without a gap that a vehicle could drive through.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Its number, from 1; that of its locations.
    pub number: u32,
    /// The aisle it is reached from.
    pub aisle: u32,
    /// Its side of that aisle.
    pub side: Side,
    /// The middle line of its places, in the direction of the aisle, grid frame, metres.
    pub center_line: [Point; 2],
    /// Extent away from the aisle, metres.
    pub depth: f64,
    /// How many places lie one behind the other.
    pub layers: u32,
    /// Indices of its locations, from the aisle's start; those behind others follow them.
    pub locations: Vec<usize>,
}

impl Row {
    /// Length of its middle line, metres.
    #[must_use]
    pub fn length(&self) -> f64 {
        (self.center_line[1] - self.center_line[0]).norm()
    }
    /// Its border, grid frame, counter-clockwise, metres.
    #[must_use]
    pub fn outline(&self) -> Vec<Point> {
        strip(self.center_line, self.depth)
    }
}

/// The border of what is so wide along a line.
fn strip(line: [Point; 2], width: f64) -> Vec<Point> {
    let along = line[1] - line[0];
    let half_extents = [along.norm() / 2.0, width / 2.0];
    let center = nalgebra::center(&line[0], &line[1]);
    OrientedBox { center, angle: along.y.atan2(along.x), half_extents }.corners().to_vec()
}
