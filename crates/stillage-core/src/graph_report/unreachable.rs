//! Locations that no lane leads to, and why.
//!
//! Reached are those whose node is in the component that serves the most locations; places behind others share the lot of
//! those in front. Cost: O(locations); O(cells) where the graph falls apart.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::components::GraphComponent;
use super::lane_network::LaneNetwork;
use crate::arrangement::FaceId;
use crate::geometry::Point;
use crate::layout::{Layout, Location, approach_before};
use crate::routing::WidestWays;
use crate::site_map::SiteMap;

/// The width of the widest vehicle that finds room is told to within this, metres: less than a cell of most maps.
const PRECISION_M: f64 = 0.02;

/// Why a location is not reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UnreachableReason {
    /// No drivable face borders it, nor a place in front of it.
    NoAccess,
    /// Drivable ground borders it, but a vehicle finds no room before it.
    NoRoom {
        /// Width of the widest vehicle that would, metres; 0 where none would.
        width: f64,
    },
    /// No drivable link joins the ground before it with the ground that most locations are reached from.
    Disconnected {
        /// The face before it.
        face: FaceId,
    },
    /// Obstacles leave too narrow a way.
    TooNarrow {
        /// Width of the widest way at its narrowest place, metres.
        width: f64,
        /// That place, grid frame.
        at: Point,
    },
    /// A vehicle gets there, but the graph has no lane.
    NoLane,
}

/// A location that is not reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnreachableLocation {
    /// Index of the location.
    pub location: usize,
    /// Why.
    pub reason: UnreachableReason,
}

/// The locations that the first of the components does not serve, by index.
pub(super) fn unreachable(
    map: &SiteMap<'_>,
    layout: &Layout,
    network: &LaneNetwork<'_>,
    components: &[GraphComponent],
    radius: f64,
) -> Vec<UnreachableLocation> {
    let nodes: BTreeMap<usize, usize> =
        (0..network.len()).filter_map(|node| Some((network.node(node).location?, node))).collect();
    let mut is_reached = vec![false; network.len()];
    let main = components.first().map_or(&[][..], |component| &component.nodes);
    for &node in main {
        is_reached[node] = true;
    }
    let fronts = fronts(layout);
    let missed: Vec<(usize, usize)> = (0..layout.locations.len())
        .map(|location| (location, fronts[location]))
        .filter(|(_, front)| nodes.get(front).is_none_or(|&node| !is_reached[node]))
        .collect();
    let is_cut_off = missed.iter().any(|(_, front)| nodes.contains_key(front));
    let starts: Vec<Point> = main.iter().map(|&node| network.node(node).position).collect();
    let ways = is_cut_off.then(|| WidestWays::from(map, &starts));
    let reason = |front: usize| {
        let location = &layout.locations[front];
        let Some(&node) = nodes.get(&front) else { return without_node(map, location) };
        let position = network.node(node).position;
        match ways.as_ref().and_then(|ways| ways.to(position)) {
            None => UnreachableReason::Disconnected { face: network.node(node).face },
            Some(narrowest) if narrowest.clearance < radius => {
                UnreachableReason::TooNarrow { width: 2.0 * narrowest.clearance, at: narrowest.at }
            }
            Some(_) => UnreachableReason::NoLane,
        }
    };
    missed.par_iter().map(|&(location, front)| UnreachableLocation { location, reason: reason(front) }).collect()
}

/// By location, the one at the aisle through which it is reached: itself where it lies at the aisle, or nobody knows.
fn fronts(layout: &Layout) -> Vec<usize> {
    let at_aisles: BTreeMap<(u32, u32), usize> = layout
        .locations
        .iter()
        .enumerate()
        .filter(|(_, location)| location.depth_in_row == 1 && location.aisle > 0)
        .map(|(index, location)| ((location.aisle, location.bay), index))
        .collect();
    let front = |(index, location): (usize, &Location)| match location.depth_in_row {
        1 => index,
        _ => at_aisles.get(&(location.aisle, location.bay)).copied().unwrap_or(index),
    };
    layout.locations.iter().enumerate().map(front).collect()
}

/// Why a location has no node: nothing borders it, or nothing finds room.
fn without_node(map: &SiteMap<'_>, location: &Location) -> UnreachableReason {
    if location.front.is_none() {
        return UnreachableReason::NoAccess;
    }
    let has_room = |radius: f64| approach_before(map, location, radius).is_some();
    // The room grows with the aisle: a vehicle of 10 m finds none anywhere.
    let (mut fits, mut stuck) = (0.0, 5.0);
    while has_room(fits) && stuck - fits > PRECISION_M / 2.0 {
        let middle = f64::midpoint(fits, stuck);
        if has_room(middle) { fits = middle } else { stuck = middle }
    }
    UnreachableReason::NoRoom { width: 2.0 * fits }
}
