//! Distributions of the measured cells, packed into 16 bits per share.

use rayon::prelude::*;

use super::distribution::greatest;

/// A share of 1, packed.
pub(super) const WHOLE: f32 = u16::MAX as f32;

/// Distributions over the categories, one measured cell after the other.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Memberships {
    count: usize,
    /// `count` shares for each cell, in parts of 65,535.
    values: Vec<u16>,
}

impl Memberships {
    /// Empty distributions of `cells` cells over `count` categories.
    #[must_use]
    pub fn new(cells: usize, count: usize) -> Self {
        Self { count, values: vec![0; cells * count] }
    }

    /// Number of categories.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Packs shares, in the order of cells and categories, into `values` (a part of [`Self::values_mut`]).
    pub fn pack(shares: &[f32], values: &mut [u16]) {
        for (value, share) in values.iter_mut().zip(shares) {
            *value = (share * WHOLE).round() as u16;
        }
    }

    /// The packed shares.
    #[must_use]
    pub fn values(&self) -> &[u16] {
        &self.values
    }

    /// The packed shares, to be filled in blocks of whole cells.
    pub fn values_mut(&mut self) -> &mut [u16] {
        &mut self.values
    }

    /// The shares of one cell, sum 1.
    pub fn of(&self, cell: usize) -> impl Iterator<Item = f32> + Clone {
        unpacked(&self.values[cell * self.count..(cell + 1) * self.count])
    }

    /// The category of each cell: the greatest share, the first of equals.
    #[must_use]
    pub fn categories(&self) -> Vec<u8> {
        self.values.par_chunks_exact(self.count.max(1)).map(|shares| greatest(shares.iter().copied()) as u8).collect()
    }
}

/// The packed shares as numbers of sum 1; the sum of the packed ones is off by rounding.
pub(super) fn unpacked(values: &[u16]) -> impl Iterator<Item = f32> + Clone {
    let sum: u32 = values.iter().map(|&value| u32::from(value)).sum();
    let whole = sum.max(1) as f32;
    values.iter().map(move |&value| f32::from(value) / whole)
}
