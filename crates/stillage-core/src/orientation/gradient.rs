//! Histogram of gradient orientations, weighted by magnitude ("wHOG" in the paper, II-B).
//!
//! The picture is 1 where a cell is occupied and 0 elsewhere, so the border of the unknown has no gradient; beyond the
//! grid the border cells repeat. Gradients are first derivatives of a Gaussian, separable. A row is filtered by adding
//! one kernel per occupied cell, columns by sums of whole rows, which the compiler vectorizes.
//!
//! Departure: the author's code blurs twice and takes an 11 x 11 Sobel kernel of the grey picture, all in pixels; here
//! there is one scale, in metres. Cost: O(cells x kernel). Limits: the standard deviation is limited to 1 to 32 cells.

use std::f32::consts::{FRAC_PI_2, PI};

use rayon::prelude::*;

use crate::grid::{Occupancy, OccupancyGrid};
use crate::spec::OrientationOptions;
use crate::watch::{Stopped, Watch};

/// Range of the standard deviation, cells: below it the derivative is not sampled well, above it the cost is too high.
const SIGMA_CELLS: [f64; 2] = [1.0, 32.0];
/// Gradients below this are rounding (the picture has values from 0 to 1).
const MIN_MAGNITUDE: f32 = 1e-4;
/// Rows filtered by one task. Fixed, so that sums do not depend on the number of threads.
const STRIP_ROWS: usize = 64;

/// Sums by part of the grid and bin; a part without gradients is empty.
type Histograms = Vec<Vec<f64>>;

/// Adds up gradient magnitudes by direction of line (gradient plus a quarter turn), for each of `count` parts.
pub(super) fn weighted_histograms<P>(
    grid: &OccupancyGrid,
    count: usize,
    part_of: &P,
    options: &OrientationOptions,
    watch: &Watch<'_>,
) -> Result<Histograms, Stopped>
where
    P: Fn(usize, usize) -> Option<usize> + Sync,
{
    let [low, high] = SIGMA_CELLS;
    let kernels = Kernels::new((options.gradient_scale_m / grid.resolution()).clamp(low, high));
    let strips: Vec<Histograms> = (0..grid.height().div_ceil(STRIP_ROWS))
        .into_par_iter()
        .map(|strip| {
            watch.check()?;
            let rows = strip * STRIP_ROWS..((strip + 1) * STRIP_ROWS).min(grid.height());
            let mut sums = vec![Vec::new(); count];
            for_each_gradient(grid, rows, &kernels, |column, row, along, across| {
                let magnitude = along.hypot(across);
                let Some(part) = (magnitude > MIN_MAGNITUDE).then(|| part_of(column, row)).flatten() else { return };
                let sums = &mut sums[part];
                sums.resize(options.bins, 0.0);
                // Shared between the two nearest bin centres, so that directions at the edge of a bin are not biased.
                let (bin, rest) = bin_of_line(along, across, options.bins);
                sums[bin] += f64::from(magnitude * (1.0 - rest));
                sums[(bin + 1) % options.bins] += f64::from(magnitude * rest);
            });
            Ok(sums)
        })
        .collect::<Result<_, Stopped>>()?;
    let mut totals = vec![vec![0.0; options.bins]; count];
    for (part, sums) in strips.iter().flat_map(|strip| strip.iter().enumerate()) {
        for (total, sum) in totals[part].iter_mut().zip(sums) {
            *total += sum;
        }
    }
    Ok(totals)
}

/// The position among the bins over `[-pi/2, pi/2)` of the line across a gradient: the bin whose centre is the last
/// before it, and the fraction of the way to the next centre.
fn bin_of_line(along: f32, across: f32, bins: usize) -> (usize, f32) {
    // The line runs along (-across, along); its angle is folded to half a turn and counted from -pi/2.
    let angle = along.atan2(-across) + FRAC_PI_2;
    let turns = if angle < 0.0 { angle + PI } else { angle } / PI;
    let position = turns * bins as f32 + bins as f32 - 0.5;
    (position as usize % bins, position.fract())
}

/// A sampled Gaussian and its first derivative.
struct Kernels {
    smooth: Vec<f32>,
    slope: Vec<f32>,
}

impl Kernels {
    fn new(sigma: f64) -> Self {
        let reach = (3.0 * sigma).ceil() as i32;
        let bell: Vec<f64> =
            (-reach..=reach).map(|offset| (-0.5 * (f64::from(offset) / sigma).powi(2)).exp()).collect();
        let sum: f64 = bell.iter().sum();
        let smooth = bell.iter().map(|weight| (weight / sum) as f32).collect();
        let slope = (-reach..=reach)
            .zip(&bell)
            .map(|(offset, weight)| (f64::from(offset) / (sigma * sigma) * weight / sum) as f32)
            .collect();
        Self { smooth, slope }
    }

    fn reach(&self) -> usize {
        self.smooth.len() / 2
    }
}

/// Calls `visit(column, row, d/dx, d/dy)` for the cells of some rows whose gradient may differ from zero.
fn for_each_gradient(
    grid: &OccupancyGrid,
    rows: std::ops::Range<usize>,
    kernels: &Kernels,
    mut visit: impl FnMut(usize, usize, f32, f32),
) {
    let reach = kernels.reach();
    let last = grid.height() - 1;
    // Filtered rows from `reach` below the strip to `reach` above it; those beyond the grid repeat its border.
    let filtered: Vec<Option<FilteredRow>> = (rows.start..rows.end + 2 * reach)
        .map(|row| FilteredRow::new(grid.row(row.saturating_sub(reach).min(last)), kernels))
        .collect();
    let (mut along, mut across) = (vec![0.0; grid.width()], vec![0.0; grid.width()]);
    for row in rows.clone() {
        let window = &filtered[row - rows.start..=row - rows.start + 2 * reach];
        if window.iter().all(Option::is_none) {
            continue;
        }
        along.fill(0.0);
        across.fill(0.0);
        for ((row, smooth), slope) in window.iter().zip(&kernels.smooth).zip(&kernels.slope) {
            let Some(row) = row else { continue };
            add_scaled(&mut along, &row.slope, *smooth);
            add_scaled(&mut across, &row.smooth, *slope);
        }
        for (column, (&along, &across)) in along.iter().zip(&across).enumerate() {
            if along != 0.0 || across != 0.0 {
                visit(column, row, along, across);
            }
        }
    }
}

fn add_scaled(sums: &mut [f32], values: &[f32], weight: f32) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += weight * value;
    }
}

/// A row of the picture, filtered along itself with both kernels.
struct FilteredRow {
    smooth: Vec<f32>,
    slope: Vec<f32>,
}

impl FilteredRow {
    /// `None` where no cell of the row is occupied.
    fn new(cells: &[Occupancy], kernels: &Kernels) -> Option<Self> {
        let first = cells.iter().position(|&cell| cell == Occupancy::Occupied)?;
        let (width, reach) = (cells.len(), kernels.reach());
        let mut row = Self { smooth: vec![0.0; width], slope: vec![0.0; width] };
        // Columns are counted from `reach` left of the grid, where its first cell repeats.
        let start = if first == 0 { 0 } else { first + reach };
        for padded in start..width + 2 * reach {
            let column = padded.saturating_sub(reach).min(width - 1);
            if cells[column] == Occupancy::Occupied {
                row.add(padded, kernels);
            }
        }
        Some(row)
    }

    /// Adds the response to one occupied cell at a column counted from `reach` left of the grid.
    fn add(&mut self, padded: usize, kernels: &Kernels) {
        let reach = kernels.reach();
        // It reaches the columns from two reaches before its padded column to that column.
        let from = padded.saturating_sub(2 * reach);
        let to = (padded + 1).min(self.smooth.len());
        let skipped = from + 2 * reach - padded;
        for (index, column) in (from..to).enumerate() {
            self.smooth[column] += kernels.smooth[skipped + index];
            // A convolution mirrors its kernel, and the kernel of the slope is odd.
            self.slope[column] -= kernels.slope[skipped + index];
        }
    }
}
