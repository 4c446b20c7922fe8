//! The range of sizes that a place may have.

use super::comb;
use crate::spec::DecompositionOptions;

/// Depths of places that occur, metres: from 0.8 m (Euro pallets along the aisle) to 1.3 m and what drift adds.
const DEPTHS_M: [f64; 2] = [0.8, 1.45];
/// Pitches of places that occur, metres.
const PITCHES_M: [f64; 2] = [0.8, 1.6];

/// Ranges of pitch and depth: those that the user gave, or those that occur.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SizeHints {
    /// Distance from one place to the next along the row, metres.
    pub pitch: [f64; 2],
    /// Depth of one place, metres.
    pub depth: [f64; 2],
}

impl SizeHints {
    pub fn of(options: &DecompositionOptions) -> Self {
        Self { pitch: options.pitch_m.unwrap_or(PITCHES_M), depth: options.depth_m.unwrap_or(DEPTHS_M) }
    }

    /// Widths that places at these pitches may have, metres.
    pub fn widths(&self) -> [f64; 2] {
        [self.pitch[0] - comb::NARROWER_M, self.pitch[1] + comb::WIDER_M]
    }
}
