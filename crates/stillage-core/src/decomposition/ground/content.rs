//! How much the cells of a line count as goods.

/// What an unknown cell counts beside an occupied one (accuracy study: goods hide what is in them).
pub(crate) const UNKNOWN_CONTENT: f64 = 0.6;
/// Known share of a line below which the robot did not look at it: sensors see the fronts of goods at least.
const LEAST_KNOWN: f64 = 0.04;

/// Content of a line of cells by the shares of it that are occupied, unknown and known; 0 where the robot did not look.
pub(crate) fn content(occupied: f64, unknown: f64, known: f64) -> f64 {
    if known < LEAST_KNOWN { 0.0 } else { occupied + UNKNOWN_CONTENT * unknown }
}
