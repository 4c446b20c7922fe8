//! How much memory a job will need, known before it is accepted: a job that does not fit is refused, not killed.

/// Bytes that an analysis needs at its peak for each cell of the grid.
///
/// The feature stage decides: up to 17 features of 4 bytes for each free cell; the grid, categories and regions take a
/// byte each, and the stages after it (when the features are gone) less. Measured on the service, process and all: 54
/// bytes on an office floor of 2.3 million cells, 105 on a hall of which every cell is free.
const BYTES_PER_CELL: u64 = 120;

/// Memory of a job on a map of this size, by estimate, bytes.
#[must_use]
pub fn job_bytes(width: u64, height: u64) -> u64 {
    width.saturating_mul(height).saturating_mul(BYTES_PER_CELL)
}
