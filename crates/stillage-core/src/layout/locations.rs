//! The storage locations of a map.

use super::access::Access;
use super::aisles;
use super::codes::Codes;
use super::location::Location;
use super::occupancy::occupancy;
use crate::analysis::Analysis;
use crate::arrangement::FaceId;
use crate::semantics::SemanticMap;

/// Lists the storage locations, by code.
#[must_use]
pub fn locations(analysis: &Analysis, semantic: &SemanticMap) -> Vec<Location> {
    let faces: Vec<FaceId> = analysis.subdivision.faces().filter(|&face| semantic.label(face).is_storage()).collect();
    let accesses: Vec<Access> = faces.iter().map(|&face| Access::of(face, analysis, semantic)).collect();
    let slots = aisles::number(semantic, &accesses);
    let codes = Codes::for_slots(&slots);
    let mut locations: Vec<Location> = accesses
        .into_iter()
        .zip(slots)
        .map(|(access, slot)| {
            let annotation = &analysis.faces[access.face.index()];
            Location {
                code: codes.of(slot),
                face: access.face,
                label: semantic.labels[access.face.index()],
                aisle: slot.aisle,
                bay: slot.bay,
                side: slot.side,
                center: access.center,
                width: access.width,
                depth: access.depth,
                heading: access.heading,
                occupancy: occupancy(annotation),
                access_from: access.best.map(|best| best.from),
                approach: access.best.map(|best| best.approach),
                access_edges: access.edges,
            }
        })
        .collect();
    locations.sort_by_key(|location| (location.aisle, location.bay));
    locations
}
