//! The ground that something takes up, as far as a comparison needs it.

use crate::geometry::{Bounds, Point, RigidMotion, ring_area};

/// A place in one of two maps, in a frame that both share.
#[derive(Debug, Clone, PartialEq)]
pub struct Footprint {
    /// Its border, metres, counter-clockwise; the first point is not repeated.
    pub outline: Vec<Point>,
    /// Its middle, metres.
    pub center: Point,
}

impl Footprint {
    /// The same ground after a motion.
    #[must_use]
    pub fn moved(&self, motion: &RigidMotion) -> Self {
        let outline = self.outline.iter().map(|&point| motion.apply(point)).collect();
        Self { outline, center: motion.apply(self.center) }
    }

    /// The box around it.
    pub(super) fn bounds(&self) -> Bounds {
        Bounds::around(&self.outline)
    }

    /// Area, square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        ring_area(&self.outline)
    }
}
