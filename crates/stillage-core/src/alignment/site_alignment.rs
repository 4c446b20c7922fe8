//! What is said about two maps: how one lies on the other, or that they show different sites.

use serde::{Deserialize, Serialize};

use super::agreement::Tally;
use crate::geometry::RigidMotion;

/// Share of the surfaces on common ground that must touch, beyond chance, for maps of one site. This and the next four were set on 64
/// generated halls of 16 kinds, each scanned twice with other goods, on 60 pairs of different halls, and on the pairs of
/// 16 real maps.
const LEAST_AGREEMENT: f64 = 0.5;
/// Share of all surfaces that must touch: 0.42 at least for one hall, 0.35 at most for two.
const LEAST_TOUCHING: f64 = 0.39;
/// The same where one motion stands out: scans that are bent agree less.
const LEAST_WHERE_UNIQUE: f64 = 0.33;
/// Share of the surfaces that must then lie on common ground: parts of halls stand out by chance on up to 0.6 of it.
const LEAST_OVERLAP_WHERE_UNIQUE: f64 = 0.7;
/// A motion stands out when the rank of the next one is at most this share of its own: 0.32 for two bent scans of a
/// building, 0.5 at least for different halls.
const STANDS_OUT: f64 = 0.42;
/// A runner-up with this share of the best rank makes the answer ambiguous: of the halls whose other end was taken for
/// the right one, the least had 0.96.
const NEARLY_EQUAL: f64 = 0.93;

/// How a new map of a site lies on an old one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SiteAlignment {
    /// From the map frame of the new one to that of the old one.
    pub motion: RigidMotion,
    /// Share of the surfaces on ground known to both which agree, 0 to 1.
    pub agreement: f64,
    /// Share of the surfaces that lie on ground known to both, 0 to 1.
    pub overlap: f64,
    /// Root mean square distance of the surfaces that agree, metres.
    pub residual: f64,
    /// Another motion fits nearly as well: halls that repeat themselves.
    pub ambiguous: bool,
}

/// Two maps that show no ground in common.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[error(
    "the maps show different sites: at best {:.0} % of their walls and racks agree, on {:.0} % of the ground",
    agreement * 100.0,
    overlap * 100.0
)]
pub struct NotSameSite {
    /// The agreement of the best motion, 0 to 1.
    pub agreement: f64,
    /// Its overlap, 0 to 1.
    pub overlap: f64,
}

/// Judges motions, the best first. `chance` is the agreement that says nothing.
pub(super) fn verdict(
    ranked: &[(RigidMotion, Tally)],
    chance: f64,
    to_map_frames: impl Fn(RigidMotion) -> RigidMotion,
) -> Result<SiteAlignment, NotSameSite> {
    let Some((motion, best)) = ranked.first() else { return Err(NotSameSite { agreement: 0.0, overlap: 0.0 }) };
    let (agreement, overlap) = (best.agreement(), best.overlap());
    let runner_up = ranked.get(1).map_or(f64::NEG_INFINITY, |(_, next)| next.rank());
    let is_rival = |share: f64| runner_up > share * best.rank();
    let beyond_chance = (agreement - chance) / (1.0 - chance).max(f64::MIN_POSITIVE);
    let is_alike = beyond_chance >= LEAST_AGREEMENT && beyond_chance * overlap >= LEAST_TOUCHING;
    let is_enough = beyond_chance * overlap >= LEAST_WHERE_UNIQUE && overlap >= LEAST_OVERLAP_WHERE_UNIQUE;
    let is_unique = is_enough && !is_rival(STANDS_OUT);
    if !is_alike && !is_unique {
        return Err(NotSameSite { agreement, overlap });
    }
    let ambiguous = is_rival(NEARLY_EQUAL);
    Ok(SiteAlignment { motion: to_map_frames(*motion), agreement, overlap, residual: best.residual(), ambiguous })
}
