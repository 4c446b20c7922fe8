//! Faces that people cut or join.

use std::collections::{BTreeMap, BTreeSet};

use super::draft::{FaceClaim, MapDraft};
use super::failure::Failure;
use super::snap::Snap;
use crate::arrangement::{FaceId, Subdivision};
use crate::geometry::{Bounds, DisjointSets, Point, segment};
use crate::watch::Stopped;

/// How far a line that cuts nothing is drawn on to the next border, metres: half of a narrow aisle.
const OVERSHOOT_M: f64 = 1.0;

/// Cuts the faces that a line crosses.
pub(super) fn split(draft: &mut MapDraft<'_>, line: &[Point], correction: u32) -> Result<(), Failure> {
    draft.settle()?;
    let snap = Snap::near(draft.pieces(), draft.bounds, line, draft.tolerance);
    let line: Vec<Point> = line.iter().map(|&point| snap.point(point)).collect();
    let cut = match cut_along(draft, &line)? {
        None => cut_along(draft, &drawn_on(draft, line))?,
        cut => cut,
    };
    let Some(cut) = cut else {
        let message = "the line cuts no face in two: draw it on until it meets the border of a face at both ends";
        return Err(Failure::unfit("/line", message));
    };
    let origins = draft.adopt(cut, |face| face)?;
    let mut parts: BTreeMap<FaceId, Vec<usize>> = BTreeMap::new();
    for (face, origin) in origins.into_iter().enumerate() {
        if let Some(origin) = origin.filter(|&origin| origin != FaceId::OUTER) {
            parts.entry(origin).or_default().push(face);
        }
    }
    // Faces beside the line's ends got a vertex more, but are whole.
    for face in parts.into_values().filter(|parts| parts.len() > 1).flatten() {
        draft.claims[face].touch(correction);
    }
    Ok(())
}

/// The arrangement with a line; `None` where it cuts no face.
fn cut_along(draft: &MapDraft<'_>, line: &[Point]) -> Result<Option<Subdivision>, Stopped> {
    let segments: Vec<[Point; 2]> = line.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let mut pieces = draft.pieces().clone();
    pieces.draw(&segments, &draft.watch)?;
    let cut = pieces.subdivision(&draft.watch)?;
    Ok((cut.face_count() > draft.subdivision.face_count()).then_some(cut))
}

/// A line whose ends are drawn on to the next border, where one is near ahead.
fn drawn_on(draft: &MapDraft<'_>, mut line: Vec<Point>) -> Vec<Point> {
    let edges = draft.pieces().near(&Bounds::around(&line).grown(OVERSHOOT_M));
    for _ in 0..2 {
        line.reverse();
        let [.., before, end] = line.as_slice() else { continue };
        let Some(ahead) = (end - before).try_normalize(0.0) else { continue };
        let distances = edges.iter().filter_map(|&edge| {
            let [distance, share] = segment::crossing(*end, ahead, edge);
            ((0.0..=OVERSHOOT_M).contains(&distance) && (0.0..=1.0).contains(&share)).then_some(distance)
        });
        // What lies beyond a border that it meets is dropped: a step too far loses nothing, one too short everything.
        if let Some(distance) = distances.reduce(f64::min) {
            line.push(end + ahead * (distance + draft.tolerance));
        }
    }
    line
}

/// Makes the faces at some points one.
pub(super) fn merge(draft: &mut MapDraft<'_>, at: &[Point], correction: u32) -> Result<(), Failure> {
    let mut members = Vec::with_capacity(at.len());
    for (number, &point) in at.iter().enumerate() {
        members.push(draft.face_at(point, &format!("/at/{number}"))?);
    }
    let set: BTreeSet<FaceId> = members.iter().copied().collect();
    if set.len() < 2 {
        return Err(Failure::unfit("/at", "all these points lie in one face already"));
    }
    let mut sets = DisjointSets::new(draft.subdivision.face_count());
    for edge in draft.subdivision.edges() {
        let [left, right] = draft.subdivision.sides(edge);
        if set.contains(&left) && set.contains(&right) {
            sets.join(left.index(), right.index());
        }
    }
    let root = sets.find(members[0].index());
    if let Some(apart) = members.iter().position(|member| sets.find(member.index()) != root) {
        let message = "the face at this point shares no border with the others: name points in the faces between, too";
        return Err(Failure::unfit(format!("/at/{apart}"), message));
    }
    let heir = members[0];
    let first = |said: fn(&FaceClaim) -> &Option<String>| {
        members.iter().find_map(|member| said(&draft.claims[member.index()]).clone())
    };
    let (label, name) = (first(|claim| &claim.label), first(|claim| &claim.name));
    let mut corrections: Vec<u32> =
        set.iter().flat_map(|member| draft.claims[member.index()].corrections.iter().copied()).collect();
    corrections.sort_unstable();
    corrections.dedup();
    corrections.push(correction);
    let claim = &mut draft.claims[heir.index()];
    (claim.label, claim.name, claim.corrections) = (label, name, corrections);
    // The cells of all of them vote.
    claim.category_of = None;
    let inner = |edge| draft.subdivision.sides(edge).iter().all(|side| set.contains(side));
    let joined = draft.subdivision.dissolve(inner, &draft.watch)?;
    draft.adopt(joined, |face| if set.contains(&face) { heir } else { face })?;
    Ok(())
}
