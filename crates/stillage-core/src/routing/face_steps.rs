//! The rule of a path's steps from face to face: over links that may be driven only.
//!
//! Source: the connectivity of links C(l) in the paper's section II-C, applied to cells.
//! Cost: O(edges log edges) to set up; a step costs two array reads within a face, a binary search between faces,
//! O(boundary) where a face thinner than a cell lies between them.
//! Limits: two faces that share a drivable edge somewhere are taken to share it wherever their cells touch, except along
//! edges that are blocked or that people shut.

use std::collections::BTreeSet;

use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::{Point, segment};
use crate::site_map::SiteMap;

/// What a request keeps routes off.
#[derive(Debug, Clone, Default, PartialEq, Eq, Hash)]
pub struct Blocked {
    /// Faces that may not be driven on.
    pub faces: BTreeSet<FaceId>,
    /// Edges that may not be crossed.
    pub edges: BTreeSet<EdgeId>,
}

impl Blocked {
    /// Whether nothing is blocked.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty() && self.edges.is_empty()
    }
}

/// The rule of a path's steps. Cells are indices, row-major, lowest row first.
#[derive(Debug, Clone)]
pub(super) struct FaceSteps {
    drivable: Vec<bool>,
    /// Pairs of faces joined by a drivable link, both ways round, ascending.
    joined: Vec<(FaceId, FaceId)>,
    /// Edges that a request or a person blocks.
    blocked: BTreeSet<EdgeId>,
    /// Steps lead over any edge.
    crosses_all: bool,
}

impl FaceSteps {
    pub fn new(map: &SiteMap<'_>, blocked: &Blocked) -> Self {
        let subdivision = &map.analysis.subdivision;
        let drivable: Vec<bool> = (0..map.semantic.labels.len() as u32)
            .map(|face| map.is_drivable(FaceId(face)) && !blocked.faces.contains(&FaceId(face)))
            .collect();
        let mut joined: Vec<(FaceId, FaceId)> = subdivision
            .edges()
            .filter(|edge| !blocked.edges.contains(edge))
            .map(|edge| (edge, subdivision.sides(edge)))
            .filter(|&(edge, sides)| map.semantic.is_drivable_link(edge, sides))
            .filter(|(_, sides)| sides.iter().all(|side| drivable[side.index()]))
            .flat_map(|(_, [left, right])| [(left, right), (right, left)])
            .collect();
        joined.sort_unstable();
        joined.dedup();
        let passages = &map.analysis.rooms.passages;
        let shut = passages.iter().filter(|(_, is_open)| !**is_open).map(|(&edge, _)| edge);
        Self { drivable, joined, blocked: blocked.edges.iter().copied().chain(shut).collect(), crosses_all: false }
    }

    /// The rule where labels do not matter, except that goods may stand in storage: how a vehicle gets off ground that is
    /// not drivable.
    pub fn over_all_floor(map: &SiteMap<'_>, blocked: &Blocked) -> Self {
        let is_floor = |face: FaceId| {
            face != FaceId::OUTER && !map.semantic.label(face).is_storage() && !blocked.faces.contains(&face)
        };
        let drivable = (0..map.semantic.labels.len() as u32).map(|face| is_floor(FaceId(face))).collect();
        Self { drivable, joined: Vec::new(), blocked: BTreeSet::new(), crosses_all: true }
    }

    /// Whether a path may lie on a face.
    pub fn is_drivable(&self, face: FaceId) -> bool {
        self.drivable[face.index()]
    }

    /// Whether drivable links join two faces, over others if need be.
    pub fn are_connected(&self, from: FaceId, to: FaceId) -> bool {
        let mut reached = vec![false; self.drivable.len()];
        reached[from.index()] = true;
        let mut waiting = vec![from];
        while let Some(face) = waiting.pop() {
            let first = self.joined.partition_point(|pair| pair.0 < face);
            for &(_, behind) in self.joined[first..].iter().take_while(|pair| pair.0 == face) {
                if !std::mem::replace(&mut reached[behind.index()], true) {
                    waiting.push(behind);
                }
            }
        }
        reached[to.index()]
    }

    /// Whether a path may pass from a cell to one beside it, both on drivable faces.
    pub fn allows(&self, map: &SiteMap<'_>, from: usize, to: usize) -> bool {
        let [before, behind] = [from, to].map(|cell| map.cells.of_cell(cell));
        before == behind
            || self.crosses_all
            || self.blocked.is_empty() && self.joins(before, behind)
            || self.crossings(map, from, to).is_some()
    }

    fn joins(&self, before: FaceId, behind: FaceId) -> bool {
        self.joined.binary_search(&(before, behind)).is_ok()
    }

    /// The edges crossed between the centres of two neighbouring cells, each with the face behind it; `None` where
    /// one of them may not be crossed.
    pub fn crossings(&self, map: &SiteMap<'_>, from: usize, to: usize) -> Option<Vec<(EdgeId, FaceId)>> {
        let [before, behind] = [from, to].map(|cell| map.cells.of_cell(cell));
        if before == behind {
            return Some(Vec::new());
        }
        let [start, end] = centers(map, [from, to]);
        if self.joins(before, behind) {
            let edge = nearest_edge(map, before, behind, nalgebra::center(&start, &end))?;
            return (!self.blocked.contains(&edge)).then(|| vec![(edge, behind)]);
        }
        let crossed = walk(map, before, behind, [start, end])?;
        let sides = std::iter::once(before).chain(crossed.iter().map(|&(_, face)| face)).zip(&crossed);
        let is_allowed =
            |(from, &(edge, to)): (FaceId, &(EdgeId, FaceId))| self.joins(from, to) && !self.blocked.contains(&edge);
        sides.into_iter().all(is_allowed).then_some(crossed)
    }

    /// The edges crossed between the centres of two neighbouring cells, whether they may be crossed or not.
    pub fn crossings_of_any(&self, map: &SiteMap<'_>, from: usize, to: usize) -> Vec<(EdgeId, FaceId)> {
        self.crossings(map, from, to).unwrap_or_else(|| {
            let [before, behind] = [from, to].map(|cell| map.cells.of_cell(cell));
            walk(map, before, behind, centers(map, [from, to])).unwrap_or_default()
        })
    }
}

fn centers(map: &SiteMap<'_>, cells: [usize; 2]) -> [Point; 2] {
    let width = map.grid.width();
    cells.map(|cell| map.grid.center(cell % width, cell / width))
}

/// Walks straight from a point of one face to a point of another: the edges crossed, each with the face behind it.
fn walk(map: &SiteMap<'_>, before: FaceId, behind: FaceId, [start, end]: [Point; 2]) -> Option<Vec<(EdgeId, FaceId)>> {
    // In shares of the way: two crossings this near to each other pass through the same vertex.
    const SAME_CROSSING: f64 = 1e-9;
    let subdivision = &map.analysis.subdivision;
    let way = end - start;
    let (mut face, mut gone, mut crossed) = (before, 0.0, Vec::new());
    while face != behind {
        let exits = subdivision.boundary(face).filter_map(|half| {
            let [share, on_edge] = segment::crossing(start, way, subdivision.segment(half.edge()));
            let hit = share > gone + SAME_CROSSING && share <= 1.0 && (0.0..=1.0).contains(&on_edge);
            hit.then_some((share, half))
        });
        let (share, half) = exits.min_by(|first, second| first.0.total_cmp(&second.0))?;
        let next = subdivision.half_edge(half.twin()).face;
        crossed.push((half.edge(), next));
        (face, gone) = (next, share);
    }
    Some(crossed)
}

/// The edge between two faces that comes closest to a point.
fn nearest_edge(map: &SiteMap<'_>, before: FaceId, behind: FaceId, point: Point) -> Option<EdgeId> {
    let links = map.analysis.graph.links(before).iter().filter(|link| link.1 == behind);
    let distance = |edge: EdgeId| segment::distance(point, map.analysis.subdivision.segment(edge));
    links.map(|&(edge, _)| edge).min_by(|&first, &second| distance(first).total_cmp(&distance(second)))
}
