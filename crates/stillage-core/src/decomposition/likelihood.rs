//! Scores as logarithms of a likelihood, less the description length of what explains the cells.
//!
//! Content that a model explains counts against the noise that remains; every place and every shape of loads costs its
//! description length (minimum description length, J. Rissanen 1978, doi 10.1016/0005-1098(78)90005-5).

/// Length along which the noise of content is the same, metres: the offset of goods from their mark, and the smoothing.
const CORRELATION_M: f64 = 0.2;
/// Share of the energy that is noise even where loads explain all of it.
pub(super) const LEAST_NOISE: f64 = 0.15;
/// Description length of a place: whether it is full and how wide it is, half a logarithm of its cells.
pub(super) const PLACE_COST: f64 = 1.5;
/// Description length of a load shape of its own: its dozen values, each half a logarithm of the cells of a row.
pub(super) const LOAD_COST: f64 = 25.0;

/// Factor from energy that is explained to a logarithm of a likelihood, where `noise` is the remaining energy per cell
/// and `cell` the side of a cell, metres.
pub(super) fn weight(noise: f64, cell: f64) -> f64 {
    cell / (2.0 * CORRELATION_M * noise)
}
