//! Strips of free ground between two rows, or between a row and a wall.

use crate::geometry::{OrientedBox, Point, direction, line_angle_between, normal};

/// Strips of the same ground differ in direction by less than this, radians.
const PARALLEL: f64 = 0.05;
/// Two strips share their ground when this share of the narrower one lies in the other, across.
const SHARED_SHARE: f64 = 0.5;
/// Longest gap along two strips that are one, metres.
const GAP_M: f64 = 0.6;

/// A strip of ground along a direction: ranges along it and across it, metres of the grid frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Strip {
    pub angle: f64,
    pub along: [f64; 2],
    pub across: [f64; 2],
}

impl Strip {
    pub(super) fn width(&self) -> f64 {
        self.across[1] - self.across[0]
    }

    pub(super) fn length(&self) -> f64 {
        self.along[1] - self.along[0]
    }

    pub(super) fn bounds(&self) -> OrientedBox {
        let middle = |[low, high]: [f64; 2]| f64::midpoint(low, high);
        let center = direction(self.angle) * middle(self.along) + normal(self.angle) * middle(self.across);
        let half_extents = [self.length() / 2.0, self.width() / 2.0];
        OrientedBox { center: Point::from(center), half_extents, angle: self.angle }
    }

    /// The strip of the same ground as two that overlap: as long as both, and as wide as their common part.
    fn joined(&self, other: &Self) -> Option<Self> {
        if line_angle_between(self.angle, other.angle) > PARALLEL {
            return None;
        }
        let common = |one: [f64; 2], other: [f64; 2]| [one[0].max(other[0]), one[1].min(other[1])];
        let across = common(self.across, other.across);
        let gap = common(self.along, other.along);
        let is_shared = across[1] - across[0] >= SHARED_SHARE * self.width().min(other.width());
        (is_shared && gap[1] - gap[0] >= -GAP_M).then(|| Self {
            angle: self.angle,
            along: [self.along[0].min(other.along[0]), self.along[1].max(other.along[1])],
            across,
        })
    }
}

/// Joins the strips of the same ground, longest first.
pub(super) fn joined(mut strips: Vec<Strip>) -> Vec<Strip> {
    strips.sort_by(|one, other| other.length().total_cmp(&one.length()));
    let mut found: Vec<Strip> = Vec::new();
    for mut strip in strips {
        while let Some((index, both)) =
            found.iter().enumerate().find_map(|(index, other)| Some((index, other.joined(&strip)?)))
        {
            found.swap_remove(index);
            strip = both;
        }
        found.push(strip);
    }
    found
}
