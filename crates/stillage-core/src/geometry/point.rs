//! Points, displacements and directions. An angle is counter-clockwise from x, radians.

use std::f64::consts::PI;

/// A point in the grid frame, metres.
pub type Point = nalgebra::Point2<f64>;
/// A displacement in the grid frame, metres.
pub type Vector = nalgebra::Vector2<f64>;

/// The unit vector along `angle` (radians).
#[must_use]
pub fn direction(angle: f64) -> Vector {
    Vector::new(angle.cos(), angle.sin())
}

/// The unit normal of lines that run along `angle`: `direction` turned left by 90 degrees.
///
/// The signed *offset* of a line is the dot product of this normal with any of its points.
#[must_use]
pub fn normal(angle: f64) -> Vector {
    Vector::new(-angle.sin(), angle.cos())
}

/// Folds the direction of an undirected line into `[-pi/2, pi/2)`.
#[must_use]
pub fn fold_half_turn(angle: f64) -> f64 {
    let folded = (angle + PI / 2.0).rem_euclid(PI) - PI / 2.0;
    // rem_euclid may round up to the modulus itself.
    if folded >= PI / 2.0 { folded - PI } else { folded }
}

/// Smallest angle between two undirected lines, in `[0, pi/2]`.
#[must_use]
pub fn line_angle_between(first: f64, second: f64) -> f64 {
    fold_half_turn(first - second).abs()
}
