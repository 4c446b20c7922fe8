//! The corrected analysis: what was redrawn is annotated anew, all else keeps what is known of it.

use std::collections::BTreeMap;

use super::draft::Draft;
use super::outcome::Corrected;
use super::passage;
use crate::adjacency::AdjacencyGraph;
use crate::analysis::Analysis;
use crate::annotation::{self, FaceAnnotation, Redrawn};
use crate::arrangement::{CellFaces, EdgeId, FaceId, KeptParts};
use crate::grid::OccupancyGrid;
use crate::plot::PlotKind;
use crate::rooms::{Door, RoomMap};
use crate::watch::Stopped;

/// The faces that each correction made or touched, by the number of the correction.
pub(super) type FacesOfCorrections = BTreeMap<u32, Vec<FaceId>>;

/// Puts the corrected analysis together, without outcomes.
pub(super) fn assemble(
    grid: &OccupancyGrid,
    analysis: &Analysis,
    cells: &CellFaces,
    draft: Draft<'_>,
) -> Result<(Corrected, FacesOfCorrections), Stopped> {
    let mut corrected = if draft.subdivision == analysis.subdivision {
        let (analysis, faces) = (analysis.clone(), cells.clone());
        Corrected { analysis, faces, labels: BTreeMap::new(), names: BTreeMap::new(), outcomes: Vec::new() }
    } else {
        redrawn(grid, analysis, cells, &draft)?
    };
    let mut faces = FacesOfCorrections::new();
    for mark in &draft.doors {
        let edges = passage::edges_along(&draft.subdivision, mark.line);
        let sides = edges.iter().flat_map(|&edge| draft.subdivision.sides(edge));
        faces.entry(mark.correction).or_default().extend(sides);
        mark_door(&mut corrected.analysis.rooms, mark.line, mark.is_open, edges, &draft);
    }
    for (face, claim) in (0..).map(FaceId).zip(draft.claims) {
        corrected.labels.extend(claim.label.map(|label| (face, label)));
        corrected.names.extend(claim.name.map(|name| (face, name)));
        claim.corrections.iter().for_each(|correction| faces.entry(*correction).or_default().push(face));
    }
    for faces in faces.values_mut() {
        faces.sort_unstable();
        faces.dedup();
    }
    Ok((corrected, faces))
}

fn redrawn(
    grid: &OccupancyGrid,
    analysis: &Analysis,
    cells: &CellFaces,
    draft: &Draft<'_>,
) -> Result<Corrected, Stopped> {
    let (subdivision, watch) = (draft.subdivision.clone(), &draft.watch);
    let kept = KeptParts::between(&analysis.subdivision, &subdivision);
    let faces = CellFaces::of_grid(&subdivision, grid);
    let position = |face: FaceId| kept.faces[face.index()].map(|before| analysis.graph.position(before));
    let graph = AdjacencyGraph::with_positions(&subdivision, position, watch)?;
    let subject = Redrawn {
        grid: &analysis.clutter.taken_from(grid),
        categories: &analysis.categories,
        regions: &analysis.regions,
        subdivision: &subdivision,
        graph: &graph,
        cells: &faces,
        kept: &kept,
        cells_before: cells,
        faces_before: &analysis.faces,
        edges_before: &analysis.edges,
        face_categories: analysis.face_categories,
    };
    let (mut annotations, edges) = annotation::annotate_anew(&subject, &analysis.options.annotation, watch)?;
    let place = category_of_places(analysis);
    for (face, claim) in annotations.iter_mut().zip(&draft.claims).skip(1) {
        face.kind = claim.kind;
        if let Some(category) = place.filter(|_| claim.is_drawn_place) {
            give_category(face, category);
        }
    }
    let has_rooms = !analysis.rooms.faces.is_empty();
    let rooms = if has_rooms { draft.claims.iter().map(|claim| claim.room).collect() } else { Vec::new() };
    let rooms = analysis.rooms.redrawn(&subdivision, rooms);
    let analysis = Analysis { subdivision, graph, rooms, faces: annotations, edges, ..analysis.clone() };
    Ok(Corrected { analysis, faces, labels: BTreeMap::new(), names: BTreeMap::new(), outcomes: Vec::new() })
}

/// The category of most places that were found; `None` where there are none.
fn category_of_places(analysis: &Analysis) -> Option<u8> {
    let mut counts: BTreeMap<u8, usize> = BTreeMap::new();
    for face in analysis.faces.iter().filter(|face| face.kind == Some(PlotKind::Place)) {
        *counts.entry(face.category).or_default() += 1;
    }
    // Of equals the lower one.
    counts.into_iter().reduce(|most, other| if other.1 > most.1 { other } else { most }).map(|(category, _)| category)
}

/// Gives a face a category that a person implied.
fn give_category(face: &mut FaceAnnotation, category: u8) {
    face.category = category;
    face.confidence = 1.0;
    face.membership = None;
    for (share, of) in face.category_shares.iter_mut().zip(0..) {
        *share = f32::from(u8::from(of == category));
    }
}

/// Makes edges a door, or shuts them; doors that were found there give way.
fn mark_door(rooms: &mut RoomMap, ends: [crate::Point; 2], is_open: bool, edges: Vec<EdgeId>, draft: &Draft<'_>) {
    rooms.doors.retain(|door| !door.edges.iter().any(|edge| edges.binary_search(edge).is_ok()));
    rooms.passages.extend(edges.iter().map(|&edge| (edge, is_open)));
    if let Some(&first) = edges.first().filter(|_| is_open) {
        rooms.doors.push(Door { ends, faces: draft.subdivision.sides(first), edges });
    }
}
