//! What is said about two maps: how one lies on the other, or that they show different sites.

use serde::{Deserialize, Serialize};

use super::agreement::Tally;
use crate::geometry::RigidMotion;

/// Share of the surfaces on common ground that must touch, beyond chance, for maps of one site. This and the next three
/// were set on generated halls of 16 kinds, each scanned twice with other goods, on pairs of different halls, and on the
/// pairs of 16 real maps.
const LEAST_AGREEMENT: f64 = 0.5;
/// Share of all surfaces that must touch: 0.42 at least for one hall, 0.35 at most for two.
const LEAST_TOUCHING: f64 = 0.39;
/// The same where one motion stands out: scans that are bent agree less.
const LEAST_WHERE_UNIQUE: f64 = 0.33;
/// Share of the surfaces that must lie on common ground where the maps agree less, or under several motions: parts of two
/// halls agree by chance on up to 0.65 of it, scans of one hall lie on 0.73 at least.
const LEAST_OVERLAP_IN_DOUBT: f64 = 0.7;
/// Standard deviations by which a motion explains more than any other, at least: one of 40 answers by chance.
const LEAST_ADVANTAGE: f64 = 2.0;

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
    /// Another motion explains the maps nearly as well: halls that repeat themselves.
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

/// Judges motions, the first of which explains the most, by so many standard deviations. `chance` is the agreement that
/// says nothing.
pub(super) fn verdict(
    ranked: &[(RigidMotion, Tally)],
    advantage: f64,
    chance: f64,
    to_map_frames: impl Fn(RigidMotion) -> RigidMotion,
) -> Result<SiteAlignment, NotSameSite> {
    let by_rank = |one: &&(RigidMotion, Tally), other: &&(RigidMotion, Tally)| one.1.rank().total_cmp(&other.1.rank());
    let (Some((motion, chosen)), Some((_, closest))) = (ranked.first(), ranked.iter().max_by(by_rank)) else {
        return Err(NotSameSite { agreement: 0.0, overlap: 0.0 });
    };
    let ambiguous = advantage < LEAST_ADVANTAGE;
    // Whether it is one site is told by the motion under which most touches, whichever explains more.
    let (agreement, overlap) = (closest.agreement(), closest.overlap());
    let beyond_chance = (agreement - chance) / (1.0 - chance).max(f64::MIN_POSITIVE);
    let is_broad = overlap >= LEAST_OVERLAP_IN_DOUBT;
    let is_alike = beyond_chance >= LEAST_AGREEMENT && beyond_chance * overlap >= LEAST_TOUCHING;
    let is_enough = beyond_chance * overlap >= LEAST_WHERE_UNIQUE && is_broad;
    let is_unique = is_enough && advantage.is_infinite();
    if !(is_alike && (is_broad || !ambiguous) || is_unique) {
        return Err(NotSameSite { agreement, overlap });
    }
    Ok(SiteAlignment {
        motion: to_map_frames(*motion),
        agreement: chosen.agreement(),
        overlap: chosen.overlap(),
        residual: chosen.residual(),
        ambiguous,
    })
}
