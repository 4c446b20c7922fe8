//! What each face was cut out for: its room or the part of one, or the plot that a point inside it lies in.
//!
//! On a site with a plan every face is something: ground without room or plot is open floor where it is free on a site
//! with rows, and else nothing that has a name (walls, unseen ground). Cost: O(faces + plots).

use std::collections::BTreeMap;

use super::faces::FaceAnnotation;
use crate::adjacency::AdjacencyGraph;
use crate::arrangement::FaceId;
use crate::geometry::Point;
use crate::plot::{Plot, PlotKind};
use crate::rooms::FaceGround;

/// Least share of free cells in a face that keeps a drivable kind, the majority: plots reach beyond the walls of a
/// region, where nothing is drivable.
const OPEN_SHARE: f64 = 0.5;
/// Side of a bucket of plots, metres: about a place.
const BUCKET_M: f64 = 2.0;

/// The kind of every face, by face id; `None` for the unbounded face, and for all faces without a plan.
pub(super) fn of_faces(
    graph: &AdjacencyGraph,
    faces: &[FaceAnnotation],
    plots: &[Plot],
    grounds: &[FaceGround],
) -> Vec<Option<PlotKind>> {
    if plots.is_empty() && grounds.is_empty() {
        return vec![None; faces.len()];
    }
    let index = PlotIndex::new(plots);
    let has_rows = plots.iter().any(|plot| plot.kind != PlotKind::Place);
    let kind = |face: u32| {
        let annotation = &faces[face as usize];
        let is_free = annotation.free_fraction >= OPEN_SHARE;
        let planned = match grounds.get(face as usize).and_then(|ground| ground.area) {
            Some((_, kind)) => Some(kind),
            None => index.at(graph.position(FaceId(face)), annotation.region).map(|plot| plot.kind),
        };
        match planned {
            Some(PlotKind::Aisle | PlotKind::OpenFloor | PlotKind::Passage) if !is_free => PlotKind::Other,
            Some(kind) => kind,
            None if is_free && has_rows => PlotKind::OpenFloor,
            None => PlotKind::Other,
        }
    };
    (0..faces.len() as u32).map(|face| (FaceId(face) != FaceId::OUTER).then(|| kind(face))).collect()
}

/// Plots by the buckets that their boxes touch.
pub(super) struct PlotIndex<'a> {
    plots: &'a [Plot],
    buckets: BTreeMap<(i64, i64), Vec<u32>>,
}

impl<'a> PlotIndex<'a> {
    pub(super) fn new(plots: &'a [Plot]) -> Self {
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
    pub(super) fn at(&self, point: Point, region: u8) -> Option<Plot> {
        let near = self.buckets.get(&bucket(point))?;
        near.iter()
            .map(|&number| self.plots[number as usize])
            .find(|plot| plot.region == region && plot.bounds.contains(point))
    }
}

fn bucket(point: Point) -> (i64, i64) {
    ((point.x / BUCKET_M).floor() as i64, (point.y / BUCKET_M).floor() as i64)
}
