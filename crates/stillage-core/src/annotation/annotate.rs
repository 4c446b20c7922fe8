//! The annotations of all faces and edges, stage by stage.

use super::edges::{self, EdgeAnnotation};
use super::face_categories::FaceCategories;
use super::faces::{self, FaceAnnotation};
use super::{clusters, membership, outside, plot_kinds};
use crate::adjacency::AdjacencyGraph;
use crate::arrangement::{CellFaces, Subdivision};
use crate::categorization::Categorization;
use crate::grid::OccupancyGrid;
use crate::plot::Plot;
use crate::relaxation::RelaxationReport;
use crate::rooms::FaceGround;
use crate::segmentation::RegionMap;
use crate::spec::{AnnotationMethod, AnnotationOptions};
use crate::watch::{Stopped, Watch};

/// What is known of all faces and edges.
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
    /// Room of each face or part of one, by face id; empty without rooms.
    pub grounds: &'a [FaceGround],
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
    let Subject { grid, categorization, regions, subdivision, graph, cells, plots, grounds } = *subject;
    let categories = &categorization.map;
    let measured = faces::annotate_faces(grid, categories, regions, subdivision, cells, |_| true, watch)?;
    let mut faces: Vec<FaceAnnotation> = measured.into_iter().flatten().collect();
    let kinds = plot_kinds::of_faces(graph, &faces, plots, grounds);
    faces.iter_mut().zip(kinds).for_each(|(face, kind)| face.kind = kind);
    let votes = FaceCategories::from(categories);
    outside::mark_outside(&mut faces, subdivision, votes);
    let face_categories = match options.method {
        AnnotationMethod::Vote => {
            if let Some(memberships) = &categorization.memberships {
                membership::average(&mut faces, cells, memberships, watch)?;
            }
            votes
        }
        AnnotationMethod::Faces => clusters::categorize(&mut faces, votes, options, seed, watch)?,
    };
    let relax = |relaxation| membership::relax(&mut faces, subdivision, face_categories.clusters, relaxation, watch);
    let relaxation = options.relaxation.map(relax).transpose()?;
    let edges = edges::annotate_edges(grid, subdivision, options, watch)?;
    let evidence = edges::evidence_of_faces(subdivision, &edges);
    faces.iter_mut().zip(evidence).for_each(|(face, evidence)| face.evidence = evidence);
    Ok(Annotations { faces, categories: face_categories, edges, relaxation })
}
