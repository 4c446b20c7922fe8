//! Gates: where vehicles drive from one face to another. Cost: O(samples along the edges between drivable faces).

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::{DisjointSets, Point};
use crate::site_map::SiteMap;

/// The gates between drivable faces: the faces on both sides, and the middle of the widest free stretch of each border that
/// they share. Two faces share several where they meet at several places.
pub(super) fn gates(map: &SiteMap<'_>, radius: f64) -> Vec<([FaceId; 2], Point)> {
    let subdivision = &map.analysis.subdivision;
    let mut shared: BTreeMap<[FaceId; 2], Vec<EdgeId>> = BTreeMap::new();
    for edge in subdivision.edges() {
        let mut sides = subdivision.sides(edge);
        if map.semantic.is_drivable_link(edge, sides) && !sides.contains(&FaceId::OUTER) {
            sides.sort_unstable();
            shared.entry(sides).or_default().push(edge);
        }
    }
    let borders: Vec<([FaceId; 2], Vec<EdgeId>)> = shared
        .into_iter()
        .flat_map(|(sides, edges)| connected_borders(map, &edges).into_iter().map(move |border| (sides, border)))
        .collect();
    let gate = |(sides, edges): &([FaceId; 2], Vec<EdgeId>)| {
        let best = edges.iter().filter_map(|&edge| widest_stretch(map, edge, radius));
        best.max_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, point)| (*sides, point))
    };
    borders.par_iter().filter_map(gate).collect()
}

/// Edges by the borders that they make: those that meet at a vertex belong together.
fn connected_borders(map: &SiteMap<'_>, edges: &[EdgeId]) -> Vec<Vec<EdgeId>> {
    let mut sets = DisjointSets::new(edges.len());
    let mut at_vertex = BTreeMap::new();
    for (index, &edge) in edges.iter().enumerate() {
        for vertex in map.analysis.subdivision.ends(edge) {
            sets.join(*at_vertex.entry(vertex).or_insert(index), index);
        }
    }
    let mut borders: BTreeMap<usize, Vec<EdgeId>> = BTreeMap::new();
    for (index, &edge) in edges.iter().enumerate() {
        borders.entry(sets.find(index)).or_default().push(edge);
    }
    borders.into_values().collect()
}

/// The longest stretch of an edge on which a vehicle fits: its length, and the middle of the cell at its middle.
fn widest_stretch(map: &SiteMap<'_>, edge: EdgeId, radius: f64) -> Option<(f64, Point)> {
    let [start, end] = map.analysis.subdivision.segment(edge);
    let steps = ((end - start).norm() / map.grid.resolution()).ceil().max(1.0) as usize;
    let at = |step: usize| start + (end - start) * (step as f64 / steps as f64);
    let fits = |step: usize| map.clearance.at(at(step)) >= radius;
    let (mut best, mut begun): (Option<(usize, usize)>, Option<usize>) = (None, None);
    for step in 0..=steps + 1 {
        match (step <= steps && fits(step), begun) {
            (true, None) => begun = Some(step),
            (false, Some(from)) => {
                if best.is_none_or(|(first, last)| step - from > last - first) {
                    best = Some((from, step));
                }
                begun = None;
            }
            _ => {}
        }
    }
    let (first, last) = best?;
    let (column, row) = map.grid.cell_at(at(usize::midpoint(first, last - 1)))?;
    Some((map.grid.resolution() * (last - first) as f64, map.grid.center(column, row)))
}
