//! The corrected analysis: what was redrawn is annotated anew, all else keeps what is known of it.

use std::collections::BTreeMap;

use super::check::CorrectionProblem;
use super::draft::{MapDraft, Said};
use super::outcome::{Corrected, Outcome};
use super::passage;
use crate::adjacency::AdjacencyGraph;
use crate::analysis::Analysis;
use crate::annotation::{self, FaceAnnotation, Redrawn};
use crate::arrangement::{CellFaces, EdgeId, FaceId, KeptParts};
use crate::geometry::Point;
use crate::grid::OccupancyGrid;
use crate::plot::PlotKind;
use crate::rooms::{Door, RoomMap};
use crate::watch::Stopped;

/// Puts the corrected analysis together; `problems` by correction, of those that did not fit.
pub(super) fn assemble(
    grid: &OccupancyGrid,
    analysis: &Analysis,
    cells: &CellFaces,
    draft: MapDraft<'_>,
    problems: Vec<Option<CorrectionProblem>>,
) -> Result<Corrected, Stopped> {
    let (mut analysis, cell_faces) = if draft.subdivision == analysis.subdivision {
        (analysis.clone(), cells.clone())
    } else {
        redrawn(grid, analysis, cells, &draft)?
    };
    let mut faces_of: BTreeMap<u32, Vec<FaceId>> = BTreeMap::new();
    for mark in &draft.doors {
        let edges = passage::edges_along(&draft.subdivision, mark.line);
        let sides = edges.iter().flat_map(|&edge| draft.subdivision.sides(edge));
        faces_of.entry(mark.correction).or_default().extend(sides);
        mark_door(&mut analysis.rooms, mark.line, mark.is_open, edges, &draft);
    }
    let (mut labels, mut names) = (BTreeMap::new(), BTreeMap::new());
    for (face, claim) in (0..).map(FaceId).zip(&draft.claims) {
        labels.extend(claim.label.clone().map(|label| (face, label)));
        names.extend(claim.name.clone().map(|name| (face, name)));
        claim.corrections.iter().for_each(|correction| faces_of.entry(*correction).or_default().push(face));
    }
    let outcome = |(number, problem): (u32, Option<CorrectionProblem>)| {
        let mut faces = faces_of.remove(&number).unwrap_or_default();
        faces.sort_unstable();
        faces.dedup();
        problem.map_or(Outcome::Applied { faces }, Outcome::Unfit)
    };
    let outcomes = (0..).zip(problems).map(outcome).collect();
    let said = Said { claims: draft.claims, doors: draft.doors };
    Ok(Corrected { analysis, faces: cell_faces, labels, names, outcomes, said })
}

/// The analysis of another arrangement, and the face of every cell.
fn redrawn(
    grid: &OccupancyGrid,
    analysis: &Analysis,
    cells: &CellFaces,
    draft: &MapDraft<'_>,
) -> Result<(Analysis, CellFaces), Stopped> {
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
        } else if let Some(of) = claim.category_of {
            let FaceAnnotation { category, category_shares, membership, confidence, .. } = &analysis.faces[of.index()];
            (face.category, face.confidence) = (*category, *confidence);
            (face.category_shares, face.membership) = (category_shares.clone(), membership.clone());
        }
    }
    let has_rooms = !analysis.rooms.faces.is_empty();
    let rooms = if has_rooms { draft.claims.iter().map(|claim| claim.room).collect() } else { Vec::new() };
    let rooms = analysis.rooms.redrawn(&subdivision, rooms);
    Ok((Analysis { subdivision, graph, rooms, faces: annotations, edges, ..analysis.clone() }, faces))
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

/// Gives a face the category that a person meant.
fn give_category(face: &mut FaceAnnotation, category: u8) {
    face.category = category;
    face.confidence = 1.0;
    face.membership = None;
    for (share, of) in face.category_shares.iter_mut().zip(0..) {
        *share = f32::from(u8::from(of == category));
    }
}

/// Makes edges a door, or shuts them; doors that were found there give way.
fn mark_door(rooms: &mut RoomMap, ends: [Point; 2], is_open: bool, edges: Vec<EdgeId>, draft: &MapDraft<'_>) {
    rooms.doors.retain(|door| !door.edges.iter().any(|edge| edges.binary_search(edge).is_ok()));
    rooms.passages.extend(edges.iter().map(|&edge| (edge, is_open)));
    if let Some(&first) = edges.first().filter(|_| is_open) {
        rooms.doors.push(Door { ends, faces: draft.subdivision.sides(first), edges });
    }
}
