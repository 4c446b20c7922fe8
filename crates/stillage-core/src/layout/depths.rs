//! Which places lie behind others: the second place of a drive-in lane, and so on.
//!
//! Method: from every place that is reached from an aisle, straight on in its heading, place by place. Cost: O(edges).
//! Limits: a place behind two others belongs to the one whose middle it continues best.

use std::collections::BTreeMap;

use super::draft::Draft;
use crate::arrangement::FaceId;
use crate::geometry::{Point, direction, normal};
use crate::site_map::SiteMap;

/// How a location lies in its row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct DepthInRow {
    /// 1 at the aisle, 2 behind that, and so on.
    pub number: u32,
    /// Index of the location at the aisle: itself for the first.
    pub first: usize,
}

/// Finds the depth of every location; `None` for those that no aisle leads to. Places behind others take their heading,
/// width and depth along it.
pub(super) fn depths(map: &SiteMap<'_>, drafts: &mut [Draft]) -> Vec<Option<DepthInRow>> {
    let mut of_face: BTreeMap<FaceId, Vec<usize>> = BTreeMap::new();
    for (index, draft) in drafts.iter().enumerate() {
        of_face.entry(draft.face).or_default().push(index);
    }
    let mut found: Vec<Option<DepthInRow>> = drafts
        .iter()
        .enumerate()
        .map(|(index, draft)| draft.front.is_some().then_some(DepthInRow { number: 1, first: index }))
        .collect();
    let mut open: Vec<usize> = (0..drafts.len()).filter(|&index| found[index].is_some()).collect();
    while !open.is_empty() {
        // (offset from the middle of the place in front, place behind, place in front)
        let mut claims: Vec<(f64, usize, usize)> = Vec::new();
        for &front in &open {
            let behind = map.analysis.graph.links(drafts[front].face).iter().filter_map(|(_, face)| of_face.get(face));
            for &index in behind.flatten().filter(|&&index| found[index].is_none()) {
                claims.extend(offset_behind(&drafts[front], &drafts[index]).map(|offset| (offset, index, front)));
            }
        }
        claims.sort_by(|first, second| {
            first.0.total_cmp(&second.0).then(first.1.cmp(&second.1)).then(first.2.cmp(&second.2))
        });
        open.clear();
        for (_, index, front) in claims {
            let Some(before) = found[front].filter(|_| found[index].is_none()) else { continue };
            found[index] = Some(DepthInRow { number: before.number + 1, first: before.first });
            turn(drafts, index, drafts[front].heading);
            open.push(index);
        }
    }
    found
}

/// How far the middle of a place is aside of the way into another; `None` when it does not lie behind it.
fn offset_behind(front: &Draft, behind: &Draft) -> Option<f64> {
    let step = behind.center - front.center;
    let (ahead, aside) = (direction(front.heading).dot(&step), normal(front.heading).dot(&step).abs());
    (ahead > front.depth / 4.0 && aside < front.width / 2.0).then_some(aside)
}

/// Gives a place another heading.
fn turn(drafts: &mut [Draft], index: usize, heading: f64) {
    let extent = |axis: crate::geometry::Vector, outline: &[Point]| {
        let places = outline.iter().map(|point| axis.dot(&point.coords));
        places.clone().fold(f64::NEG_INFINITY, f64::max) - places.fold(f64::INFINITY, f64::min)
    };
    let draft = &mut drafts[index];
    draft.heading = heading;
    draft.width = extent(normal(heading), &draft.outline).max(0.0);
    draft.depth = extent(direction(heading), &draft.outline).max(0.0);
}
