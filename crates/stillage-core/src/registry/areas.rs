//! Which areas of a map have which names.

use super::entry::Registry;
use super::named_area::{AreaKind, NamedArea};
use crate::compare::LEAST_SHARE;
use crate::geometry::common_area::shared_fraction;
use crate::geometry::{Bounds, Point};

/// An area of a map: its outlines and holes in the frame of the site, metres.
pub type AreaRings = Vec<Vec<Point>>;

impl Registry {
    /// The named area that each area of a map is, by its index among [`Registry::areas`]: one to one, in the order of the
    /// area in common as a share of the area of both together. O(named areas x areas), and O(corners²) for those that meet.
    #[must_use]
    pub fn areas_of(&self, kind: AreaKind, grounds: &[AreaRings]) -> Vec<Option<usize>> {
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (index, area) in self.areas.iter().enumerate().filter(|(_, area)| area.kind == kind) {
            let bounds = area.bounds();
            for (ground, rings) in grounds.iter().enumerate() {
                if bounds.meets(&Bounds::around(rings.iter().flatten())) {
                    pairs.push((shared_fraction(&area.rings, rings), index, ground));
                }
            }
        }
        pairs.retain(|pair| pair.0 >= LEAST_SHARE);
        pairs.sort_by(|one, other| other.0.total_cmp(&one.0).then(one.1.cmp(&other.1)).then(one.2.cmp(&other.2)));
        let (mut is_taken, mut found) = (vec![false; self.areas.len()], vec![None; grounds.len()]);
        for (_, index, ground) in pairs {
            if !is_taken[index] && found[ground].is_none() {
                (is_taken[index], found[ground]) = (true, Some(index));
            }
        }
        found
    }

    /// Writes the name and the groups of an area: of the one at this index, which moves to this ground, or of a new one. An
    /// area without a name and groups is forgotten.
    pub fn put_area(&mut self, at: Option<usize>, area: NamedArea) {
        let is_empty = area.name.is_none() && area.groups.is_empty();
        match at {
            Some(index) if is_empty => _ = self.areas.remove(index),
            Some(index) => self.areas[index] = area,
            None if is_empty => {}
            None => self.areas.push(area),
        }
    }
}
