//! A map as bytes, and as a grid.

use serde::{Deserialize, Serialize};
use stillage_core::OccupancyGrid;
use stillage_core::analysis::Diagnostic;

/// A map as it was uploaded: what is stored, and decoded again whenever the grid is needed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub enum MapSource {
    /// An image with `map_server` metadata (YAML, or the same keys as JSON).
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
