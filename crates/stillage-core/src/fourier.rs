//! Two-dimensional Fourier transforms of real pictures, by rows and then by columns.
//!
//! A [`Spectrum`] is stored column by column, so that each direction needs one transposition and runs over contiguous
//! memory. Cost: O(n log n). Limits: `f32`, relative error about 1e-6.

use std::sync::Arc;

use rustfft::num_complex::Complex32;
use rustfft::{Fft, FftPlanner};

/// Side of the squares that are transposed at a time, pixels: source and target stay in the first-level cache.
const TRANSPOSE_BLOCK: usize = 32;

/// The transforms of pictures of one size.
pub(crate) struct Fourier {
    width: usize,
    height: usize,
    /// Forward and inverse.
    row: [Arc<dyn Fft<f32>>; 2],
    /// Forward and inverse.
    column: [Arc<dyn Fft<f32>>; 2],
}

/// A transformed picture: `values[kx * height + ky]`.
pub(crate) struct Spectrum {
    values: Vec<Complex32>,
}

impl Fourier {
    /// Plans transforms of at least the given size.
    pub(crate) fn at_least(width: usize, height: usize) -> Self {
        let (width, height) = (smooth_size(width), smooth_size(height));
        let mut planner = FftPlanner::new();
        Self {
            width,
            height,
            row: [planner.plan_fft_forward(width), planner.plan_fft_inverse(width)],
            column: [planner.plan_fft_forward(height), planner.plan_fft_inverse(height)],
        }
    }

    /// Transforms a picture of `width` columns, filled up with zeros.
    pub(crate) fn forward(&self, picture: &[f32], width: usize) -> Spectrum {
        let mut rows = vec![Complex32::default(); self.width * self.height];
        for (target, source) in rows.chunks_exact_mut(self.width).zip(picture.chunks_exact(width)) {
            for (target, &source) in target.iter_mut().zip(source) {
                target.re = source;
            }
        }
        self.row[0].process(&mut rows);
        let mut values = transposed(&rows, self.width, self.height);
        self.column[0].process(&mut values);
        Spectrum { values }
    }

    /// Magnitude of the picture whose spectrum is `spectrum` times `gain(fx, fy)`, for the first `width` x `height`
    /// pixels; frequencies are in cycles per pixel, in [-1/2, 1/2).
    pub(crate) fn filtered_magnitude(
        &self,
        spectrum: &Spectrum,
        gain: impl Fn(f32, f32) -> f32,
        [width, height]: [usize; 2],
    ) -> Vec<f32> {
        let mut product = Vec::with_capacity(spectrum.values.len());
        for (index, column) in spectrum.values.chunks_exact(self.height).enumerate() {
            let fx = frequency(index, self.width);
            product.extend(column.iter().enumerate().map(|(ky, value)| value * gain(fx, frequency(ky, self.height))));
        }
        let scale = 1.0 / (self.width * self.height) as f32;
        self.inverse(product)
            .chunks_exact(self.width)
            .take(height)
            .flat_map(|row| row[..width].iter().map(|value| value.norm_sqr().sqrt() * scale))
            .collect()
    }

    /// The sum of products of two pictures, `first` at `(x + dx, y + dy)` and `second` at `(x, y)`, for every shift: at
    /// column `dx` and row `dy`, of which negative ones are counted back from the ends.
    pub(crate) fn correlation(&self, first: &Spectrum, second: &Spectrum) -> Vec<f32> {
        let product = first.values.iter().zip(&second.values).map(|(one, other)| one * other.conj()).collect();
        let scale = 1.0 / (self.width * self.height) as f32;
        self.inverse(product).iter().map(|value| value.re * scale).collect()
    }

    /// Columns and rows of the transformed pictures.
    pub(crate) const fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The picture of a spectrum, row by row, times its number of pixels.
    fn inverse(&self, mut spectrum: Vec<Complex32>) -> Vec<Complex32> {
        self.column[1].process(&mut spectrum);
        let mut rows = transposed(&spectrum, self.height, self.width);
        self.row[1].process(&mut rows);
        rows
    }
}

/// Frequency of a coefficient, cycles per sample.
fn frequency(index: usize, count: usize) -> f32 {
    let signed = if 2 * index < count { index as f32 } else { index as f32 - count as f32 };
    signed / count as f32
}

/// The transpose of a picture of `width` columns and `height` rows.
fn transposed(values: &[Complex32], width: usize, height: usize) -> Vec<Complex32> {
    let mut turned = vec![Complex32::default(); values.len()];
    for top in (0..height).step_by(TRANSPOSE_BLOCK) {
        for left in (0..width).step_by(TRANSPOSE_BLOCK) {
            for row in top..(top + TRANSPOSE_BLOCK).min(height) {
                for column in left..(left + TRANSPOSE_BLOCK).min(width) {
                    turned[column * height + row] = values[row * width + column];
                }
            }
        }
    }
    turned
}

/// The smallest number of at least `size` without a prime factor above five: fast to transform.
fn smooth_size(size: usize) -> usize {
    let is_smooth = |mut number: usize| {
        for prime in [2, 3, 5] {
            while number.is_multiple_of(prime) {
                number /= prime;
            }
        }
        number == 1
    };
    let mut number = size.max(1);
    while !is_smooth(number) {
        number += 1;
    }
    number
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_filter_of_gain_one_gives_the_picture_back() {
        let picture: Vec<f32> = (0..35).map(|index| ((index * 7) % 11) as f32).collect();
        let fourier = Fourier::at_least(7, 5);
        let spectrum = fourier.forward(&picture, 7);
        let back = fourier.filtered_magnitude(&spectrum, |_, _| 1.0, [7, 5]);
        assert!(picture.iter().zip(&back).all(|(one, other)| (one - other).abs() < 1e-4), "{back:?}");
    }

    #[test]
    fn pictures_correlate_most_at_their_shift() {
        let at =
            |wanted: [usize; 2]| (0..64).map(|index| f32::from(u8::from([index % 8, index / 8] == wanted))).collect();
        let [first, second]: [Vec<f32>; 2] = [at([1, 5]), at([3, 2])];
        let fourier = Fourier::at_least(16, 16);
        let found = fourier.correlation(&fourier.forward(&first, 8), &fourier.forward(&second, 8));
        // 2 columns to the left, 3 rows up.
        assert!((found[3 * 16 + 14] - 1.0).abs() < 1e-5);
    }

    #[test]
    fn a_wave_along_x_has_its_frequency_on_x() {
        let picture: Vec<f32> =
            (0..16 * 16).map(|index| (std::f32::consts::TAU * (index % 16) as f32 / 4.0).cos()).collect();
        let fourier = Fourier::at_least(16, 16);
        let spectrum = fourier.forward(&picture, 16);
        let at = |wanted_x: f32, wanted_y: f32| {
            fourier.filtered_magnitude(
                &spectrum,
                |fx, fy| f32::from(u8::from((fx - wanted_x).hypot(fy - wanted_y) < 0.01)),
                [1, 1],
            )[0]
        };
        assert!((at(0.25, 0.0) - 0.5).abs() < 1e-5);
        assert!(at(0.0, 0.25) < 1e-5);
    }

    #[test]
    fn sizes_grow_to_products_of_small_primes() {
        assert_eq!([0, 1, 7, 11, 13, 121].map(smooth_size), [1, 1, 8, 12, 15, 125]);
    }
}
