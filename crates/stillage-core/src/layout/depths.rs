//! Which places lie behind others: the second place of a drive-in lane, and so on.
//!
//! Method: from every place that is reached from an aisle, straight on in its heading, place by place. Where that ends, it
//! goes on over ground that is neither storage nor drivable, and no deeper than the place before it: a gap in the stored
//! goods. Cost: O(edges). Limits: a place behind two others belongs to the one whose middle it continues best.

use std::collections::{BTreeMap, BTreeSet};

use super::draft::Draft;
use crate::arrangement::FaceId;
use crate::geometry::{Point, Vector, direction, normal};
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
    let mut claims = claims_of(map, &of_face, drafts, &found, &open, Between::Border);
    while !open.is_empty() {
        open.clear();
        for (_, index, front) in claims {
            let Some(before) = found[front].filter(|_| found[index].is_none()) else { continue };
            found[index] = Some(DepthInRow { number: before.number + 1, first: before.first });
            turn(drafts, index, drafts[front].heading);
            open.push(index);
        }
        claims = claims_of(map, &of_face, drafts, &found, &open, Between::Border);
        if claims.is_empty() {
            open = (0..drafts.len()).filter(|&index| found[index].is_some()).collect();
            claims = claims_of(map, &of_face, drafts, &found, &open, Between::Gap);
            if claims.is_empty() {
                break;
            }
        }
    }
    found
}

/// What may lie between a place and the next one behind it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Between {
    /// A border.
    Border,
    /// A face that is neither storage nor drivable.
    Gap,
}

/// A place that lies behind another: its offset from the middle of that, metres, its index and that of the other.
type Claim = (f64, usize, usize);

/// The places without a depth that lie behind those in `open`, the best claims first.
fn claims_of(
    map: &SiteMap<'_>,
    of_face: &BTreeMap<FaceId, Vec<usize>>,
    drafts: &[Draft],
    found: &[Option<DepthInRow>],
    open: &[usize],
    between: Between,
) -> Vec<Claim> {
    let beside = |face: FaceId| map.analysis.graph.links(face).iter().map(|&(_, other)| other);
    let is_gap =
        |face: &FaceId| *face != FaceId::OUTER && !map.is_drivable(*face) && !map.semantic.label(*face).is_storage();
    let mut claims: Vec<Claim> = Vec::new();
    for &front in open {
        let face = drafts[front].face;
        let behind: BTreeSet<FaceId> = match between {
            Between::Border => beside(face).collect(),
            Between::Gap => beside(face).filter(is_gap).flat_map(beside).collect(),
        };
        let places = behind.iter().filter_map(|face| of_face.get(face)).flatten();
        for &index in places.filter(|&&index| found[index].is_none()) {
            let offset = offset_behind(&drafts[front], &drafts[index]).filter(|_| {
                between == Between::Border || gap_between(&drafts[front], &drafts[index]) <= drafts[front].depth
            });
            claims.extend(offset.map(|offset| (offset, index, front)));
        }
    }
    claims.sort_by(|first, second| {
        first.0.total_cmp(&second.0).then(first.1.cmp(&second.1)).then(first.2.cmp(&second.2))
    });
    claims
}

/// How much ground lies between two places along the heading of the front one, metres.
fn gap_between(front: &Draft, behind: &Draft) -> f64 {
    let [_, end] = extent(&front.outline, direction(front.heading));
    let [start, _] = extent(&behind.outline, direction(front.heading));
    start - end
}

/// The least and greatest coordinate of an outline along an axis, metres.
fn extent(outline: &[Point], axis: Vector) -> [f64; 2] {
    let places = outline.iter().map(|point| axis.dot(&point.coords));
    [places.clone().fold(f64::INFINITY, f64::min), places.fold(f64::NEG_INFINITY, f64::max)]
}

/// How far the middle of a place is aside of the way into another; `None` when it does not lie behind it.
fn offset_behind(front: &Draft, behind: &Draft) -> Option<f64> {
    let step = behind.center - front.center;
    let (ahead, aside) = (direction(front.heading).dot(&step), normal(front.heading).dot(&step).abs());
    (ahead > front.depth / 4.0 && aside < front.width / 2.0).then_some(aside)
}

/// Gives a place another heading.
fn turn(drafts: &mut [Draft], index: usize, heading: f64) {
    let length = |axis: Vector, outline: &[Point]| {
        let [start, end] = extent(outline, axis);
        (end - start).max(0.0)
    };
    let draft = &mut drafts[index];
    draft.heading = heading;
    draft.width = length(normal(heading), &draft.outline);
    draft.depth = length(direction(heading), &draft.outline);
}
