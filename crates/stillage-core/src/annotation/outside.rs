//! The ground outside the site: unexplored faces that a chain of such faces joins with the unbounded one, or with a
//! hole in the regions (a courtyard that nobody saw).
//!
//! The decomposition covers whole tiles, and beams end at walls and goods: both leave faces without a free cell. Those
//! among known places hold something, those around the site hold nothing anyone knows of, so the two are told apart
//! here and not left to one label. Cost: O(faces + edges).

use super::face_categories::FaceCategories;
use super::faces::FaceAnnotation;
use crate::arrangement::{FaceId, Subdivision};
use crate::plot::PlotKind;
use crate::segmentation::RegionMap;

/// A face is unexplored when most of its cells are unknown.
const UNEXPLORED: f64 = 0.5;

/// Gives the faces outside their category.
pub(super) fn mark_outside(faces: &mut [FaceAnnotation], subdivision: &Subdivision, categories: FaceCategories) {
    let is_candidate = |face: &FaceAnnotation| {
        // A face too thin for a cell says nothing of the ground.
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
