//! Faces that people take away: their ground joins that around them.
//!
//! A face goes when most of its area lies in the polygon. It joins the neighbour with which it shares most of its border;
//! a place only where nothing else is beside it, since what was no rack is floor. The whole has the category of that
//! neighbour, however large what went was. Where no face goes, the borders that lie
//! wholly in the polygon do: a line across a floor. The unbounded face is no neighbour. Cost: O(edges), and the area that
//! the faces near the polygon have in common with it.

use std::collections::{BTreeMap, BTreeSet};

use super::draft::MapDraft;
use super::failure::Failure;
use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::common_area::common_area;
use crate::geometry::{Bounds, DisjointSets, Point, polygon, segment};
use crate::plot::PlotKind;

/// Share of the area of a face in the polygon above which the face goes: the majority.
const MAJORITY: f64 = 0.5;

/// Takes away what lies in a polygon, counter-clockwise.
pub(super) fn erase(draft: &mut MapDraft<'_>, ring: &[Point], correction: u32) -> Result<(), Failure> {
    draft.settle()?;
    let mut sets = DisjointSets::new(draft.subdivision.face_count());
    let erased = faces_inside(draft, ring);
    let hosts = if erased.is_empty() { Vec::new() } else { join_neighbours(draft, &erased, &mut sets) };
    if !erased.is_empty() && hosts.is_empty() {
        return Err(Failure::unfit(
            "/ring",
            "what lies in the polygon has no other ground around it that it could join",
        ));
    }
    if erased.is_empty() {
        let borders = borders_inside(draft, ring);
        if borders.is_empty() {
            let message =
                "nothing to erase: no face lies in the polygon for most of its area, and no border lies wholly in it";
            return Err(Failure::unfit("/ring", message));
        }
        for edge in borders {
            let [left, right] = draft.subdivision.sides(edge).map(FaceId::index);
            sets.join(left, right);
        }
    }
    let roots: Vec<usize> = (0..draft.subdivision.face_count()).map(|face| sets.find(face)).collect();
    let heirs = heirs(draft, &roots, &hosts);
    for heir in heirs.values() {
        let claim = &mut draft.claims[heir.index()];
        claim.touch(correction);
        claim.category_of = claim.category_of.or(claim.origin);
    }
    let inner = |edge| {
        let [left, right] = draft.subdivision.sides(edge).map(FaceId::index);
        roots[left] == roots[right]
    };
    let joined = draft.subdivision.dissolve(inner, &draft.watch)?;
    draft.adopt(joined, |face| heirs.get(&roots[face.index()]).copied().unwrap_or(face))?;
    Ok(())
}

/// The faces that lie in a polygon for most of their area.
fn faces_inside(draft: &MapDraft<'_>, ring: &[Point]) -> BTreeSet<FaceId> {
    let bounds = Bounds::around(ring);
    let window = [ring.to_vec()];
    let is_near = |face: FaceId| {
        let outline = draft.subdivision.cycles(face).first().map(|&start| draft.subdivision.cycle(start));
        let origins = outline.into_iter().flatten().map(|half| draft.subdivision.half_edge(half).origin);
        let corners: Vec<Point> = origins.map(|vertex| draft.subdivision.position(vertex)).collect();
        Bounds::around(&corners).meets(&bounds)
    };
    let is_inside = |&face: &FaceId| {
        is_near(face) && {
            let rings = draft.subdivision.rings(face);
            common_area(&rings, &window) > MAJORITY * polygon::area(&rings)
        }
    };
    draft.subdivision.faces().filter(is_inside).collect()
}

/// Joins each group of faces that go with the neighbour it shares most of its border with; gives these neighbours.
fn join_neighbours(draft: &MapDraft<'_>, erased: &BTreeSet<FaceId>, sets: &mut DisjointSets) -> Vec<FaceId> {
    let subdivision = &draft.subdivision;
    for edge in subdivision.edges() {
        let sides = subdivision.sides(edge);
        if sides.iter().all(|side| erased.contains(side)) {
            sets.join(sides[0].index(), sides[1].index());
        }
    }
    // By group and neighbour: whether it is ground, then the length of the border.
    let mut borders: BTreeMap<usize, BTreeMap<FaceId, f64>> = BTreeMap::new();
    for edge in subdivision.edges() {
        let [left, right] = subdivision.sides(edge);
        for (face, behind) in [(left, right), (right, left)] {
            if erased.contains(&face) && !erased.contains(&behind) && behind != FaceId::OUTER {
                let group = borders.entry(sets.find(face.index())).or_default();
                *group.entry(behind).or_default() += subdivision.length(edge);
            }
        }
    }
    let is_ground = |face: FaceId| draft.claims[face.index()].kind != Some(PlotKind::Place);
    let mut hosts = Vec::new();
    for (group, neighbours) in borders {
        let claims = neighbours.into_iter().map(|(face, length)| (is_ground(face), length, face));
        let best = claims.reduce(|best, other| if (other.0, other.1) > (best.0, best.1) { other } else { best });
        if let Some((.., host)) = best {
            sets.join(group, host.index());
            hosts.push(host);
        }
    }
    hosts
}

/// The edges that lie wholly in a polygon, or within reach of its sides, between two faces.
fn borders_inside(draft: &MapDraft<'_>, ring: &[Point]) -> Vec<EdgeId> {
    let reach = Bounds::around(ring).grown(draft.tolerance);
    let rings = [ring.to_vec()];
    let is_near = |point: Point| polygon::sides(&rings).any(|side| segment::distance(point, side) <= draft.tolerance);
    let is_inside = |point: &Point| reach.contains(*point) && (polygon::contains(&rings, *point) || is_near(*point));
    let lies_inside = |edge: &EdgeId| {
        let [start, end] = draft.subdivision.segment(*edge);
        !draft.subdivision.sides(*edge).contains(&FaceId::OUTER)
            && [start, end, nalgebra::center(&start, &end)].iter().all(is_inside)
    };
    draft.subdivision.edges().filter(lies_inside).collect()
}

/// By set of two faces or more: the face whose claim the whole takes, a neighbour that was joined, or the largest.
fn heirs(draft: &MapDraft<'_>, roots: &[usize], hosts: &[FaceId]) -> BTreeMap<usize, FaceId> {
    let mut members: BTreeMap<usize, Vec<FaceId>> = BTreeMap::new();
    for (face, &root) in (0..).map(FaceId).zip(roots) {
        members.entry(root).or_default().push(face);
    }
    members.retain(|_, members| members.len() > 1);
    let heir = |(root, members): (usize, Vec<FaceId>)| {
        let areas = members.into_iter().map(|face| (hosts.contains(&face), draft.subdivision.area(face), face));
        let best = areas.reduce(|best, other| if (other.0, other.1) > (best.0, best.1) { other } else { best });
        best.map(|(.., face)| (root, face))
    };
    members.into_iter().filter_map(heir).collect()
}
