//! The annotations of a redrawn subdivision.
//!
//! Faces and edges that were not redrawn keep theirs. New ones are measured from the cells; the category of a new face is
//! the one that most of its cells had, and its shares are the mean of those of the faces that it was made of. A face on
//! ground that no face had is occupied or unknown. Counts are whole numbers, so that threads do not matter. Cost: O(cells).

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::edges::{self, EdgeAnnotation};
use super::face_categories::FaceCategories;
use super::faces::{self, FaceAnnotation};
use crate::adjacency::AdjacencyGraph;
use crate::arrangement::{CellFaces, EdgeId, FaceId, KeptParts, Subdivision};
use crate::categorization::CategoryMap;
use crate::grid::OccupancyGrid;
use crate::segmentation::RegionMap;
use crate::spec::AnnotationOptions;
use crate::watch::{Stopped, Watch};

/// Cells that one task compares.
const CELLS_PER_BLOCK: usize = 1 << 18;

/// A redrawn subdivision, and what is known of it from before.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Redrawn<'a> {
    /// The map.
    pub grid: &'a OccupancyGrid,
    /// Categories of its cells.
    pub categories: &'a CategoryMap,
    /// Its regions.
    pub regions: &'a RegionMap,
    /// The subdivision, its dual and the face of each cell.
    pub subdivision: &'a Subdivision,
    pub graph: &'a AdjacencyGraph,
    pub cells: &'a CellFaces,
    /// What it has of the one before.
    pub kept: &'a KeptParts,
    /// Face of each cell, and annotations, before.
    pub cells_before: &'a CellFaces,
    pub faces_before: &'a [FaceAnnotation],
    pub edges_before: &'a [EdgeAnnotation],
    /// The categories that faces may have.
    pub face_categories: FaceCategories,
}

/// Annotates a redrawn subdivision: its faces, then its edges, by id. What faces were cut out for is left open where
/// they are new.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub(crate) fn annotate_anew(
    redrawn: &Redrawn<'_>,
    options: &AnnotationOptions,
    watch: &Watch<'_>,
) -> Result<(Vec<FaceAnnotation>, Vec<EdgeAnnotation>), Stopped> {
    let Redrawn { grid, subdivision, kept, .. } = *redrawn;
    let edge = |(index, before): (usize, &Option<EdgeId>)| match before {
        Some(before) => redrawn.edges_before[before.index()].clone(),
        None => edges::annotate_edge(grid, subdivision, EdgeId(index as u32), options.support_width_m),
    };
    let edges: Vec<EdgeAnnotation> = kept.edges.par_iter().enumerate().map(edge).collect();
    let is_new = |face: FaceId| kept.faces[face.index()].is_none();
    let measured =
        faces::annotate_faces(grid, redrawn.categories, redrawn.regions, subdivision, redrawn.cells, is_new, watch)?;
    let mut origins = Origins::count(redrawn, is_new);
    let evidence = edges::evidence_of_faces(subdivision, &edges);
    let face = |(index, measured): (usize, Option<FaceAnnotation>)| {
        let face = FaceId(index as u32);
        match (measured, kept.faces[index]) {
            (None, before) => redrawn.faces_before[before.map_or(0, FaceId::index)].clone(),
            (Some(measured), _) => {
                let measured = FaceAnnotation { evidence: evidence[index], ..measured };
                inherited(redrawn, measured, &origins.of(redrawn, face))
            }
        }
    };
    let faces = measured.into_iter().enumerate().map(face).collect();
    Ok((faces, edges))
}

/// The faces before that the cells of each new face lay in.
struct Origins(BTreeMap<FaceId, Vec<(FaceId, u32)>>);

impl Origins {
    fn count(redrawn: &Redrawn<'_>, is_new: impl Fn(FaceId) -> bool + Sync) -> Self {
        let size = redrawn.cells.len();
        let count = |block: usize| {
            let mut counts: BTreeMap<(FaceId, FaceId), u32> = BTreeMap::new();
            let cells = block * CELLS_PER_BLOCK..((block + 1) * CELLS_PER_BLOCK).min(size);
            for (face, run) in redrawn.cells.runs(cells).filter(|(face, _)| is_new(*face)) {
                for (was, run) in redrawn.cells_before.runs(run) {
                    *counts.entry((face, was)).or_default() += run.len() as u32;
                }
            }
            counts
        };
        let blocks = (0..size.div_ceil(CELLS_PER_BLOCK)).into_par_iter();
        let counts: Vec<BTreeMap<(FaceId, FaceId), u32>> = blocks.map(count).collect();
        let mut sums: BTreeMap<(FaceId, FaceId), u32> = BTreeMap::new();
        for (pair, count) in counts.into_iter().flatten() {
            *sums.entry(pair).or_default() += count;
        }
        let mut origins: BTreeMap<FaceId, Vec<(FaceId, u32)>> = BTreeMap::new();
        for ((face, was), count) in sums {
            origins.entry(face).or_default().push((was, count));
        }
        Self(origins)
    }

    /// The origins of a face that had a face; a face without a cell has that of the cell which holds a point inside it.
    fn of(&mut self, redrawn: &Redrawn<'_>, face: FaceId) -> Vec<(FaceId, u32)> {
        let inside = redrawn.grid.cell_at(redrawn.graph.position(face));
        let near = || inside.map(|(column, row)| (redrawn.cells_before.at(column, row), 1)).into_iter().collect();
        let mut origins = self.0.remove(&face).unwrap_or_else(near);
        origins.retain(|(was, _)| *was != FaceId::OUTER);
        origins
    }
}

/// A measured face with the category of the faces that it was made of.
fn inherited(redrawn: &Redrawn<'_>, measured: FaceAnnotation, origins: &[(FaceId, u32)]) -> FaceAnnotation {
    let kinds = redrawn.face_categories;
    let mut votes = vec![[0.0; 2]; kinds.count()];
    for &(was, cells) in origins {
        let before = &redrawn.faces_before[was.index()];
        let [all, sure] = &mut votes[usize::from(before.category)];
        *all += f64::from(cells);
        *sure += f64::from(cells) * before.confidence;
    }
    // Of equals the lower one.
    let most = votes.iter().enumerate().reduce(|most, other| if other.1[0] > most.1[0] { other } else { most });
    let Some((category, &[all, sure])) = most.filter(|(_, [all, _])| *all > 0.0) else {
        let is_occupied = measured.occupied_fraction > measured.free_fraction;
        let category = if is_occupied { kinds.occupied() } else { kinds.unknown() };
        return FaceAnnotation { category, category_shares: vec![0.0; kinds.clusters], confidence: 0.0, ..measured };
    };
    let membership = |face: &FaceAnnotation| face.membership.clone();
    let has_membership = origins.iter().any(|(was, _)| redrawn.faces_before[was.index()].membership.is_some());
    FaceAnnotation {
        category: category as u8,
        category_shares: mean(redrawn, origins, |face| Some(face.category_shares.clone())),
        membership: has_membership.then(|| mean(redrawn, origins, membership)),
        confidence: (sure / all).clamp(0.0, 1.0),
        ..measured
    }
}

/// The mean distribution of some faces, each by its cells; empty where none has one.
fn mean(
    redrawn: &Redrawn<'_>,
    origins: &[(FaceId, u32)],
    distribution: impl Fn(&FaceAnnotation) -> Option<Vec<f32>>,
) -> Vec<f32> {
    let mut sums: Vec<f64> = Vec::new();
    let mut weight = 0.0;
    for &(was, cells) in origins {
        let shares = distribution(&redrawn.faces_before[was.index()]).unwrap_or_default();
        if shares.is_empty() {
            continue;
        }
        sums.resize(shares.len(), 0.0);
        weight += f64::from(cells);
        sums.iter_mut().zip(shares).for_each(|(sum, share)| *sum += f64::from(cells) * f64::from(share));
    }
    sums.into_iter().map(|sum| (sum / weight) as f32).collect()
}
