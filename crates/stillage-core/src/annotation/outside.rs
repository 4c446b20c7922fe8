//! The ground outside the site: unexplored faces that are connected with the unbounded face over such faces, or with a
//! hole in the regions (a courtyard that the robot did not see).
//!
//! Faces without a free cell lie both inside and around the site: beams end at walls and goods, and regions consist of
//! whole tiles, which reach beyond the walls. A face inside may hold goods, a face around the site is no place at
//! all, so the latter have a category of their own. Cost: O(faces + edges).

use super::face_categories::FaceCategories;
use super::faces::FaceAnnotation;
use crate::arrangement::{FaceId, Subdivision};
use crate::plot::PlotKind;
use crate::segmentation::RegionMap;

/// Least share of unknown cells in an unexplored face: the majority.
const UNEXPLORED: f64 = 0.5;

/// Gives the faces outside the site their category.
pub(super) fn mark_outside(faces: &mut [FaceAnnotation], subdivision: &Subdivision, categories: FaceCategories) {
    let is_candidate = |face: &FaceAnnotation| {
        // A face without a cell is no evidence of unexplored ground.
        let is_unexplored = face.cells > 0 && face.unknown_fraction > UNEXPLORED;
        let is_place = face.kind == Some(PlotKind::Place);
        usize::from(face.category) >= categories.clusters && is_unexplored && !is_place
    };
    let mut waiting = vec![FaceId::OUTER];
    for face in subdivision.faces() {
        let annotation = &mut faces[face.index()];
        if annotation.region == RegionMap::NONE && is_candidate(annotation) {
            mark(annotation, categories);
            waiting.push(face);
        }
    }
    while let Some(face) = waiting.pop() {
        for half_edge in subdivision.boundary(face) {
            let behind = subdivision.half_edge(half_edge.twin()).face;
            let annotation = &mut faces[behind.index()];
            let is_marked = annotation.category == categories.outside();
            if behind != FaceId::OUTER && !is_marked && is_candidate(annotation) {
                mark(annotation, categories);
                waiting.push(behind);
            }
        }
    }
}

fn mark(face: &mut FaceAnnotation, categories: FaceCategories) {
    face.category = categories.outside();
    face.confidence = face.unknown_fraction;
}
