//! The paper's method: gradient histogram, circular Gaussian mixture, wavelet peaks.
//!
//! Source: the paper, II-B "Dominant Orientations" and Fig. 4. The histogram of gradient orientations is weighted by
//! gradient magnitude; a Gaussian mixture acts as an aggressive low-pass; the peaks of its density are found by a
//! continuous wavelet transform of narrow scales.
//!
//! Departures, each for a measured defect of the author's published code:
//! - The histogram is folded to half a turn and circular throughout, so an orientation is found once and the ends of
//!   the signal join.
//! - The number of components is chosen by the Bayesian information criterion, and a uniform floor takes the cells
//!   without orientation.
//! - With `refine` (the default), radiogram energy ([`super::energy`]) corrects the peaks: they move to the nearby
//!   maximum of the energy (one bin of 0.2 degrees would be 0.7 m across a hall of 190 m), those without contrast are
//!   dropped, and pairs of perpendicular directions that only the energy shows are added. Gradients of stairs and dots
//!   gather at the directions of the pixel grid, and the histogram of maps of pallet footprints is flat; the energy has
//!   neither defect.
//!
//! Cost: O(cells x kernel) for the gradients; the other steps do not depend on the size of the map. Limits: without
//! `refine` directions are biased towards the pixel grid.

use super::bins::angle_at;
use super::energy::{OccupiedSample, SAMPLE_CELLS};
use super::gradient;
use super::mixture::Mixture;
use super::orientations::Orientations;
use super::refine::refine;
use crate::geometry::fold_half_turn;
use crate::grid::OccupancyGrid;
use crate::signal::{self, Boundary, Peak, RidgeSpec};
use crate::spec::OrientationOptions;
use crate::watch::{Stopped, Watch};

/// Widths of the wavelets, degrees: narrow, since the mixture is smooth already (prototype: 4 to 24 bins of 0.2).
const WAVELET_WIDTHS_DEG: [f64; 11] = [0.8, 1.2, 1.6, 2.0, 2.4, 2.8, 3.2, 3.6, 4.0, 4.4, 4.8];

/// Scales in a row that a ridge may miss.
const RIDGE_GAP: usize = 1;

/// Scales that a ridge must show up at: a quarter of all (Du et al., 2006).
const RIDGE_LENGTH: usize = 3;

/// Largest distance of a maximum of the mixture from its ridge, degrees (20 bins in the author's published code).
const RIDGE_REACH_DEG: f64 = 4.0;

/// Width of the Hann window over the histogram before the mixture is fitted, degrees (the author's: 21 bins of 0.4).
const HISTOGRAM_SMOOTHING_DEG: f64 = 2.0;

/// Finds the dominant orientations of each of `count` parts of a grid, in one pass over its cells.
///
/// `part_of` names the part of a cell by column and row. The gradients are those of the whole grid, so the borders of
/// the parts are not structure.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn orientations_of_parts<P>(
    grid: &OccupancyGrid,
    count: usize,
    part_of: P,
    options: &OrientationOptions,
    watch: &Watch<'_>,
) -> Result<Vec<Orientations>, Stopped>
where
    P: Fn(usize, usize) -> Option<usize> + Sync,
{
    let histograms = gradient::weighted_histograms(grid, count, &part_of, options, watch)?;
    let samples =
        if options.refine { OccupiedSample::of_parts(grid, count, &part_of, SAMPLE_CELLS, watch)? } else { Vec::new() };
    let mut parts = Vec::with_capacity(count);
    for (index, histogram) in histograms.into_iter().enumerate() {
        watch.check()?;
        parts.push(read_histogram(histogram, samples.get(index), options, watch)?);
    }
    Ok(parts)
}

/// From the weights per bin to the orientations.
fn read_histogram(
    mut histogram: Vec<f64>,
    sample: Option<&OccupiedSample>,
    options: &OrientationOptions,
    watch: &Watch<'_>,
) -> Result<Orientations, Stopped> {
    let total: f64 = histogram.iter().sum();
    if total <= 0.0 {
        return Ok(Orientations::default());
    }
    for weight in &mut histogram {
        *weight /= total;
    }
    let bins_per_degree = histogram.len() as f64 / 180.0;
    let smooth = signal::smooth_hann(&histogram, HISTOGRAM_SMOOTHING_DEG * bins_per_degree, Boundary::Circular);
    let model = Mixture::fit(&smooth, options.max_components, watch)?;
    let mixture = model.per_bin(histogram.len());
    let peaks = mixture_peaks(&mixture, model.floor(), options);
    let mut angles: Vec<f64> =
        peaks.iter().map(|peak| fold_half_turn(angle_at(peak.position, histogram.len()))).collect();
    if let Some(sample) = sample {
        angles = refine(sample, &angles, options, watch)?;
    }
    angles.sort_by(f64::total_cmp);
    Ok(Orientations { angles, histogram, mixture })
}

/// Maxima of the mixture near wavelet ridges that are high enough; strongest first.
fn mixture_peaks(mixture: &[f64], floor: f64, options: &OrientationOptions) -> Vec<Peak> {
    let bins = mixture.len();
    let bins_per_degree = bins as f64 / 180.0;
    let widths = WAVELET_WIDTHS_DEG.map(|width| (width * bins_per_degree).max(1.0)).to_vec();
    let spec = RidgeSpec { widths, max_gap: RIDGE_GAP, min_length: RIDGE_LENGTH };
    let maxima = signal::local_maxima(mixture, Boundary::Circular);
    let reach = (RIDGE_REACH_DEG * bins_per_degree).max(1.0);
    let mut peaks: Vec<Peak> = signal::ridge_peaks(mixture, Boundary::Circular, &spec)
        .into_iter()
        .filter_map(|ridge| {
            let near = |peak: &&Peak| Boundary::Circular.distance(peak.position, ridge as f64, bins) <= reach;
            maxima.iter().filter(near).max_by(|one, other| one.height.total_cmp(&other.height)).copied()
        })
        .collect();
    let uniform = floor / bins as f64;
    let highest = peaks.iter().map(|peak| peak.height - uniform).fold(0.0, f64::max);
    peaks.retain(|peak| peak.height - uniform >= options.min_peak * highest);
    signal::keep_apart(peaks, options.min_separation_deg * bins_per_degree, bins, Boundary::Circular)
}
