//! Rows of bodies that stand in one line.
//!
//! A long body stands along its long side. A squarish one (a stack of pallets) belongs to the row in which it has more
//! neighbours. Cost: O(bodies^2). Limits: a row is straight.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use crate::geometry::{DisjointSets, OrientedBox, direction, normal};

/// A body this many times as long as wide has a direction.
const LONG: f64 = 1.6;
/// Bodies whose direction differs by less from that of the site are aligned with it, radians (8 degrees): the box around
/// something rough is turned by as much.
const ALIGNED: f64 = 0.14;
/// Bodies stand in one line when they share this much of the depth of the shallower one, and of the deeper one.
const SHARED_DEPTH: f64 = 0.6;
const SHARED_DEEPER: f64 = 0.36;
/// Longest gap in a row: a share of the shorter body beside it, and metres.
const GAP_SHARE: f64 = 1.5;
pub(super) const GAP_M: f64 = 2.0;

/// Bodies in one line, as ranges along its direction and across it, metres of the grid frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chain {
    pub angle: f64,
    pub along: [f64; 2],
    pub across: [f64; 2],
}

/// The rows of some bodies; `main` is the direction of the site, radians.
pub(super) fn of_bodies(bodies: &[OrientedBox], main: f64) -> Vec<Chain> {
    let mut chains = Vec::new();
    let (mut aligned, mut others) = (Vec::new(), Vec::new());
    for body in bodies {
        let off = (body.angle - main + FRAC_PI_4).rem_euclid(FRAC_PI_2) - FRAC_PI_4;
        if off.abs() < ALIGNED { &mut aligned } else { &mut others }.push(*body);
    }
    let spans: [Vec<Span>; 2] =
        [main, main + FRAC_PI_2].map(|angle| aligned.iter().map(|body| Span::of(body, angle)).collect());
    let allowed: [Vec<bool>; 2] =
        spans.each_ref().map(|spans| spans.iter().map(|span| span.length() * LONG > span.depth()).collect());
    let first = [0, 1].map(|axis| groups(&spans[axis], &allowed[axis]));
    let sizes = first.map(|groups| {
        let size = |group: usize| groups.iter().filter(|&&other| other == group).count();
        groups.iter().map(|&group| if group == usize::MAX { 0 } else { size(group) }).collect::<Vec<_>>()
    });
    for axis in [0, 1] {
        let is_of_axis = |body: usize| {
            let is_more = sizes[axis][body] > sizes[1 - axis][body];
            let [length, depth] = [spans[axis][body].length(), spans[axis][body].depth()];
            let is_long = if axis == 0 { length >= depth } else { length > depth };
            let is_longer = sizes[axis][body] == sizes[1 - axis][body] && is_long;
            allowed[axis][body] && (is_more || is_longer || !allowed[1 - axis][body])
        };
        let chosen: Vec<bool> = (0..aligned.len()).map(is_of_axis).collect();
        chains.extend(chains_of(&spans[axis], &groups(&spans[axis], &chosen), main + FRAC_PI_2 * axis as f64));
    }
    for body in others {
        let span = Span::of(&body, body.angle);
        chains.push(Chain { angle: body.angle, along: span.along, across: span.across });
    }
    chains
}

/// The extents of a body along a direction and across it.
#[derive(Debug, Clone, Copy)]
struct Span {
    along: [f64; 2],
    across: [f64; 2],
}

impl Span {
    fn of(body: &OrientedBox, angle: f64) -> Self {
        let turned = (body.angle - angle).sin().abs() > std::f64::consts::FRAC_1_SQRT_2;
        let [half_along, half_across] =
            if turned { [body.half_extents[1], body.half_extents[0]] } else { body.half_extents };
        let along = direction(angle).dot(&body.center.coords);
        let across = normal(angle).dot(&body.center.coords);
        Self { along: [along - half_along, along + half_along], across: [across - half_across, across + half_across] }
    }

    fn length(&self) -> f64 {
        self.along[1] - self.along[0]
    }

    fn depth(&self) -> f64 {
        self.across[1] - self.across[0]
    }

    /// Whether two bodies stand in one line with a short gap between them.
    fn is_neighbour(&self, other: &Self) -> bool {
        let shared = self.across[1].min(other.across[1]) - self.across[0].max(other.across[0]);
        let gap = self.along[0].max(other.along[0]) - self.along[1].min(other.along[1]);
        shared >= SHARED_DEPTH * self.depth().min(other.depth())
            && shared >= SHARED_DEEPER * self.depth().max(other.depth())
            && gap <= GAP_M.min(GAP_SHARE * self.length().min(other.length()))
    }
}

/// The group of each body by its first member; none for those that are not allowed.
fn groups(spans: &[Span], allowed: &[bool]) -> Vec<usize> {
    let mut sets = DisjointSets::new(spans.len());
    for one in (0..spans.len()).filter(|&one| allowed[one]) {
        for other in (one + 1..spans.len()).filter(|&other| allowed[other]) {
            if spans[one].is_neighbour(&spans[other]) {
                sets.join(one, other);
            }
        }
    }
    (0..spans.len()).map(|body| if allowed[body] { sets.find(body) } else { usize::MAX }).collect()
}

fn chains_of(spans: &[Span], groups: &[usize], angle: f64) -> Vec<Chain> {
    let mut chains: Vec<Chain> = Vec::new();
    let mut number = vec![None; spans.len()];
    for (span, &group) in spans.iter().zip(groups).filter(|&(_, &group)| group != usize::MAX) {
        match number[group] {
            None => {
                number[group] = Some(chains.len());
                chains.push(Chain { angle, along: span.along, across: span.across });
            }
            Some(chain) => {
                let chain: &mut Chain = &mut chains[chain];
                chain.along = [chain.along[0].min(span.along[0]), chain.along[1].max(span.along[1])];
                chain.across = [chain.across[0].min(span.across[0]), chain.across[1].max(span.across[1])];
            }
        }
    }
    chains
}
