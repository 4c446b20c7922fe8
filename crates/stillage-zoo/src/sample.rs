//! A generated map with its truth.

use stillage_core::geometry::Point;

use crate::picture;
use crate::raster::Lattice;
use crate::site::Fact;
use crate::truth::{Meta, Truth};

/// A generated map with its truth; `M` says what it was made from.
#[derive(Debug, Clone)]
pub struct Sample<M = Meta> {
    /// What it was made from.
    pub meta: M,
    /// What is true.
    pub truth: Truth,
    pub(crate) lattice: Lattice,
    pub(crate) greys: Vec<u8>,
    pub(crate) facts: Vec<Fact>,
}

impl<M> Sample<M> {
    /// Columns and rows of the map.
    #[must_use]
    pub const fn size(&self) -> (usize, usize) {
        (self.lattice.width, self.lattice.height)
    }

    /// Side of a cell, metres.
    #[must_use]
    pub const fn resolution(&self) -> f64 {
        self.lattice.resolution
    }

    /// Lower left corner of the map in the map frame, metres.
    #[must_use]
    pub const fn origin(&self) -> Point {
        self.lattice.origin
    }

    /// Greys of the cells, lowest row first: 0 occupied, 205 unknown, 254 free.
    #[must_use]
    pub fn greys(&self) -> &[u8] {
        &self.greys
    }

    /// The map as a portable grey map.
    #[must_use]
    pub fn pgm(&self) -> Vec<u8> {
        let (width, height) = self.size();
        let mut bytes = format!("P5\n{width} {height}\n255\n").into_bytes();
        self.greys.chunks_exact(width.max(1)).rev().for_each(|row| bytes.extend(row));
        bytes
    }

    /// The metadata of `map_server`.
    #[must_use]
    pub fn yaml(&self) -> String {
        let origin = self.origin();
        format!(
            "image: map.pgm\nmode: trinary\nresolution: {:.6}\norigin: [{:.6}, {:.6}, 0.0]\nnegate: 0\n\
             occupied_thresh: 0.65\nfree_thresh: 0.196\n",
            self.lattice.resolution, origin.x, origin.y
        )
    }

    /// The map with its truth over it: three bytes a pixel, highest row first.
    #[must_use]
    pub fn overlay(&self) -> Vec<u8> {
        picture::overlay(&self.lattice, &self.greys, &self.facts)
    }
}
