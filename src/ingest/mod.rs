//! Bytes -> occupancy grid. (to be written: images, map_server YAML, OccupancyGrid JSON, nav2 semantics, limits)

use serde::{Deserialize, Serialize};
use stillage_core::OccupancyGrid;
use stillage_core::analysis::Diagnostic;
use stillage_core::spec::GridOptions;

/// Limits on uploaded maps, applied before anything is decoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of an upload.
    pub max_bytes: usize,
    /// Cells of a map.
    pub max_cells: u64,
    /// Columns or rows of a map.
    pub max_side: u32,
}

impl Default for Limits {
    fn default() -> Self {
        Self { max_bytes: 128 << 20, max_cells: 100_000_000, max_side: 32_768 }
    }
}

/// A map as it was uploaded: what is stored, and decoded again whenever the grid is needed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub enum MapSource {
    /// An image with map_server metadata (YAML, or the same keys as JSON).
    Image {
        /// The image file.
        image: Vec<u8>,
        /// The metadata file.
        metadata: Vec<u8>,
    },
    /// A `nav_msgs/OccupancyGrid` message as JSON.
    Message(Vec<u8>),
}

/// A grid read from a source.
#[derive(Debug, Clone)]
pub struct DecodedMap {
    /// The grid.
    pub grid: OccupancyGrid,
    /// What was odd but could be read (an `image:` path of another machine, thresholds that swallow unknown cells ...).
    pub warnings: Vec<Diagnostic>,
}

/// Which kind of refusal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// Over a limit: 413.
    TooLarge,
    /// Not a format that is read: 415.
    UnsupportedFormat,
    /// Read, and found wrong: 422.
    Invalid,
}

/// A source that cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct IngestError {
    /// Which kind of refusal.
    pub refusal: Refusal,
    /// JSON pointer to the culprit: `/image`, `/metadata/resolution`, `/info/width` ...
    pub pointer: String,
    /// What is wrong, where, and how to mend it.
    pub message: String,
}

/// Reads a source.
///
/// # Errors
/// [`IngestError`] when it is too large, of an unknown format, or wrong.
pub fn decode(source: &MapSource, options: &GridOptions, limits: &Limits) -> Result<DecodedMap, IngestError> {
    let _ = (source, options, limits);
    todo!()
}
