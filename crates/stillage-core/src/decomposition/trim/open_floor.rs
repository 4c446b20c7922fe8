//! Open floor ends where the robot saw none.
//!
//! Open floor is cut as rectangles from side to side of the frame, so it runs on through walls, into ground that was never
//! seen and into what was seen through a door. Each rectangle is cut again where most cells of its lines change from free to
//! not free, in the direction with the greater contrast, until its parts are one or the other.
//!
//! Source: the recursive XY-cut of [`crate::decomposition::aisles`]. Cost: O(cells of the open floor x cuts). Limits:
//! slanted walls leave steps.

use std::ops::Range;

use crate::decomposition::ground::{Axis, Cell, Rect, RegionFrame};
use crate::decomposition::parcel::Parcel;
use crate::plot::PlotKind;
use crate::runs::runs_of_equal;
use crate::watch::{Stopped, Watch};

/// Share of a line, or of a part, that is free where it was seen.
const MAJORITY: f64 = 0.5;
/// Narrowest part, metres, and the same at the sides, where a wall and what lies behind it is cut off.
const PART_M: f64 = 1.0;
const SIDE_M: f64 = 0.3;
/// Deepest recursion.
const MOST_CUTS: usize = 4;

/// Cuts the open floor; parts that were not seen are none. Other parcels stay as they are.
pub(super) fn trimmed(frame: &RegionFrame, parcels: Vec<Parcel>, watch: &Watch<'_>) -> Result<Vec<Parcel>, Stopped> {
    let mut parts = Vec::with_capacity(parcels.len());
    for parcel in parcels {
        if parcel.kind == PlotKind::OpenFloor {
            cut(frame, parcel, 0, &mut parts, watch)?;
        } else {
            parts.push(parcel);
        }
    }
    Ok(parts)
}

fn cut(
    frame: &RegionFrame,
    floor: Parcel,
    depth: usize,
    parts: &mut Vec<Parcel>,
    watch: &Watch<'_>,
) -> Result<(), Stopped> {
    watch.check()?;
    let profiles = Axis::BOTH.map(|axis| (axis, free_shares(frame, &floor.rect, axis)));
    let cuts = profiles.into_iter().map(|(axis, shares)| (axis, contrast(&shares), runs(frame, &shares)));
    let best = cuts.filter(|(_, _, runs)| runs.len() > 1).max_by(|one, other| one.1.total_cmp(&other.1));
    match best {
        Some((axis, _, runs)) if depth < MOST_CUTS => {
            let start = floor.rect.range(axis).start;
            for run in runs {
                let rect = floor.rect.with(axis, start + run.start..start + run.end);
                cut(frame, Parcel { rect, ..floor.clone() }, depth + 1, parts, watch)?;
            }
        }
        _ => {
            let is_seen = frame.share(&floor.rect, Cell::is_free) >= MAJORITY;
            parts.push(Parcel { kind: if is_seen { PlotKind::OpenFloor } else { PlotKind::Other }, ..floor });
        }
    }
    Ok(())
}

/// Free share of every line across `axis`.
fn free_shares(frame: &RegionFrame, rect: &Rect, axis: Axis) -> Vec<f64> {
    let length = rect.range(axis.other()).len().max(1) as f64;
    let free = frame.counts(rect, axis.other(), Cell::is_free);
    free.into_iter().map(|free| f64::from(free) / length).collect()
}

/// Contrast of lines: 0 where all are half free, 1 where each is free or not.
fn contrast(shares: &[f64]) -> f64 {
    shares.iter().map(|share| (2.0 * share - 1.0).abs()).sum::<f64>() / shares.len().max(1) as f64
}

/// Runs of lines that are mostly free, or mostly not; short ones are joined to a neighbour.
fn runs(frame: &RegionFrame, shares: &[f64]) -> Vec<Range<usize>> {
    let mut is_free: Vec<bool> = shares.iter().map(|&share| share >= MAJORITY).collect();
    let (part, side) = (frame.cells_of(PART_M), frame.cells_of(SIDE_M));
    let short = runs_of_equal(&is_free).filter(|run| {
        let is_side = run.start == 0 || run.end == shares.len();
        run.len() < if is_side { side } else { part }
    });
    for run in short.collect::<Vec<_>>() {
        let like = run.start.checked_sub(1).or(Some(run.end).filter(|&end| end < shares.len()));
        let value = like.map_or(is_free[run.start], |like| is_free[like]);
        is_free[run].fill(value);
    }
    runs_of_equal(&is_free).collect()
}
