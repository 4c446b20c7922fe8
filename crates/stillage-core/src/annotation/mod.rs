//! Annotation: what the cells say about faces and edges (paper, II-B).
//!
//! [`CellFaces`] tells the face of each cell; [`annotate`] lets the cells of a face vote on its category and measures
//! how far the map supports each edge.

mod edges;
mod faces;
mod membership;
mod outside;
mod raster;
mod shape;

#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

pub use raster::CellFaces;

use crate::arrangement::Subdivision;
use crate::categorization::Categorization;
use crate::grid::OccupancyGrid;
use crate::relaxation::RelaxationReport;
use crate::segmentation::RegionMap;
use crate::spec::{AnnotationMethod, AnnotationOptions};
use crate::watch::{Stopped, Watch};

/// How sure the geometry of a face or edge is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Evidence {
    /// Cells of the map show it.
    Observed,
    /// It follows from its surroundings only (a line continued through open or unknown space).
    Interpolated,
}

/// What the cells say about a face.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FaceAnnotation {
    /// Category in force: a cluster, or `occupied`, `unknown` or `outside` of
    /// [`CategoryMap`](crate::categorization::CategoryMap).
    pub category: u8,
    /// Share of each cluster among the categorized cells of the face (sums to 1, or all 0 without such cells).
    pub category_shares: Vec<f32>,
    /// Distribution over the clusters: the mean membership of its measured cells, or what relaxation made of it. Absent
    /// where it is no other than [`FaceAnnotation::category_shares`]; empty for a face without categorized cells.
    pub membership: Option<Vec<f32>>,
    /// Cells whose centre lies in the face.
    pub cells: usize,
    /// Share of its cells that are free.
    pub free_fraction: f64,
    /// Share of its cells that are occupied.
    pub occupied_fraction: f64,
    /// Share of its cells that are unknown (1 for a face without cells).
    pub unknown_fraction: f64,
    /// Area, square metres.
    pub area: f64,
    /// Long side over short side of the smallest-area oriented box around it, at least 1.
    pub elongation: f64,
    /// Direction of the long side of that box, radians in `[-pi/2, pi/2)`.
    pub heading: f64,
    /// Long and short side of that box, metres.
    pub extent: [f64; 2],
    /// Region it lies in.
    pub region: u8,
    /// Share of the category in force among the votes, or in the relaxed distribution, 0 to 1.
    pub confidence: f64,
    /// Whether cells show it.
    pub evidence: Evidence,
}

impl FaceAnnotation {
    /// Distribution over the clusters: the membership where there is one, else the shares of the votes.
    #[must_use]
    pub fn distribution(&self) -> &[f32] {
        self.membership.as_ref().filter(|membership| !membership.is_empty()).unwrap_or(&self.category_shares)
    }
}

/// What the cells say about an edge.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EdgeAnnotation {
    /// Share of its length along which an occupied cell lies within the support width.
    pub support: f64,
    /// Share of its length along which free cells lie on both sides and none occupied: where one could pass.
    pub open: f64,
    /// Whether cells show it.
    pub evidence: Evidence,
    /// 0 (nothing is known along it) to 1 (all of it is known).
    pub confidence: f64,
}

/// What the cells say about all faces and edges.
#[derive(Debug, Clone, PartialEq)]
pub struct Annotations {
    /// By face; entry 0, the unbounded face, is empty.
    pub faces: Vec<FaceAnnotation>,
    /// By edge.
    pub edges: Vec<EdgeAnnotation>,
    /// What the relaxation of the faces did, where it was asked for.
    pub relaxation: Option<RelaxationReport>,
}

/// Votes the categories into the faces and measures faces and edges.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn annotate(
    grid: &OccupancyGrid,
    categorization: &Categorization,
    regions: &RegionMap,
    subdivision: &Subdivision,
    cells: &CellFaces,
    options: &AnnotationOptions,
    watch: &Watch<'_>,
) -> Result<Annotations, Stopped> {
    let AnnotationMethod::Vote = options.method;
    let categories = &categorization.map;
    let mut faces = faces::annotate_faces(grid, categories, regions, subdivision, cells, watch)?;
    if let Some(memberships) = &categorization.memberships {
        membership::average(&mut faces, cells, memberships, watch)?;
    }
    let relax = |relaxation| membership::relax(&mut faces, subdivision, categories.categories.len(), relaxation, watch);
    let relaxation = options.relaxation.as_ref().map(relax).transpose()?;
    outside::mark_outside(&mut faces, subdivision, categories);
    let edges = edges::annotate_edges(grid, subdivision, options, watch)?;
    Ok(Annotations { faces, edges, relaxation })
}
