//! Which places of two maps are the same: one to one.
//!
//! Method: pairs in the order of the area in common as a share of the area of both together; each place goes to its best
//! free partner. Pairs of equal share are ordered by where they lie, so that neither the order of the places nor that of
//! the maps decides. Cost: O(n log n + pairs whose boxes meet).

use super::footprint::Footprint;
use crate::geometry::common_area::overlap_share;
use crate::geometry::{Bounds, Point};

/// Least share of common area of a pair: neighbours in a row of places have less, even where borders moved by a
/// quarter of a place.
pub const LEAST_SHARE: f64 = 0.2;
/// Shares that differ by less are equal.
const EQUAL_SHARES: f64 = 1e-6;
/// Pairs are looked at closely whose boxes have this part of the least share in common: rounding makes it no smaller.
const ENOUGH: f64 = 0.99;
/// A second partner with this share of the best one's makes a pair doubtful.
const RIVAL: f64 = 0.6;

/// Two places that are one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Index among the old places.
    pub old: usize,
    /// Index among the new places.
    pub new: usize,
    /// Area in common as a share of the area of both together, 0 to 1.
    pub share: f64,
    /// Another place overlaps one of them nearly as much.
    pub has_rival: bool,
}

/// Pairs the places of two maps, by index of the old ones.
#[must_use]
pub fn pairs(old: &[Footprint], new: &[Footprint]) -> Vec<Pair> {
    let mut overlaps = overlaps(old, new);
    let middle = |pair: &Pair| nalgebra::center(&old[pair.old].center, &new[pair.new].center);
    let distance = |pair: &Pair| (old[pair.old].center - new[pair.new].center).norm();
    overlaps.sort_by(|one, other| {
        let by_share = other.share.total_cmp(&one.share);
        let by_place = |one: Point, other: Point| one.x.total_cmp(&other.x).then(one.y.total_cmp(&other.y));
        by_share.then(distance(one).total_cmp(&distance(other))).then_with(|| by_place(middle(one), middle(other)))
    });
    let (mut of_old, mut of_new) = (vec![None; old.len()], vec![None; new.len()]);
    let mut found: Vec<Pair> = Vec::new();
    for pair in overlaps {
        let (taken, taken_new) = (of_old[pair.old], of_new[pair.new]);
        for earlier in [taken, taken_new].into_iter().flatten() {
            let earlier: &mut Pair = &mut found[earlier];
            earlier.has_rival |= pair.share >= RIVAL * earlier.share;
        }
        if taken.is_none() && taken_new.is_none() {
            (of_old[pair.old], of_new[pair.new]) = (Some(found.len()), Some(found.len()));
            found.push(pair);
        }
    }
    found.sort_by_key(|pair| pair.old);
    found
}

/// Area in common of two boxes.
fn common_box(one: &Bounds, other: &Bounds) -> f64 {
    let side = |axis: usize| one.high[axis].min(other.high[axis]) - one.low[axis].max(other.low[axis]);
    side(0).max(0.0) * side(1).max(0.0)
}

/// Every pair that overlaps enough.
fn overlaps(old: &[Footprint], new: &[Footprint]) -> Vec<Pair> {
    let boxes: Vec<Bounds> = new.iter().map(Footprint::bounds).collect();
    let areas: Vec<f64> = new.iter().map(Footprint::area).collect();
    let mut by_left: Vec<usize> = (0..new.len()).filter(|&index| !boxes[index].is_empty()).collect();
    by_left.sort_by(|&one, &other| boxes[one].low.x.total_cmp(&boxes[other].low.x));
    let widest = by_left.iter().map(|&index| boxes[index].high.x - boxes[index].low.x).fold(0.0, f64::max);
    let mut found = Vec::new();
    for (index, place) in old.iter().enumerate() {
        let (bounds, area) = (place.bounds(), place.area());
        let first = by_left.partition_point(|&other| boxes[other].low.x < bounds.low.x - widest);
        for &other in by_left[first..].iter().take_while(|&&other| boxes[other].low.x <= bounds.high.x) {
            // No more is in common than the boxes have; most neighbours only touch.
            if common_box(&bounds, &boxes[other]) < ENOUGH * LEAST_SHARE * area.max(areas[other]) {
                continue;
            }
            // Rounded: shares that differ by the rounding of coordinates only are equal.
            let share = (overlap_share(&place.outline, &new[other].outline) / EQUAL_SHARES).round() * EQUAL_SHARES;
            if share >= LEAST_SHARE {
                found.push(Pair { old: index, new: other, share, has_rival: false });
            }
        }
    }
    found
}
