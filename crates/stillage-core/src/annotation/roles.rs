//! What each face was cut out for: the plot of the decomposition that its inner point lies in, and how much of its border
//! runs along the fronts of places.
//!
//! Cost: O(faces + edges + plots).

use std::collections::BTreeMap;

use super::FaceAnnotation;
use crate::adjacency::AdjacencyGraph;
use crate::arrangement::{FaceId, Subdivision};
use crate::decomposition::{Plot, PlotKind};
use crate::geometry::{Point, direction, line_angle_between, normal};

/// Side of a bucket of plots, metres: about a place.
const BUCKET_M: f64 = 2.0;
/// An edge that is nearer than this to the direction of a row is its front or back.
const FRONT_ANGLE: f64 = std::f64::consts::FRAC_PI_4;

/// The role of a face in the decomposition.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Role {
    /// The plot that holds the face's inner point.
    pub plot: Option<Plot>,
    /// Length of its border along the fronts and backs of places, metres.
    pub fronts: f64,
}

/// The role of every face, by face id.
pub(super) fn roles(
    subdivision: &Subdivision,
    graph: &AdjacencyGraph,
    faces: &[FaceAnnotation],
    plots: &[Plot],
) -> Vec<Role> {
    let index = PlotIndex::new(plots);
    let mut roles: Vec<Role> = (0..subdivision.face_count())
        .map(|face| {
            let is_bounded = face != FaceId::OUTER.index();
            let plot = is_bounded.then(|| index.at(graph.position(FaceId(face as u32)), faces[face].region)).flatten();
            Role { plot, fronts: 0.0 }
        })
        .collect();
    for edge in subdivision.edges() {
        let [start, end] = subdivision.segment(edge);
        let along = (end - start).y.atan2((end - start).x);
        let [left, right] = subdivision.sides(edge).map(FaceId::index);
        for (face, behind) in [(left, right), (right, left)] {
            let is_front = roles[behind].plot.is_some_and(|plot| {
                plot.kind == PlotKind::Place && line_angle_between(plot.bounds.angle, along) < FRONT_ANGLE
            });
            if is_front {
                roles[face].fronts += (end - start).norm();
            }
        }
    }
    roles
}

/// Plots by the buckets that their boxes touch.
struct PlotIndex<'a> {
    plots: &'a [Plot],
    buckets: BTreeMap<(i64, i64), Vec<u32>>,
}

impl<'a> PlotIndex<'a> {
    fn new(plots: &'a [Plot]) -> Self {
        let mut buckets: BTreeMap<(i64, i64), Vec<u32>> = BTreeMap::new();
        for (number, plot) in (0..).zip(plots) {
            let corners = plot.bounds.corners().map(bucket);
            let columns = corners.iter().map(|corner| corner.0);
            let rows = corners.iter().map(|corner| corner.1);
            let (left, right) = (columns.clone().min().unwrap_or(0), columns.max().unwrap_or(0));
            let (low, high) = (rows.clone().min().unwrap_or(0), rows.max().unwrap_or(0));
            for row in low..=high {
                for column in left..=right {
                    buckets.entry((column, row)).or_default().push(number);
                }
            }
        }
        Self { plots, buckets }
    }

    /// The first plot of a region that holds a point.
    fn at(&self, point: Point, region: u8) -> Option<Plot> {
        let near = self.buckets.get(&bucket(point))?;
        near.iter().map(|&number| self.plots[number as usize]).find(|plot| plot.region == region && holds(plot, point))
    }
}

fn bucket(point: Point) -> (i64, i64) {
    ((point.x / BUCKET_M).floor() as i64, (point.y / BUCKET_M).floor() as i64)
}

fn holds(plot: &Plot, point: Point) -> bool {
    let offset = point - plot.bounds.center;
    let along = direction(plot.bounds.angle).dot(&offset).abs();
    let across = normal(plot.bounds.angle).dot(&offset).abs();
    along <= plot.bounds.half_extents[0] && across <= plot.bounds.half_extents[1]
}
