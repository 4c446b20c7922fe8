//! A motion that nearly fits becomes one that fits as well as the cells allow.
//!
//! Method: iterated closest points with distances along the normals (Y. Chen and G. Medioni 1992,
//! doi 10.1016/0262-8856(92)90066-C) by Gauss-Newton steps, with robust weights (S. Geman and D. E. `McClure` 1987):
//! what was moved between two scans is far from everything and counts for nothing. The scale of the weights shrinks from
//! that of the search to that of the cells. Cost: O(points x steps). Limits: it finds the fit next to where it begins;
//! along a corridor without an end the shift stays where it was.

use nalgebra::{Matrix3, Vector3};

use super::surfaces::{LEAST_COSINE, Surfaces};
use crate::geometry::{Point, RigidMotion, Vector};

/// Scales of the weights, metres, and steps with each.
const SCHEDULE: [(f64, usize); 4] = [(0.5, 6), (0.2, 6), (0.1, 5), (0.05, 5)];
/// Steps smaller than this, metres (and, times the size of the map, radians), end the search.
const STILL: f64 = 1e-5;
/// Weight that holds a motion in place where no surface does, points.
const HOLD: f64 = 1e-3;

/// The nearest surface to a moved point that faces the same way.
pub(super) struct Contact {
    /// Distance along the normal of the surface, metres.
    pub offset: f64,
    /// Distance to its middle, metres.
    pub distance: f64,
    normal: Vector,
}

/// Finds the surface of `to` that a point with its normal touches after a motion.
pub(super) fn contact(to: &Surfaces<'_>, moved: Point, normal: Vector) -> Option<Contact> {
    let nearest = to.nearest(moved)?;
    let other = to.normals[nearest];
    let way = moved - to.points[nearest];
    (other.dot(&normal) >= LEAST_COSINE).then(|| Contact {
        offset: other.dot(&way),
        distance: way.norm(),
        normal: other,
    })
}

/// Fits a motion to some of the points of `from`, given by index.
pub(super) fn refine(from: &Surfaces<'_>, to: &Surfaces<'_>, points: &[usize], start: RigidMotion) -> RigidMotion {
    let count = points.len().max(1) as f64;
    let center = Point::from(points.iter().map(|&index| from.points[index].coords).sum::<Vector>() / count);
    let size = (points.iter().map(|&index| (from.points[index] - center).norm_squared()).sum::<f64>() / count).sqrt();
    let cell = from.grid.resolution().max(to.grid.resolution());
    let mut motion = start;
    for (scale, steps) in SCHEDULE {
        for _ in 0..steps {
            let step = step(from, to, points, &motion, center, size.max(1.0), scale.max(cell));
            let about = motion.apply(center);
            let turn = RigidMotion { shift: Vector::zeros(), turn: step.z };
            let shift = about.coords - turn.turned(about.coords) + step.xy();
            motion = motion.then(&RigidMotion { shift, turn: step.z });
            if step.xy().norm() + step.z.abs() * size < STILL {
                break;
            }
        }
    }
    motion
}

/// One Gauss-Newton step: shift of the moved centre, metres, and turn about it, radians.
fn step(
    from: &Surfaces<'_>,
    to: &Surfaces<'_>,
    points: &[usize],
    motion: &RigidMotion,
    center: Point,
    size: f64,
    scale: f64,
) -> Vector3<f64> {
    let about = motion.apply(center);
    let (mut matrix, mut right) = (Matrix3::identity() * HOLD, Vector3::zeros());
    for &index in points {
        let moved = motion.apply(from.points[index]);
        let Some(found) = contact(to, moved, motion.turned(from.normals[index])) else { continue };
        let weight = (1.0 + (found.distance / scale).powi(2)).powi(-2);
        let arm = moved - about;
        // The turn in units of the size of the map, so that all three unknowns are metres.
        let slope = Vector3::new(found.normal.x, found.normal.y, arm.perp(&found.normal) / size);
        matrix += slope * slope.transpose() * weight;
        right -= slope * (found.offset * weight);
    }
    let step = matrix.cholesky().map_or_else(Vector3::zeros, |solved| solved.solve(&right));
    Vector3::new(step.x, step.y, step.z / size)
}
