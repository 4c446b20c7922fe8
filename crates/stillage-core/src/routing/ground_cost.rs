//! What a metre costs: by the label of the ground, by the distance from obstacles, by what other routes used.

use std::collections::BTreeSet;

use super::route::{Preferences, RouteProfile};
use super::search::WayCost;
use crate::site_map::SiteMap;

/// Distance from obstacles beyond which more of it is no better, as a multiple of the radius; and for narrow vehicles,
/// metres. Our choice: a vehicle that passes with its own width to spare needs no more.
const PREFERRED_RADII: f64 = 3.0;
const PREFERRED_M: f64 = 1.0;
/// A metre beside an obstacle costs this many more than one with the preferred clearance.
const NEARNESS: f32 = 4.0;
/// A metre in a tile that another route used costs this many.
const USED: f32 = 1.6;

/// The cost of ground.
pub(super) struct GroundCost<'a> {
    map: &'a SiteMap<'a>,
    label_costs: Vec<f32>,
    /// Clearance from which on more is no better, in the steps of the map; 0 where none is preferred.
    preferred: u16,
    used: BTreeSet<usize>,
    is_plain: bool,
}

impl<'a> GroundCost<'a> {
    pub fn new(map: &'a SiteMap<'a>, preferences: &Preferences, radius: f64) -> Self {
        let preferred = match preferences.profile {
            RouteProfile::Shortest => 0,
            RouteProfile::Clearance => map.clearance.threshold(Self::preferred_clearance(radius)),
        };
        let label_costs: Vec<f32> = preferences.label_costs.iter().map(|&cost| cost.max(1.0) as f32).collect();
        let is_plain = preferred == 0 && label_costs.iter().all(|&cost| cost == 1.0);
        Self { map, label_costs, preferred, used: BTreeSet::new(), is_plain }
    }

    /// The clearance that routes keep where they can, metres.
    pub fn preferred_clearance(radius: f64) -> f64 {
        (PREFERRED_RADII * radius).max(radius + PREFERRED_M)
    }

    /// Makes the tiles of a route dearer for the next ones.
    pub fn avoid(&mut self, tiles: &BTreeSet<usize>) {
        self.used.extend(tiles);
        self.is_plain = false;
    }

    fn of_cell(&self, cell: usize) -> f32 {
        let label = self.map.semantic.labels[self.map.cells.of_cell(cell).index()];
        let by_label = self.label_costs.get(usize::from(label.0)).copied().unwrap_or(1.0);
        if self.preferred == 0 {
            return by_label;
        }
        let clearance = self.map.clearance.steps()[cell].min(self.preferred);
        by_label * (1.0 + NEARNESS * (1.0 - f32::from(clearance) / f32::from(self.preferred)))
    }
}

impl WayCost for GroundCost<'_> {
    fn factor(&self, tile: usize, from: usize, to: usize) -> f32 {
        if self.is_plain {
            return 1.0;
        }
        let used = if self.used.contains(&tile) { USED } else { 1.0 };
        used * f32::midpoint(self.of_cell(from), self.of_cell(to))
    }
}
