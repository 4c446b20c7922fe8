//! Dominant orientations: maxima of the radiogram energy ([`energy`], the default), or the paper's way: weighted gradient
//! histogram -> circular Gaussian mixture -> wavelet peaks -> lines.
//!
//! Source of the latter: the paper, II-B "Dominant Orientations" and Fig. 4. The histogram of gradient orientations is weighted by
//! gradient magnitude; a Gaussian mixture acts as an aggressive low-pass; peaks of its density are found by a
//! continuous wavelet transform of narrow scales.
//!
//! Departures, each against a measured defect of the author's published code:
//! - The histogram is folded to half a turn and circular from the first step to the last, so an orientation is found
//!   once and the ends of the signal are no ends.
//! - The number of components is chosen by BIC, and a uniform floor takes what has no orientation.
//! - With `refine` (the default), radiogram energy ([`energy`]) has the last word. The gradients of stairs and dots
//!   pile up at the directions of the pixel grid, and on maps of pallet footprints the histogram is flat; the energy
//!   has neither weakness. Peaks of the mixture move to its nearby maximum (one bin of 0.2 degrees would be 0.7 m
//!   across a hall of 190 m), those that the radiogram does not confirm are dropped, and pairs of perpendicular
//!   directions that only the radiogram shows are added.
//!
//! Cost: O(cells x kernel) for the gradients, the other steps do not depend on the size of the map. Limits: two
//! orientations closer than `min_separation_deg` are one; without `refine` there is the bias of the pixel grid.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::geometry::{fold_half_turn, line_angle_between};
use crate::grid::OccupancyGrid;
use crate::signal::{self, Boundary, Peak, RidgeSpec};
use crate::spec::{OrientationMethod, OrientationOptions};
use crate::walls;
use crate::watch::{Stage, Stopped, Watch};

mod blocks;
pub mod energy;
mod gradient;
mod mixture;
pub(crate) mod slope;

#[cfg(test)]
mod tests;

use energy::{Alignment, EnergyScan, OccupiedSample};
use mixture::Mixture;

/// Widths of the wavelets, degrees: narrow, since the mixture has smoothed already (prototype: 4 to 24 bins of 0.2).
const WAVELET_WIDTHS_DEG: [f64; 11] = [0.8, 1.2, 1.6, 2.0, 2.4, 2.8, 3.2, 3.6, 4.0, 4.4, 4.8];
/// Scales a ridge may miss in a row, and those it must show up at: a quarter of all (Du et al., 2006).
const RIDGE_GAP: usize = 1;
const RIDGE_LENGTH: usize = 3;
/// How far from a ridge the maximum of the mixture may lie, degrees (20 bins in the author's published code).
const RIDGE_REACH_DEG: f64 = 4.0;
/// Hann window over the histogram before the mixture is fitted, degrees (the author's: 21 bins of 0.4).
const HISTOGRAM_SMOOTHING_DEG: f64 = 2.0;
/// Smallest contrast of an orientation, as a share of the strongest. On 30 maps the weakest true direction had 0.14
/// and the strongest false one 0.07.
const MIN_CONTRAST: f64 = 0.1;
/// The same for a direction perpendicular to a stronger one, which is expected in what people build. (The walls across
/// a corridor of 15 m in `office__halmstad_F5_05` have 0.05.)
const MIN_CONTRAST_ACROSS: f64 = 0.03;
/// How exactly perpendicular such a direction is, degrees: robots bend their maps.
const ACROSS_DEG: f64 = 2.0;
/// Smallest contrast in deviations of what scattered cells would give. Random grids reach 4.4, a lone bar of eight cells
/// 5.7, a drawn floor plan of 60 cells 15, real maps 50 and more.
const MIN_DEVIATIONS: f64 = 5.0;

/// Directions are square to one another within this, degrees: better than any of them is known before the fit.
const SQUARE_DEG: f64 = 0.3;

/// Fewest occupied cells that are no wall and have a say of their own: a dozen pallets.
const LEAST_GOODS: usize = 500;

/// The dominant orientations and the signals they were read from (for plots).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Orientations {
    /// Directions of lines, radians in `[-pi/2, pi/2)`, ascending.
    pub angles: Vec<f64>,
    /// Weights over line directions in `[-pi/2, pi/2)`, evenly spaced bins, sum 1: of gradients, or the contrast of the
    /// radiogram energy. Empty where there is nothing to weigh.
    pub histogram: Vec<f64>,
    /// The mixture's density at the same bins: the histogram after the aggressive low-pass. Empty without gradients.
    pub mixture: Vec<f64>,
}

/// Finds the dominant orientations of a grid.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn dominant_orientations(
    grid: &OccupancyGrid,
    options: &OrientationOptions,
    watch: &Watch<'_>,
) -> Result<Orientations, Stopped> {
    if options.method == OrientationMethod::Energy {
        return by_energy(grid, options, watch);
    }
    let mut parts = orientations_of_parts(grid, 1, |_, _| Some(0), options, watch)?;
    Ok(parts.pop().unwrap_or_default())
}

/// The directions along which the structure is aligned best; racks may stand askew in their hall, and its walls outshine
/// them, so what is no wall is asked by itself as well.
fn by_energy(grid: &OccupancyGrid, options: &OrientationOptions, watch: &Watch<'_>) -> Result<Orientations, Stopped> {
    let is_wall = walls::find(grid, watch)?;
    watch.progress(Stage::Orientation, 0.1);
    let all = OccupiedSample::of_parts(grid, 1, |_, _| Some(0), energy::SAMPLE_CELLS, watch)?.swap_remove(0);
    let no_wall = |column: usize, row: usize| (!is_wall[row * grid.width() + column]).then_some(0);
    let goods = OccupiedSample::of_parts(grid, 1, no_wall, energy::SAMPLE_CELLS, watch)?.swap_remove(0);
    watch.progress(Stage::Orientation, 0.2);
    let histogram = EnergyScan::new(&all, watch)?.normalized_contrasts();
    watch.progress(Stage::Orientation, 0.3);
    let separation = options.min_separation_deg.to_radians();
    let mut angles = refine(&all, &[], options, watch)?;
    watch.progress(Stage::Orientation, 0.4);
    let enough = goods.len() >= LEAST_GOODS;
    for angle in if enough { refine(&goods, &[], options, watch)? } else { Vec::new() } {
        if angles.iter().all(|&other| line_angle_between(angle, other) >= separation) {
            angles.push(angle);
        }
    }
    watch.progress(Stage::Orientation, 0.5);
    for pair in blocks::pairs(grid, if enough { &goods } else { &all }, &angles, watch)? {
        let both = [pair, pair + PI / 2.0].map(fold_half_turn);
        angles.extend(both);
    }
    watch.progress(Stage::Orientation, 0.6);
    if angles.is_empty() {
        return Ok(Orientations::default());
    }
    let is_square =
        |angle: f64| angles.iter().any(|&other| PI / 2.0 - line_angle_between(angle, other) <= SQUARE_DEG.to_radians());
    let fit = |&angle: &f64| slope::fit(&all, angle, is_square(angle), watch).map(fold_half_turn);
    let mut angles: Vec<f64> = angles.iter().map(fit).collect::<Result<_, _>>()?;
    angles.sort_by(f64::total_cmp);
    Ok(Orientations { angles, histogram, mixture: Vec::new() })
}

/// Finds the dominant orientations of each of `count` parts of a grid, in one pass over its cells.
///
/// `part_of` names the part of a cell by column and row. The gradients are those of the whole grid, so the borders of
/// the parts do not count as structure.
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
    let samples = if options.refine {
        OccupiedSample::of_parts(grid, count, &part_of, energy::SAMPLE_CELLS, watch)?
    } else {
        Vec::new()
    };
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

/// Angle of a position among `bins` bins over `[-pi/2, pi/2)`; bin `i` has its centre at `i`.
fn angle_at(position: f64, bins: usize) -> f64 {
    (position + 0.5) * PI / bins as f64 - PI / 2.0
}

/// Maxima of the mixture that wavelet ridges lead to and that stand out; strongest first.
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

/// Refines, confirms and completes orientations by radiogram energy; strongest first.
fn refine(
    sample: &OccupiedSample,
    angles: &[f64],
    options: &OrientationOptions,
    watch: &Watch<'_>,
) -> Result<Vec<f64>, Stopped> {
    let scan = EnergyScan::new(sample, watch)?;
    let mut alignments: Vec<Alignment> = angles
        .iter()
        .copied()
        .chain(scan.pair_peaks(options.min_peak))
        .map(|angle| scan.refine(sample, angle, watch))
        .collect::<Result<_, _>>()?;
    alignments.sort_by(|one, other| other.contrast.total_cmp(&one.contrast).then(one.angle.total_cmp(&other.angle)));
    let strongest = alignments.first().map_or(0.0, |alignment| alignment.contrast);
    let least = MIN_DEVIATIONS * scan.noise(sample);
    let separation = options.min_separation_deg.to_radians();
    let mut kept: Vec<f64> = Vec::new();
    for Alignment { angle, contrast } in alignments {
        let between = |other: &f64| line_angle_between(angle, *other);
        let is_across = kept.iter().any(|other| PI / 2.0 - between(other) <= ACROSS_DEG.to_radians());
        let share = if is_across { MIN_CONTRAST_ACROSS } else { MIN_CONTRAST };
        let stands_out = contrast >= least.max(share * strongest);
        if stands_out && kept.iter().all(|other| between(other) >= separation) {
            kept.push(angle);
        }
    }
    Ok(kept)
}
