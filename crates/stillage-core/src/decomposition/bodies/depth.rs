//! How deep the places of a region are.
//!
//! A body between two fronts is one row, or two back to back with a flue, for every place of a rack must be reached;
//! thicker bodies are left to [`super::layers`]. The depth of the places is the one that explains the thickness of these
//! bodies best, weighted by their length.
//!
//! Cost: O(bodies x depths tried). Limits: without such bodies the usual depth of a pallet is taken.

use super::body::Body;
use crate::decomposition::ground::RegionFrame;

/// The depth that a place has when nothing else is known, metres (a 1.2 m pallet), and what a metre of deviation costs.
const USUAL_DEPTH_M: f64 = 1.15;
const DEPTH_PRIOR: f64 = 0.03;
/// Step of the depths that are tried, metres.
const DEPTH_STEP_M: f64 = 0.025;
/// Widths of a flue that cost nothing, metres; cost of a metre more than the widest, and of a metre that is missing for
/// two rows.
const FLUE_M: [f64; 2] = [0.0, 0.25];
const WIDE_FLUE_COST: f64 = 0.3;
const MISSING_DEPTH_COST: f64 = 1.0;
/// Widest flue, metres: building columns stand in it.
const WIDEST_FLUE_M: f64 = 0.7;
/// A body thinner than this share of the depth holds no row.
pub(super) const THIN_SHARE: f64 = 0.6;
/// The same before a wall, which has some thickness itself, with its pilasters and what lies behind it.
pub(super) const WHOLE_SHARE: f64 = 0.85;
/// Shorter bodies do not count for the depth, metres.
const LEAST_LENGTH_M: f64 = 2.0;

/// The depth of a place within a range that explains the bodies between two fronts best, metres.
pub(crate) fn usual(frame: &RegionFrame, bodies: &[Body], range: [f64; 2]) -> f64 {
    let bodies: Vec<[f64; 2]> = bodies
        .iter()
        .filter(|body| body.fronts == [true; 2])
        .map(|body| [body.thickness(frame), body.length(frame)])
        .filter(|&[thickness, length]| {
            thickness >= THIN_SHARE * range[0] && thickness < thickest_pair(range[1]) && length > LEAST_LENGTH_M
        })
        .collect();
    let total: f64 = bodies.iter().map(|body| body[1]).sum();
    let cost = |depth: f64| {
        let misfits = bodies.iter().map(|&[thickness, length]| {
            let single = (thickness - depth).abs();
            length * single.min(misfit_of_pair(thickness, depth))
        });
        misfits.sum::<f64>() / total.max(1.0) + DEPTH_PRIOR * (depth - USUAL_DEPTH_M).abs()
    };
    let steps = ((range[1] - range[0]) / DEPTH_STEP_M).round() as usize;
    let depths = (0..=steps).map(|step| range[0] + step as f64 * DEPTH_STEP_M);
    depths.min_by(|&one, &other| cost(one).total_cmp(&cost(other))).unwrap_or(USUAL_DEPTH_M)
}

/// Thickness of the thickest two rows back to back, metres.
pub(super) fn thickest_pair(deepest: f64) -> f64 {
    2.0 * deepest + WIDEST_FLUE_M
}

/// Cost of a body as two rows back to back.
fn misfit_of_pair(thickness: f64, depth: f64) -> f64 {
    let flue = thickness - 2.0 * depth;
    if flue < FLUE_M[0] {
        MISSING_DEPTH_COST * (FLUE_M[0] - flue)
    } else {
        WIDE_FLUE_COST * (flue - FLUE_M[1]).max(0.0)
    }
}
