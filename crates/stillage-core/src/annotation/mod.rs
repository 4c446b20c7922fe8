//! Annotation: what the cells say about faces and edges (paper, II-B).
//!
//! [`CellFaces`] tells the face of each cell; [`annotate`] measures faces and edges and gives each face its category:
//! by clustering faces, or by the vote of their cells as in the paper.

mod edges;
mod faces;
mod kinds;
mod membership;
mod merge;
mod outside;
mod raster;
mod roles;

#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

pub use merge::{Cut, merge_alike};
pub use raster::CellFaces;

use crate::adjacency::AdjacencyGraph;
use crate::arrangement::Subdivision;
use crate::categorization::{Categorization, CategoryMap};
use crate::decomposition::{Plot, PlotKind};
use crate::grid::OccupancyGrid;
use crate::relaxation::RelaxationReport;
use crate::segmentation::RegionMap;
use crate::spec::{AnnotationMethod, AnnotationOptions};
use crate::watch::{Stopped, Watch};

/// What the geometry of a face or edge rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Evidence {
    /// Goods, posts or walls along the border show it.
    Observed,
    /// It follows from its surroundings only: from the pitch of a row, or a line continued through open or unknown
    /// space.
    Interpolated,
}

/// What the cells say about a face.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FaceAnnotation {
    /// Category in force: a cluster, or `occupied`, `unknown` or `outside` of [`FaceCategories`].
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
    /// Share of its cells that are occupied and lie more than a rim of 0.1 m inside its border.
    pub inside_occupied_fraction: f64,
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
    /// What it was cut out for; `None` where no plot of the decomposition lies.
    pub kind: Option<PlotKind>,
    /// Share of the category in force among the votes, or in the distribution of the face, 0 to 1.
    pub confidence: f64,
    /// Whether most of its border is observed.
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
    /// Whether cells along it show it.
    pub evidence: Evidence,
    /// 0 (nothing is known along it) to 1 (all of it is known).
    pub confidence: f64,
}

/// What the cells say about all faces and edges.
#[derive(Debug, Clone, PartialEq)]
pub struct Annotations {
    /// By face; entry 0, the unbounded face, is empty.
    pub faces: Vec<FaceAnnotation>,
    /// The categories that faces may have.
    pub categories: FaceCategories,
    /// By edge.
    pub edges: Vec<EdgeAnnotation>,
    /// What the relaxation of the faces did, where it was asked for.
    pub relaxation: Option<RelaxationReport>,
}

/// The categories that faces may have: clusters, and three for faces that no cluster speaks for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FaceCategories {
    /// Number of clusters, of cells where cells vote and of faces where faces are clustered.
    pub clusters: usize,
}

impl From<&CategoryMap> for FaceCategories {
    /// Where cells vote, the categories of cells are the clusters.
    fn from(categories: &CategoryMap) -> Self {
        Self { clusters: categories.categories.len() }
    }
}

impl FaceCategories {
    /// Faces that hold no free cell but occupied ones.
    #[must_use]
    pub fn occupied(&self) -> u8 {
        self.clusters as u8
    }

    /// Faces among known places that hold no known cell at all.
    #[must_use]
    pub fn unknown(&self) -> u8 {
        self.clusters as u8 + 1
    }

    /// Unexplored faces that are joined with the ground outside the map.
    #[must_use]
    pub fn outside(&self) -> u8 {
        self.clusters as u8 + 2
    }

    /// Number of categories a face may have.
    #[must_use]
    pub fn count(&self) -> usize {
        self.clusters + 3
    }
}

/// What is annotated.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The map.
    pub grid: &'a OccupancyGrid,
    /// Categories of its cells.
    pub categorization: &'a Categorization,
    /// Its regions.
    pub regions: &'a RegionMap,
    /// Its faces and edges.
    pub subdivision: &'a Subdivision,
    /// Their dual.
    pub graph: &'a AdjacencyGraph,
    /// The face of each cell.
    pub cells: &'a CellFaces,
    /// What the faces were cut out for.
    pub plots: &'a [Plot],
    /// Room of each face, by face id; empty without rooms.
    pub rooms: &'a [Option<u32>],
}

/// Gives faces their categories and measures faces and edges.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn annotate(
    subject: &Subject<'_>,
    options: &AnnotationOptions,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<Annotations, Stopped> {
    let Subject { grid, categorization, regions, subdivision, graph, cells, plots, rooms } = *subject;
    let categories = &categorization.map;
    let mut faces = faces::annotate_faces(grid, categories, regions, subdivision, cells, watch)?;
    let plot_kinds = roles::kinds(graph, &faces, plots, rooms);
    faces.iter_mut().zip(plot_kinds).for_each(|(face, kind)| face.kind = kind);
    let votes = FaceCategories::from(categories);
    outside::mark_outside(&mut faces, subdivision, votes);
    let kinds = match options.method {
        AnnotationMethod::Vote => {
            if let Some(memberships) = &categorization.memberships {
                membership::average(&mut faces, cells, memberships, watch)?;
            }
            votes
        }
        AnnotationMethod::Faces => kinds::categorize(&mut faces, votes, options, seed, watch)?,
    };
    let relax = |relaxation| membership::relax(&mut faces, subdivision, kinds.clusters, relaxation, watch);
    let relaxation = options.relaxation.map(relax).transpose()?;
    let edges = edges::annotate_edges(grid, subdivision, options, watch)?;
    let evidence = edges::evidence_of_faces(subdivision, &edges);
    faces.iter_mut().zip(evidence).for_each(|(face, evidence)| face.evidence = evidence);
    Ok(Annotations { faces, categories: kinds, edges, relaxation })
}
