//! Shift and turn of the plane.

use serde::{Deserialize, Serialize};

use super::point::{Point, Vector, direction, normal};

/// A turn about the origin, then a shift: lengths and angles stay.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RigidMotion {
    /// Displacement after the turn, metres.
    pub shift: Vector,
    /// Counter-clockwise turn, radians.
    pub turn: f64,
}

impl RigidMotion {
    /// The motion that moves nothing.
    #[must_use]
    pub const fn identity() -> Self {
        Self { shift: Vector::new(0.0, 0.0), turn: 0.0 }
    }

    /// Moves a point.
    #[must_use]
    pub fn apply(&self, point: Point) -> Point {
        Point::origin() + self.turned(point.coords) + self.shift
    }

    /// Turns a displacement.
    #[must_use]
    pub fn turned(&self, vector: Vector) -> Vector {
        direction(self.turn) * vector.x + normal(self.turn) * vector.y
    }

    /// The way back.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let back = Self { shift: Vector::zeros(), turn: -self.turn };
        Self { shift: -back.turned(self.shift), turn: -self.turn }
    }

    /// First this motion, then another.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self { shift: next.turned(self.shift) + next.shift, turn: wrapped(self.turn + next.turn) }
    }
}

/// An angle in `[-pi, pi)`.
fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let folded = (angle + PI).rem_euclid(TAU) - PI;
    // rem_euclid may round up to the modulus itself.
    if folded >= PI { folded - TAU } else { folded }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_point_is_turned_before_it_is_shifted() {
        let motion = RigidMotion { shift: Vector::new(10.0, 0.0), turn: std::f64::consts::FRAC_PI_2 };
        assert!((motion.apply(Point::new(1.0, 0.0)) - Point::new(10.0, 1.0)).norm() < 1e-12);
    }

    proptest! {
        #[test]
        fn there_and_back(x in -100.0..100.0, y in -100.0..100.0, turn in -3.0..3.0, other in -3.0..3.0) {
            let one = RigidMotion { shift: Vector::new(y, x), turn };
            let next = RigidMotion { shift: Vector::new(x, -y), turn: other };
            let point = Point::new(x, y);
            prop_assert!((one.inverse().apply(one.apply(point)) - point).norm() < 1e-9);
            prop_assert!((one.then(&next).apply(point) - next.apply(one.apply(point))).norm() < 1e-9);
        }
    }
}
