//! Points and angles shared by every stage.

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

/// Signed area of a ring (first point not repeated), square metres; positive when counter-clockwise.
#[must_use]
pub fn ring_area(ring: &[Point]) -> f64 {
    let Some(anchor) = ring.first() else { return 0.0 };
    ring.windows(2).map(|pair| (pair[0] - anchor).perp(&(pair[1] - anchor))).sum::<f64>() / 2.0
}

/// A rectangle of any orientation.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct OrientedBox {
    /// Centre, metres.
    pub center: Point,
    /// Half the side along `angle` and half the side across it, metres.
    pub half_extents: [f64; 2],
    /// Direction of the first side, radians.
    pub angle: f64,
}

impl OrientedBox {
    /// Smallest box of the given direction around the points; `None` without points.
    #[must_use]
    pub fn around(points: impl IntoIterator<Item = Point>, angle: f64) -> Option<Self> {
        let (along, across) = (direction(angle), normal(angle));
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            for (axis, unit) in [along, across].iter().enumerate() {
                let value = unit.dot(&point.coords);
                low[axis] = low[axis].min(value);
                high[axis] = high[axis].max(value);
            }
        }
        let half_extents = [(high[0] - low[0]) / 2.0, (high[1] - low[1]) / 2.0];
        let center = Point::from(along * (low[0] + high[0]) / 2.0 + across * (low[1] + high[1]) / 2.0);
        half_extents.iter().all(|extent| extent.is_finite()).then_some(Self { center, half_extents, angle })
    }

    /// The four corners, counter-clockwise.
    #[must_use]
    pub fn corners(&self) -> [Point; 4] {
        let along = direction(self.angle) * self.half_extents[0];
        let across = normal(self.angle) * self.half_extents[1];
        [
            self.center - along - across,
            self.center + along - across,
            self.center + along + across,
            self.center - along + across,
        ]
    }
}
