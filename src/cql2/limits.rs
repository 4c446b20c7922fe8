//! How much a filter may ask for. Beyond these it is refused before anything is computed.

use super::error::FilterError;

/// Longest filter, bytes: as long as the longest address the service takes.
pub const MAX_BYTES: usize = 64 * 1024;

/// Most levels of parentheses, operators and functions within one another. `AND` and `OR` join any number of conditions
/// on one level. `serde_json` reads 128 levels, and an operator with its arguments takes two of them.
pub const MAX_DEPTH: usize = 64;

/// Most positions of all geometries of a filter: whether a ring crosses itself is found by comparing all its sides.
pub const MAX_POSITIONS: usize = 2048;

/// Most spatial functions of a filter: each may be computed for each feature, which takes some microseconds.
pub const MAX_SPATIAL: usize = 100;

/// Refuses a filter that is empty or too long.
pub fn check_length(text: &str) -> Result<(), FilterError> {
    if text.len() > MAX_BYTES {
        return Err(FilterError::new(format!("is longer than {MAX_BYTES} bytes")));
    }
    if text.trim_ascii().is_empty() { Err(FilterError::new("is empty")) } else { Ok(()) }
}
