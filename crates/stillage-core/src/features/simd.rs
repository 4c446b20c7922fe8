//! Arithmetic on a few neighbouring cells at once: short arrays, which compilers turn into vector instructions.
//!
//! Plain loops throughout: closures of `array::from_fn` may not be inlined, and code that is not inlined is not
//! compiled for the wider vectors.

use std::ops::{Add, AddAssign, Mul, Sub};

/// One number for each of `N` neighbouring cells.
#[derive(Debug, Clone, Copy)]
pub(super) struct SimdCells<const N: usize>([f32; N]);

impl<const N: usize> SimdCells<N> {
    /// All numbers 0.
    pub(super) const ZERO: Self = Self([0.0; N]);

    /// The first numbers of a slice.
    #[inline(always)]
    pub(super) fn load(numbers: &[f32]) -> Self {
        Self(*numbers.first_chunk().expect("planes are worked on in whole groups"))
    }

    /// Puts the numbers at the start of a slice.
    #[inline(always)]
    pub(super) fn store(self, numbers: &mut [f32]) {
        *numbers.first_chunk_mut().expect("planes are worked on in whole groups") = self.0;
    }

    /// The first numbers of a slice of whole numbers.
    #[inline(always)]
    pub(super) fn from_units(units: &[u16]) -> Self {
        let units: &[u16; N] = units.first_chunk().expect("planes are worked on in whole groups");
        let mut numbers = Self::ZERO;
        for (number, &units) in numbers.0.iter_mut().zip(units) {
            // By way of i32, for which there is a vector instruction.
            *number = i32::from(units) as f32;
        }
        numbers
    }

    #[inline(always)]
    pub(super) fn min(self, limit: f32) -> Self {
        self.map(|value| if value < limit { value } else { limit })
    }

    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        self.map(f32::abs)
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        self.map(f32::sqrt)
    }

    /// 1 where a value is above the threshold, 0 elsewhere.
    #[inline(always)]
    pub(super) fn above(self, threshold: f32) -> Self {
        self.map(|value| if value > threshold { 1.0 } else { 0.0 })
    }

    #[inline(always)]
    fn map(mut self, function: impl Fn(f32) -> f32) -> Self {
        for number in &mut self.0 {
            *number = function(*number);
        }
        self
    }

    #[inline(always)]
    fn zip(mut self, other: Self, function: impl Fn(f32, f32) -> f32) -> Self {
        for (number, other) in self.0.iter_mut().zip(other.0) {
            *number = function(*number, other);
        }
        self
    }
}

impl<const N: usize> Add for SimdCells<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl<const N: usize> Sub for SimdCells<N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<const N: usize> Mul for SimdCells<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl<const N: usize> Mul<f32> for SimdCells<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f32) -> Self {
        self.map(|value| value * factor)
    }
}

impl<const N: usize> AddAssign for SimdCells<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
