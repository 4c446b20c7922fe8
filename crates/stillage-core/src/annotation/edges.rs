//! Measurements of edges: how much of an edge is occupied, how much is open, and how much is known.
//!
//! Samples lie every half cell along an edge, and at each sample every cell across it out to the support width, so that
//! at most a corner of a covered cell is missed. (The author's later code prunes edges by the occupied share within 5
//! pixels; here nothing is pruned, the shares are reported.)
//!
//! An edge is observed where occupied cells stand along at least the share of it that two posts of 0.09 m take of the
//! side of a place of 1.2 m; a face is observed where most of its border is. All others are interpolated. What a face
//! holds does not matter for this. Cost: O(length / cell x width / cell) per edge, in parallel.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::evidence::Evidence;
use crate::arrangement::{EdgeId, FaceId, Subdivision};
use crate::geometry::Vector;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::spec::AnnotationOptions;
use crate::watch::{Stopped, Watch};

/// Least share of the length of an observed edge along which occupied cells stand: two posts of 0.09 m on 1.2 m.
const OBSERVED_SHARE: f64 = 0.15;
/// Least share of the border of an observed face that is observed: the majority.
const OBSERVED_BORDER_SHARE: f64 = 0.5;

/// What is known of an edge from the cells along it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EdgeAnnotation {
    /// Share of its length along which an occupied cell lies within the support width.
    pub support: f64,
    /// Share of its length along which free cells lie on both sides and none occupied: where one could pass.
    pub open: f64,
    /// Whether cells along it show it.
    pub evidence: Evidence,
    /// 0 (nothing is known along it) to 1 (all of it is known).
    pub confidence: f64,
}

/// Annotates every edge.
pub(super) fn annotate_edges(
    grid: &OccupancyGrid,
    subdivision: &Subdivision,
    options: &AnnotationOptions,
    watch: &Watch<'_>,
) -> Result<Vec<EdgeAnnotation>, Stopped> {
    let annotate = |edge: u32| {
        if edge.is_multiple_of(256) {
            watch.check()?;
        }
        Ok(annotate_edge(grid, subdivision, EdgeId(edge), options.support_width_m))
    };
    (0..subdivision.edge_count() as u32).into_par_iter().map(annotate).collect()
}

/// Annotates one edge; `support_width` in metres.
pub(super) fn annotate_edge(
    grid: &OccupancyGrid,
    subdivision: &Subdivision,
    edge: EdgeId,
    support_width: f64,
) -> EdgeAnnotation {
    // All in cells from here on.
    let [start, end] = subdivision.segment(edge).map(|point| point.coords / grid.resolution());
    let along = end - start;
    let length = along.norm();
    let across = Vector::new(-along.y, along.x) / length;
    let width = support_width / grid.resolution();
    let strip = cell_steps(-width, width);
    let beyond = across * (width + 0.5);
    let at = |point: Vector| grid.at(floor(point.x), floor(point.y));

    let samples = (2.0 * length).ceil().max(1.0) as usize;
    let (mut supported, mut open, mut known) = (0_usize, 0_usize, 0_usize);
    for sample in 0..samples {
        let place = start + along * ((sample as f64 + 0.5) / samples as f64);
        let sides = [at(place - beyond), at(place + beyond)];
        let mut is_supported = false;
        let mut count_known = |cell: Occupancy| known += usize::from(cell != Occupancy::Unknown);
        sides.into_iter().for_each(&mut count_known);
        for &offset in &strip {
            let cell = at(place + across * offset);
            is_supported |= cell == Occupancy::Occupied;
            count_known(cell);
        }
        supported += usize::from(is_supported);
        open += usize::from(!is_supported && sides == [Occupancy::Free; 2]);
    }
    let share = |count: usize, of: usize| count as f64 / of as f64;
    let support = share(supported, samples);
    EdgeAnnotation {
        support,
        open: share(open, samples),
        evidence: if support >= OBSERVED_SHARE { Evidence::Observed } else { Evidence::Interpolated },
        confidence: share(known, samples * (strip.len() + 2)),
    }
}

/// Whether every face was observed, by face id; the unbounded one was not.
pub(super) fn evidence_of_faces(subdivision: &Subdivision, edges: &[EdgeAnnotation]) -> Vec<Evidence> {
    let mut lengths = vec![[0.0; 2]; subdivision.face_count()];
    for edge in subdivision.edges() {
        let is_observed = edges[edge.index()].evidence == Evidence::Observed;
        for side in subdivision.sides(edge) {
            let [all, observed] = &mut lengths[side.index()];
            *all += subdivision.length(edge);
            *observed += if is_observed { subdivision.length(edge) } else { 0.0 };
        }
    }
    let evidence = |(face, [all, observed]): (usize, [f64; 2])| {
        let is_observed = face != FaceId::OUTER.index() && observed >= OBSERVED_BORDER_SHARE * all;
        if is_observed { Evidence::Observed } else { Evidence::Interpolated }
    };
    lengths.into_iter().enumerate().map(evidence).collect()
}

/// Offsets from one bound to the other, evenly, at most a cell apart.
fn cell_steps(from: f64, to: f64) -> Vec<f64> {
    let steps = (to - from).ceil() as usize;
    (0..=steps).map(|step| from + (to - from) * step as f64 / steps.max(1) as f64).collect()
}

/// `value.floor()` without a library call, for values that fit.
fn floor(value: f64) -> i64 {
    let toward_zero = value as i64;
    toward_zero - i64::from(value < toward_zero as f64)
}
