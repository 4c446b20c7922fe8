//! How much memory a job will need, known before it is accepted: a job that does not fit is refused, not killed.

/// Bytes that an analysis needs at its peak for each cell of the grid.
///
/// The feature stage decides: 17 features of 4 bytes for each free cell, their scaled copy for the clustering being made
/// in place, 32 bytes of gradients or texture energies in the stages after it (when the features are gone), and the
/// grid, categories, regions and faces at 1 to 4 bytes each.
const BYTES_PER_CELL: u64 = 120;

/// Memory of a job on a map of this size, by estimate, bytes.
#[must_use]
pub fn job_bytes(width: u64, height: u64) -> u64 {
    width.saturating_mul(height).saturating_mul(BYTES_PER_CELL)
}
