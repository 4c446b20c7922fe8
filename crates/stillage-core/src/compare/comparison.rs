//! The places of two maps, side by side.

use std::collections::BTreeMap;

use super::footprint::Footprint;
use super::matching::pairs;
use crate::geometry::Vector;

/// A place whose middle is further from where it was has moved, metres: three cells of a usual map.
const MOVED_M: f64 = 0.15;

/// A place of a map, as far as a comparison needs it.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedPlace {
    /// Its code or id, unique in its map.
    pub code: String,
    /// Its ground, in a frame that both maps share.
    pub footprint: Footprint,
    /// Its label.
    pub label: String,
    /// Whether goods stand there; `None` where that is not known.
    pub occupied: Option<bool>,
}

/// Something that is different about a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PlaceChange {
    /// Its middle is elsewhere.
    Moved,
    /// It has another label.
    Relabelled,
    /// It has another code.
    Recoded,
    /// It was empty and is occupied.
    Filled,
    /// It was occupied and is empty.
    Emptied,
}

/// A place that is in both maps.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaceMatch {
    /// Index among the old places.
    pub old: usize,
    /// Index among the new places.
    pub new: usize,
    /// Area in common as a share of the area of both together; 0 for a place that is known by its code.
    pub share: f64,
    /// From its old middle to its new one, metres.
    pub shift: Vector,
    /// What is different about it, in the order of [`PlaceChange`].
    pub changes: Vec<PlaceChange>,
}

/// Two maps side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Places of both, by index of the old ones.
    pub matched: Vec<PlaceMatch>,
    /// Indices of new places that were not there, ascending.
    pub added: Vec<usize>,
    /// Indices of old places that are no longer there, ascending.
    pub removed: Vec<usize>,
}

/// Compares the places of two maps.
#[must_use]
pub fn compare(old: &[ComparedPlace], new: &[ComparedPlace]) -> Comparison {
    let footprints = |places: &[ComparedPlace]| places.iter().map(|place| place.footprint.clone()).collect::<Vec<_>>();
    let by_ground = pairs(&footprints(old), &footprints(new));
    let mut found: Vec<(usize, usize, f64)> = by_ground.iter().map(|pair| (pair.old, pair.new, pair.share)).collect();
    let (mut is_old_free, mut is_new_free) = (vec![true; old.len()], vec![true; new.len()]);
    for &(old, new, _) in &found {
        (is_old_free[old], is_new_free[new]) = (false, false);
    }
    // What moved further than its own size is known by its code.
    let free = (0..new.len()).filter(|&index| is_new_free[index]);
    let by_code: BTreeMap<&str, usize> = free.map(|index| (new[index].code.as_str(), index)).collect();
    for (index, place) in old.iter().enumerate().filter(|(index, _)| is_old_free[*index]) {
        found.extend(by_code.get(place.code.as_str()).map(|&other| (index, other, 0.0)));
    }
    for &(old, new, _) in &found {
        (is_old_free[old], is_new_free[new]) = (false, false);
    }
    let indices = |free: Vec<bool>| (0..free.len()).filter(|&index| free[index]).collect();
    let mut matched: Vec<PlaceMatch> =
        found.into_iter().map(|(one, other, share)| matched(one, other, share, &old[one], &new[other])).collect();
    matched.sort_by_key(|pair| pair.old);
    Comparison { matched, added: indices(is_new_free), removed: indices(is_old_free) }
}

fn matched(old: usize, new: usize, share: f64, before: &ComparedPlace, now: &ComparedPlace) -> PlaceMatch {
    let shift = now.footprint.center - before.footprint.center;
    let found = [
        (PlaceChange::Moved, shift.norm() > MOVED_M),
        (PlaceChange::Relabelled, before.label != now.label),
        (PlaceChange::Recoded, before.code != now.code),
        (PlaceChange::Filled, (before.occupied, now.occupied) == (Some(false), Some(true))),
        (PlaceChange::Emptied, (before.occupied, now.occupied) == (Some(true), Some(false))),
    ];
    let changes = found.into_iter().filter_map(|(change, happened)| happened.then_some(change)).collect();
    PlaceMatch { old, new, share, shift, changes }
}
