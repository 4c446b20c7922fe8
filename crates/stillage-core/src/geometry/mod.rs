//! Points, segments, polygons and boxes of the plane: each formula once, for every stage and for the service.
//!
//! | module | what it answers |
//! | --- | --- |
//! | [`point`] | points, displacements, directions and normals of lines |
//! | [`segment`] | distance from a point, crossing with a line, whether a ray crosses |
//! | [`polygon`] | area, centroid, point in polygon, rings of a walk that touches itself |
//! | [`common_area`] | what two polygons have in common, exactly |
//! | [`bounds`] | boxes along the axes: around points, whether they meet a box or a segment |
//! | [`oriented_box`] | boxes of any direction, and the smallest one around points |
//! | [`rigid_motion`] | shift and turn, one after the other and back |
//! | [`disjoint_sets`] | union-find |
//! | [`hash`] | pseudo-random numbers from indices |
//!
//! A *ring* is a closed polygon line whose first point is not repeated. A *polygon* is a list of rings: outlines
//! counter-clockwise, holes clockwise. Everything is deterministic and works in `f64` without tolerance.

pub mod bounds;
pub(crate) mod common_area;
mod convex_hull;
pub(crate) mod disjoint_sets;
pub(crate) mod hash;
pub mod oriented_box;
pub mod point;
pub mod polygon;
pub mod rigid_motion;
pub mod segment;

pub use bounds::Bounds;
pub use oriented_box::OrientedBox;
pub use point::{Point, Vector, direction, fold_half_turn, line_angle_between, normal};
pub use polygon::ring_area;
pub use rigid_motion::RigidMotion;

pub(crate) use convex_hull::convex_hull;
pub(crate) use disjoint_sets::DisjointSets;
