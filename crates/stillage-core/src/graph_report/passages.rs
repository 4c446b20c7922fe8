//! Stretches of lanes narrower than a width.
//!
//! A lane may keep to one side of wide ground. So at every cell along it the ground is looked over to both sides, as far as
//! it is drivable, for the point with the most room; the lane is as narrow as the least of these. Narrow lanes one behind
//! the other, without another way in between, are one passage. Spurs do not count: they end at goods. Cost: O(cells along
//! the lanes x cells across).

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::lane_network::LaneNetwork;
use crate::geometry::{DisjointSets, Point, Vector};
use crate::graph::{Lane, LaneKind};
use crate::routing::NarrowestPlace;
use crate::site_map::SiteMap;

/// A stretch of lanes narrower than a width.
#[derive(Debug, Clone, PartialEq)]
pub struct NarrowPassage {
    /// Its lanes, one of each pair, ascending.
    pub lanes: Vec<usize>,
    /// Width at the narrowest place, metres.
    pub width: f64,
    /// That place, grid frame, metres.
    pub at: Point,
    /// Length of the lanes, metres.
    pub length: f64,
}

/// A lane and its narrowest place.
type NarrowLane = (usize, NarrowestPlace);

/// The passages narrower than a width in metres, the narrowest first.
pub(super) fn narrow(map: &SiteMap<'_>, network: &LaneNetwork<'_>, least: f64) -> Vec<NarrowPassage> {
    let candidates: Vec<usize> = network
        .pairs()
        .map(|(_, other)| other.lane)
        .filter(|&lane| network.lane(lane).kind == LaneKind::Way && network.lane(lane).width < least)
        .collect();
    let narrow_lane = |&lane: &usize| {
        let place = narrowest(map, network.lane(lane), least / 2.0)?;
        (2.0 * place.clearance < least).then_some((lane, place))
    };
    let narrow: Vec<NarrowLane> = candidates.par_iter().filter_map(narrow_lane).collect();
    let passages = stretches(network, &narrow).into_values();
    let mut found: Vec<NarrowPassage> = passages.filter_map(|members| passage(network, &members)).collect();
    found.sort_by(|one, other| one.width.total_cmp(&other.width).then(one.lanes[0].cmp(&other.lanes[0])));
    found
}

/// The narrowest place along a lane; `enough` is a clearance beyond which the ground is not looked over any further.
fn narrowest(map: &SiteMap<'_>, lane: &Lane, enough: f64) -> Option<NarrowestPlace> {
    let step = map.grid.resolution();
    let places = lane.path.windows(2).flat_map(|pair| {
        let way = pair[1] - pair[0];
        let steps = (way.norm() / step).ceil().max(1.0) as usize;
        let aside = Vector::new(-way.y, way.x).try_normalize(0.0).unwrap_or_else(Vector::x) * step;
        (0..=steps).map(move |index| widest_across(map, pair[0] + way * (index as f64 / steps as f64), aside, enough))
    });
    places.reduce(|least, other| if other.clearance < least.clearance { other } else { least })
}

/// The place with the most room to both sides of a point, as far as the ground is drivable.
fn widest_across(map: &SiteMap<'_>, point: Point, aside: Vector, enough: f64) -> NarrowestPlace {
    let mut best = NarrowestPlace { clearance: map.clearance.at(point), at: point };
    for way in [aside, -aside] {
        let mut at = point;
        // The ground is wide enough before that.
        let farthest = (2.0 * enough / aside.norm()).ceil() as usize;
        for _ in 0..farthest {
            if best.clearance >= enough {
                return best;
            }
            at += way;
            let clearance = map.clearance.at(at);
            if clearance <= 0.0 || !map.is_drivable(map.face_at(at)) {
                break;
            }
            if clearance > best.clearance {
                best = NarrowestPlace { clearance, at };
            }
        }
    }
    best
}

/// Narrow lanes that follow one another, by the first of them.
fn stretches(network: &LaneNetwork<'_>, narrow: &[NarrowLane]) -> BTreeMap<usize, Vec<NarrowLane>> {
    let mut sets = DisjointSets::new(narrow.len());
    let mut at_node: BTreeMap<usize, usize> = BTreeMap::new();
    for (index, &(lane, _)) in narrow.iter().enumerate() {
        let lane = network.lane(lane);
        for node in [lane.from, lane.to].into_iter().filter(|&node| network.ways(node).count() == 2) {
            sets.join(index, *at_node.entry(node).or_insert(index));
        }
    }
    let mut found: BTreeMap<usize, Vec<NarrowLane>> = BTreeMap::new();
    for (index, &member) in narrow.iter().enumerate() {
        found.entry(sets.find(index)).or_default().push(member);
    }
    found
}

fn passage(network: &LaneNetwork<'_>, members: &[NarrowLane]) -> Option<NarrowPassage> {
    let places = members.iter().map(|(_, place)| place);
    let narrowest = places.min_by(|one, other| one.clearance.total_cmp(&other.clearance))?;
    Some(NarrowPassage {
        lanes: members.iter().map(|&(lane, _)| lane).collect(),
        width: 2.0 * narrowest.clearance,
        at: narrowest.at,
        length: members.iter().map(|&(lane, _)| network.lane(lane).length()).sum(),
    })
}
