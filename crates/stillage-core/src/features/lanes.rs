//! A few neighbouring cells at once: arithmetic on short arrays, which compilers turn into vector instructions.

use std::array::from_fn;
use std::ops::{Add, AddAssign, Mul, Sub};

/// Cells that are worked on together.
pub(super) const LANES: usize = 8;

/// One number for each of a few neighbouring cells.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(32))]
pub(super) struct Lanes(pub(super) [f32; LANES]);

impl Lanes {
    /// From whole numbers.
    #[inline]
    pub(super) fn from_units(units: &[u16; LANES]) -> Self {
        // By way of i32, for which there is a vector instruction.
        Self(from_fn(|lane| i32::from(units[lane]) as f32))
    }

    #[inline]
    pub(super) fn min(self, limit: f32) -> Self {
        Self(self.0.map(|value| if value < limit { value } else { limit }))
    }

    #[inline]
    pub(super) fn abs(self) -> Self {
        Self(self.0.map(f32::abs))
    }

    #[inline]
    pub(super) fn sqrt(self) -> Self {
        Self(self.0.map(f32::sqrt))
    }

    /// One where a value is above the threshold, nothing elsewhere.
    #[inline]
    pub(super) fn above(self, threshold: f32) -> Self {
        Self(self.0.map(|value| if value > threshold { 1.0 } else { 0.0 }))
    }
}

impl Add for Lanes {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self(from_fn(|lane| self.0[lane] + other.0[lane]))
    }
}

impl Sub for Lanes {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        Self(from_fn(|lane| self.0[lane] - other.0[lane]))
    }
}

impl Mul for Lanes {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        Self(from_fn(|lane| self.0[lane] * other.0[lane]))
    }
}

impl Mul<f32> for Lanes {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f32) -> Self {
        Self(self.0.map(|value| value * factor))
    }
}

impl AddAssign for Lanes {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
