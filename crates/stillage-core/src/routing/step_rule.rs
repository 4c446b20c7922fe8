//! The rule of a path's steps: over free cells of drivable faces, and from face to face over drivable links only.
//!
//! Source: the connectivity of links C(l) in the paper's section II-C, applied to cells.
//! Cost: O(edges log edges) to set up; a step costs two array reads within a face, a binary search between faces,
//! O(boundary) where a face thinner than a cell lies between them.
//! Limits: two faces that share a drivable edge somewhere are taken to share it wherever their cells touch.

use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::{Point, segment};
use crate::grid::Occupancy;
use crate::site_map::SiteMap;

/// The rule of a path's steps. Cells are indices, row-major, lowest row first.
pub(super) struct StepRule<'a> {
    map: SiteMap<'a>,
    drivable: Vec<bool>,
    /// Pairs of faces joined by a drivable link, both ways round, ascending.
    joined: Vec<(FaceId, FaceId)>,
}

impl<'a> StepRule<'a> {
    pub fn new(map: SiteMap<'a>) -> Self {
        let subdivision = &map.analysis.subdivision;
        let mut drivable: Vec<bool> =
            map.semantic.labels.iter().map(|&label| map.semantic.rule_set.label(label).is_drivable()).collect();
        if let Some(outer) = drivable.first_mut() {
            *outer = false;
        }
        let mut joined: Vec<(FaceId, FaceId)> = subdivision
            .edges()
            .map(|edge| (edge, subdivision.sides(edge)))
            .filter(|&(edge, sides)| map.semantic.is_drivable_link(edge, sides))
            .flat_map(|(_, [left, right])| [(left, right), (right, left)])
            .collect();
        joined.sort_unstable();
        joined.dedup();
        Self { map, drivable, joined }
    }

    pub fn width(&self) -> usize {
        self.map.grid.width()
    }

    /// Centre of a cell, metres.
    pub fn center(&self, cell: usize) -> Point {
        self.map.grid.center(cell % self.width(), cell / self.width())
    }

    pub fn resolution(&self) -> f64 {
        self.map.grid.resolution()
    }

    pub fn face(&self, cell: usize) -> FaceId {
        self.map.cells.as_slice()[cell]
    }

    /// Whether a path may pass from a cell that it may be on to one beside it.
    pub fn allows(&self, from: usize, to: usize) -> bool {
        if self.map.grid.cells()[to] != Occupancy::Free {
            return false;
        }
        // A path begins on a drivable face, so within a face no label is read.
        let (before, behind) = (self.face(from), self.face(to));
        before == behind
            || self.drivable[behind.index()] && (self.joins(before, behind) || self.crossings(from, to).is_some())
    }

    /// Whether a path may pass from a cell to a diagonal neighbour: around both sides of the corner between them.
    pub fn allows_corner(&self, from: usize, beside: [usize; 2], to: usize) -> bool {
        beside.into_iter().all(|side| self.allows(from, side) && self.allows(side, to))
    }

    fn joins(&self, before: FaceId, behind: FaceId) -> bool {
        self.joined.binary_search(&(before, behind)).is_ok()
    }

    /// The faces that drivable links join with one, by face id.
    pub fn reachable_faces(&self, from: FaceId) -> Vec<bool> {
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
        reached
    }

    /// The edges crossed between the centres of two neighbouring cells, each with the face behind it; `None` where
    /// one of them is no drivable link.
    pub fn crossings(&self, from: usize, to: usize) -> Option<Vec<(EdgeId, FaceId)>> {
        let (before, behind) = (self.face(from), self.face(to));
        if before == behind {
            return Some(Vec::new());
        }
        let (start, end) = (self.center(from), self.center(to));
        if self.joins(before, behind) {
            let edge = self.nearest_edge(before, behind, nalgebra::center(&start, &end))?;
            return Some(vec![(edge, behind)]);
        }
        self.walk(before, behind, start, end)
    }

    /// Walks straight from a point of one face to a point of another.
    fn walk(&self, before: FaceId, behind: FaceId, start: Point, end: Point) -> Option<Vec<(EdgeId, FaceId)>> {
        // In shares of the way: two crossings this near to each other pass through the same vertex.
        const SAME_CROSSING: f64 = 1e-9;
        let subdivision = &self.map.analysis.subdivision;
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
            if !self.joins(face, next) {
                return None;
            }
            crossed.push((half.edge(), next));
            (face, gone) = (next, share);
        }
        Some(crossed)
    }

    /// The edge between two faces that comes closest to a point.
    fn nearest_edge(&self, before: FaceId, behind: FaceId, point: Point) -> Option<EdgeId> {
        let links = self.map.analysis.graph.links(before).iter().filter(|link| link.1 == behind);
        let distance = |edge: EdgeId| segment::distance(point, self.map.analysis.subdivision.segment(edge));
        links.map(|&(edge, _)| edge).min_by(|&first, &second| distance(first).total_cmp(&distance(second)))
    }
}
