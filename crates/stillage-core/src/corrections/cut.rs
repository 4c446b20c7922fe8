//! Faces that people cut or join.

use std::collections::{BTreeMap, BTreeSet};

use super::draft::{Draft, FaceClaim};
use super::failure::Failure;
use super::snap::Snap;
use crate::arrangement::FaceId;
use crate::geometry::{DisjointSets, Point};

/// Cuts the faces that a line crosses.
pub(super) fn split(draft: &mut Draft<'_>, line: &[Point], correction: u32) -> Result<(), Failure> {
    draft.settle()?;
    let snap = Snap::near(draft.pieces(), line, draft.tolerance);
    let line: Vec<Point> = line.iter().map(|&point| snap.point(point)).collect();
    let segments: Vec<[Point; 2]> = line.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let mut pieces = draft.pieces().clone();
    pieces.draw(&segments, &draft.watch)?;
    let cut = pieces.subdivision(&draft.watch)?;
    if cut.face_count() <= draft.subdivision.face_count() {
        let message = "the line cuts no face in two: draw it on until it meets the border of a face at both ends";
        return Err(Failure::unfit("/line", message));
    }
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

/// Makes the faces at some points one.
pub(super) fn merge(draft: &mut Draft<'_>, at: &[Point], correction: u32) -> Result<(), Failure> {
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
    let inner = |edge| draft.subdivision.sides(edge).iter().all(|side| set.contains(side));
    let joined = draft.subdivision.dissolve(inner, &draft.watch)?;
    draft.adopt(joined, |face| if set.contains(&face) { heir } else { face })?;
    Ok(())
}
