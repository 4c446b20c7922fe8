//! Gabor texture: the energy of 5 frequencies x 8 orientations per tile.
//!
//! Source: the paper, II-D, after J. Bigun's texture segmentation. The filters are Gaussians in the frequency plane
//! that touch at half their height, after A. K. Jain and F. Farrokhnia, *Unsupervised texture segmentation using Gabor
//! filters* (Pattern Recognition 24(12), 1991, doi 10.1016/0031-3203(91)90143-S). The paper gives no wavelengths: here
//! they are in metres, from the pitch of pallets to two pitches of aisles.
//!
//! Method: the picture is the share of occupied cells per pixel of about 0.4 m. One forward transform, then a product
//! and an inverse transform for each filter. Magnitudes are averaged per tile and smoothed by a Gaussian over the known
//! tiles only, so that tiles at the border of the map are not mixed with the unknown.
//!
//! Cost: O(filters x pixels log pixels). Limits: structure finer than two pixels is not seen.

use rayon::prelude::*;

use super::tiles::Tiles;
use crate::fourier::Fourier;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::spec::RegionOptions;
use crate::watch::{Stopped, Watch};

/// Frequencies of the bank (paper, II-D).
const FREQUENCIES: usize = 5;
/// Orientations of the bank (paper, II-D).
const ORIENTATIONS: usize = 8;
/// Filters of the bank, and so numbers per tile.
pub(super) const CHANNELS: usize = FREQUENCIES * ORIENTATIONS;
/// Largest side of a pixel, metres (accuracy study: best of the scales tried).
const PIXEL_M: f64 = 0.4;
/// Fewest pixels per shortest wavelength (accuracy study).
const PIXELS_PER_WAVELENGTH: f64 = 3.0;
/// Margin of zeros beside the picture, longest wavelengths: the transform is circular, the map is not.
const MARGIN_WAVELENGTHS: f64 = 1.5;
/// Exponent beyond which the gain of a filter, below 1e-5 there, is taken as 0.
const MAX_EXPONENT: f32 = 12.0;

/// The channels of every tile, row by row; zeros where nothing is known.
pub(super) fn texture(
    grid: &OccupancyGrid,
    tiles: &Tiles,
    options: &RegionOptions,
    watch: &Watch<'_>,
) -> Result<Vec<f32>, Stopped> {
    let picture = Picture::new(grid, options);
    let longest = options.wavelengths_m[1] / picture.pixel_m(grid);
    let margin = (MARGIN_WAVELENGTHS * longest) as usize;
    let fourier = Fourier::at_least(picture.width + margin, picture.height + margin);
    watch.check()?;
    let spectrum = fourier.forward(&picture.occupied, picture.width);
    let sigma = options.smoothing_m / (tiles.tile_cells as f64 * grid.resolution());
    let channels: Vec<Vec<f32>> = bank(options, picture.pixel_m(grid))
        .into_par_iter()
        .map(|filter| {
            watch.check()?;
            let size = [picture.width, picture.height];
            let magnitude = fourier.filtered_magnitude(&spectrum, |fx, fy| filter.gain(fx, fy), size);
            Ok(tiles.smoothed(&picture.per_tile(&magnitude, tiles), sigma))
        })
        .collect::<Result<_, Stopped>>()?;
    let mut texture = Vec::with_capacity(tiles.known.len() * CHANNELS);
    for tile in 0..tiles.known.len() {
        texture.extend(channels.iter().map(|channel| channel[tile]));
    }
    Ok(texture)
}

/// The grid at the scale of the filters.
struct Picture {
    /// Side of a pixel, cells.
    cells: usize,
    width: usize,
    height: usize,
    /// Share of occupied cells.
    occupied: Vec<f32>,
}

impl Picture {
    fn new(grid: &OccupancyGrid, options: &RegionOptions) -> Self {
        let pixel_m = PIXEL_M.min(options.wavelengths_m[0] / PIXELS_PER_WAVELENGTH);
        let cells = ((pixel_m / grid.resolution()).round() as usize).max(1);
        let (width, height) = (grid.width().div_ceil(cells), grid.height().div_ceil(cells));
        let share = 1.0 / (cells * cells) as f32;
        let row_of_pixels = |row: usize| {
            let mut pixels = vec![0.0; width];
            for row in row * cells..((row + 1) * cells).min(grid.height()) {
                for (pixel, cells) in pixels.iter_mut().zip(grid.row(row).chunks(cells)) {
                    let occupied = cells.iter().filter(|&&cell| cell == Occupancy::Occupied).count();
                    *pixel += occupied as f32 * share;
                }
            }
            pixels
        };
        let occupied = (0..height).into_par_iter().flat_map_iter(row_of_pixels).collect();
        Self { cells, width, height, occupied }
    }

    fn pixel_m(&self, grid: &OccupancyGrid) -> f64 {
        self.cells as f64 * grid.resolution()
    }

    /// Mean of a picture over the pixels that touch each tile.
    fn per_tile(&self, values: &[f32], tiles: &Tiles) -> Vec<f32> {
        let span = |tile: usize, count: usize| {
            let first = tile * tiles.tile_cells / self.cells;
            first..((tile + 1) * tiles.tile_cells).div_ceil(self.cells).min(count)
        };
        (0..tiles.rows * tiles.columns)
            .map(|tile| {
                let (columns, rows) = (span(tile % tiles.columns, self.width), span(tile / tiles.columns, self.height));
                let count = columns.len() * rows.len();
                let sum: f32 = rows.map(|row| values[row * self.width..][columns.clone()].iter().sum::<f32>()).sum();
                sum / count.max(1) as f32
            })
            .collect()
    }
}

/// A Gaussian in the frequency plane, on one side of the origin only, so that its response is complex and the magnitude
/// of the response is smooth.
struct GaborFilter {
    /// Centre, cycles per pixel, along `direction`.
    frequency: f32,
    direction: [f32; 2],
    /// 1 / (2 sigma^2) along and across the direction.
    sharpness: [f32; 2],
}

impl GaborFilter {
    fn gain(&self, fx: f32, fy: f32) -> f32 {
        let along = fx * self.direction[0] + fy * self.direction[1] - self.frequency;
        let across = fy * self.direction[0] - fx * self.direction[1];
        let exponent = along * along * self.sharpness[0] + across * across * self.sharpness[1];
        // The frequency 0 is the mean of the picture, which is no texture.
        if exponent > MAX_EXPONENT || (fx == 0.0 && fy == 0.0) { 0.0 } else { (-exponent).exp() }
    }
}

/// The filters of the bank, for pixels of a size in metres.
fn bank(options: &RegionOptions, pixel_m: f64) -> Vec<GaborFilter> {
    let [shortest, longest] = options.wavelengths_m;
    let ratio = (longest / shortest).powf(1.0 / (FREQUENCIES - 1) as f64);
    // Half widths at half height with which neighbouring filters touch, as shares of the frequency.
    let along = (ratio - 1.0) / (ratio + 1.0);
    let across = (std::f64::consts::PI / ORIENTATIONS as f64 / 2.0).tan();
    // A Gaussian falls to one half at sqrt(2 ln 2) deviations, so 1 / (2 sigma^2) = ln 2 / half-width^2.
    let sharpness = |half_width: f64| (std::f64::consts::LN_2 / (half_width * half_width)) as f32;
    (0..FREQUENCIES)
        .flat_map(|step| (0..ORIENTATIONS).map(move |turn| (step, turn)))
        .map(|(step, turn)| {
            let frequency = pixel_m / (longest / ratio.powi(step as i32));
            let angle = std::f64::consts::PI * turn as f64 / ORIENTATIONS as f64;
            GaborFilter {
                frequency: frequency as f32,
                direction: [angle.cos() as f32, angle.sin() as f32],
                sharpness: [sharpness(frequency * along), sharpness(frequency * across)],
            }
        })
        .collect()
}
