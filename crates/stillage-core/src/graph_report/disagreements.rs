//! Borders between drivable faces where labels and obstacles disagree.
//!
//! All edges between two faces are one border. It is closed where no point of it keeps the vehicle's radius from
//! obstacles. Borders shorter than the vehicle is wide do not count: nothing passes there whatever the labels say. (The
//! disagreements of [`SemanticMap`](crate::semantics::SemanticMap) are told edge by edge from the cells along it, for any
//! labels and without a vehicle.) Cost: O(length of the borders / cell).

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::Point;
use crate::site_map::SiteMap;

/// How labels and obstacles disagree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkDisagreementKind {
    /// The rules call the faces connected, but obstacles close the border to the vehicle.
    ConnectedButClosed,
    /// The rules call the faces disconnected, but the vehicle could cross the border.
    DisconnectedButOpen,
}

/// A border between two drivable faces where labels and obstacles disagree.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkDisagreement {
    /// The faces, ascending.
    pub faces: [FaceId; 2],
    /// The edges between them, ascending.
    pub edges: Vec<EdgeId>,
    /// How they disagree.
    pub kind: LinkDisagreementKind,
    /// Length of the edges, metres.
    pub length: f64,
    /// Width of the widest vehicle that could cross it, metres.
    pub width: f64,
    /// Where that is, grid frame, metres.
    pub at: Point,
}

/// The borders where labels and obstacles disagree for vehicles of a radius in metres, by faces.
pub(super) fn disagreements(map: &SiteMap<'_>, radius: f64) -> Vec<LinkDisagreement> {
    let subdivision = &map.analysis.subdivision;
    let mut borders: BTreeMap<[FaceId; 2], Vec<EdgeId>> = BTreeMap::new();
    for edge in subdivision.edges() {
        let mut sides = subdivision.sides(edge);
        if sides[0] != sides[1] && sides.iter().all(|&side| map.is_drivable(side)) {
            sides.sort_unstable();
            borders.entry(sides).or_default().push(edge);
        }
    }
    let borders: Vec<([FaceId; 2], Vec<EdgeId>)> = borders.into_iter().collect();
    let disagreement = |(faces, edges): &([FaceId; 2], Vec<EdgeId>)| {
        let length: f64 = edges.iter().map(|&edge| subdivision.length(edge)).sum();
        let widest = edges.iter().map(|&edge| widest_point(map, edge));
        let (clearance, at) = widest.reduce(|best, other| if other.0 > best.0 { other } else { best })?;
        let is_connected = edges.iter().any(|&edge| map.semantic.is_drivable_link(edge, *faces));
        let kind = match (is_connected, clearance >= radius) {
            (true, false) if length >= 2.0 * radius => LinkDisagreementKind::ConnectedButClosed,
            (false, true) => LinkDisagreementKind::DisconnectedButOpen,
            _ => return None,
        };
        Some(LinkDisagreement { faces: *faces, edges: edges.clone(), kind, length, width: 2.0 * clearance, at })
    };
    borders.par_iter().filter_map(disagreement).collect()
}

/// The largest clearance along an edge, metres, and where it is.
fn widest_point(map: &SiteMap<'_>, edge: EdgeId) -> (f64, Point) {
    let [start, end] = map.analysis.subdivision.segment(edge);
    let steps = ((end - start).norm() / map.grid.resolution()).ceil().max(1.0) as usize;
    let points = (0..=steps).map(|step| start + (end - start) * (step as f64 / steps as f64));
    let widest = points.map(|point| (map.clearance.at(point), point));
    widest.reduce(|best, other| if other.0 > best.0 { other } else { best }).unwrap_or((0.0, start))
}
