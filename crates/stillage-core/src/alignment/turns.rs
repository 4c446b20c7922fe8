//! By which angles one map may be turned against another.
//!
//! Method: the radiogram energy of both maps over half a turn ([`crate::orientation::energy`]), correlated around the
//! circle: its maxima, each with its opposite. Cost: that of two energy scans. Limits: maps without straight structure
//! have maxima of chance.

use std::f64::consts::PI;

use rayon::prelude::*;

use crate::grid::OccupancyGrid;
use crate::orientation::energy::{EnergyScan, OccupiedSample};
use crate::signal::{self, Boundary};
use crate::watch::{Stopped, Watch};

/// Occupied cells that are projected: a quarter of those of an analysis. The turn is refined later.
const SAMPLE: usize = 30_000;
/// Least distance of two turns, steps of the scan of 0.25 degrees.
const APART: f64 = 8.0;
/// Most turns within half a turn: two sites with two pairs of directions each have four.
const MOST: usize = 4;
/// Share of the highest maximum below which a turn is left out.
const LEAST_SHARE: f64 = 0.2;

/// The turns, likeliest first, radians: from the first grid to the second.
pub(super) fn candidates(from: &OccupancyGrid, to: &OccupancyGrid, watch: &Watch<'_>) -> Result<Vec<f64>, Stopped> {
    let spectrum = |grid: &OccupancyGrid| {
        let sample = OccupiedSample::of_parts(grid, 1, |_, _| Some(0), SAMPLE, watch)?.swap_remove(0);
        let contrasts =
            if sample.is_empty() { Vec::new() } else { EnergyScan::new(&sample, watch)?.normalized_contrasts() };
        // Maps that drift are spread over a degree.
        Ok(signal::smooth_hann(&contrasts, 5.0, Boundary::Circular))
    };
    let (from, to) = (spectrum(from)?, spectrum(to)?);
    let steps = from.len();
    if steps == 0 || to.len() != steps {
        return Ok(vec![0.0, PI / 2.0, PI, -PI / 2.0]);
    }
    let agreement = |shift: usize| (0..steps).map(|step| from[step] * to[(step + shift) % steps]).sum::<f64>();
    let agreements: Vec<f64> = (0..steps).into_par_iter().map(agreement).collect();
    let maxima = signal::local_maxima(&agreements, Boundary::Circular);
    let peaks = signal::keep_apart(maxima, APART, steps, Boundary::Circular);
    let highest = peaks.first().map_or(0.0, |peak| peak.height);
    let turns = peaks.iter().take(MOST).filter(|peak| peak.height >= LEAST_SHARE * highest);
    let step = PI / steps as f64;
    Ok(turns.flat_map(|peak| [0.0, -PI].map(|half| peak.position * step + half)).collect())
}
