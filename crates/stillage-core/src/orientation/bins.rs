//! Bins of directions over half a turn.

use std::f64::consts::PI;

/// Angle of a position among `bins` bins over `[-pi/2, pi/2)`; bin `i` has its centre at `i`.
pub(super) fn angle_at(position: f64, bins: usize) -> f64 {
    (position + 0.5) * PI / bins as f64 - PI / 2.0
}
