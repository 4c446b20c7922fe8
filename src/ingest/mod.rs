//! Bytes -> occupancy grid, and the truth of a site.
//!
//! A map arrives as an image with `map_server` metadata, or as a `nav_msgs/OccupancyGrid` message in JSON. Cells are
//! read exactly as `nav2_map_server` reads them (`map_io.cpp`; see [`verdict`]); the files of the wild that loaders
//! stumble over are read with a warning where their meaning is plain, and refused with a remedy where it is not.
//!
//! Nothing here opens a file: the `image` entry of the metadata is never followed. Sizes are compared with the
//! [`Limits`] before anything of that size is allocated. Cost: O(bytes + cells), about six bytes a cell at the peak for
//! a grey image.

mod document;
mod message;
mod metadata;
mod picture;
mod truth;
mod verdict;

use serde::{Deserialize, Serialize};
use stillage_core::OccupancyGrid;
use stillage_core::analysis::Diagnostic;
use stillage_core::spec::GridOptions;

pub use metadata::image_entry;
pub use truth::ground_truth;

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
    // 100 million cells and 32,768 a side are what nav2 users proposed for its own loader (navigation2 issue 5612).
    fn default() -> Self {
        Self { max_bytes: 128 << 20, max_cells: 100_000_000, max_side: 32_768 }
    }
}

impl Limits {
    /// Checks the size of a map that is about to be read.
    fn check_size(&self, width: u64, height: u64, pointers: [&str; 2]) -> Result<(), IngestError> {
        for (side, name, pointer) in [(width, "wide", pointers[0]), (height, "high", pointers[1])] {
            if side == 0 {
                return Err(IngestError::invalid(
                    pointer,
                    format!("the map is 0 cells {name}: a map needs at least one cell"),
                ));
            }
            if side > u64::from(self.max_side) {
                let most = self.max_side;
                return Err(IngestError::too_large(
                    pointer,
                    format!("the map is {side} cells {name}, the most is {most}: crop it, or use a coarser resolution"),
                ));
            }
        }
        // Neither side exceeds 32 bits here, so the product fits.
        let (cells, most) = (width * height, self.max_cells);
        if cells > most {
            return Err(IngestError::too_large(
                pointers[0],
                format!("the map has {cells} cells, the most is {most}: crop it, or use a coarser resolution"),
            ));
        }
        Ok(())
    }
}

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

impl IngestError {
    fn too_large(pointer: impl Into<String>, message: impl Into<String>) -> Self {
        Self { refusal: Refusal::TooLarge, pointer: pointer.into(), message: message.into() }
    }

    fn unsupported(pointer: impl Into<String>, message: impl Into<String>) -> Self {
        Self { refusal: Refusal::UnsupportedFormat, pointer: pointer.into(), message: message.into() }
    }

    fn invalid(pointer: impl Into<String>, message: impl Into<String>) -> Self {
        Self { refusal: Refusal::Invalid, pointer: pointer.into(), message: message.into() }
    }
}

/// Reads a source.
///
/// # Errors
/// [`IngestError`] when it is too large, of an unknown format, or wrong.
pub fn decode(source: &MapSource, options: &GridOptions, limits: &Limits) -> Result<DecodedMap, IngestError> {
    let (bytes, pointer) = match source {
        MapSource::Image { image, metadata } => (image.len().saturating_add(metadata.len()), "/image"),
        MapSource::Message(message) => (message.len(), ""),
    };
    if bytes > limits.max_bytes {
        let most = limits.max_bytes;
        return Err(IngestError::too_large(pointer, format!("the upload has {bytes} bytes, the most is {most}")));
    }
    match source {
        MapSource::Image { image, metadata } => decode_image(image, metadata, options, limits),
        MapSource::Message(message) => message::decode(message, options, limits),
    }
}

/// Metadata first: it is small, and most mistakes are in it.
fn decode_image(
    image: &[u8],
    metadata: &[u8],
    options: &GridOptions,
    limits: &Limits,
) -> Result<DecodedMap, IngestError> {
    let mut warnings = Vec::new();
    let metadata = metadata::parse(metadata, &mut warnings)?;
    let thresholds = metadata.thresholds.overridden(options)?;
    let picture = picture::decode(image, limits)?;
    let reading = verdict::Reading { mode: metadata.mode, negate: metadata.negate, thresholds };
    warnings.extend(verdict::unknown_lost(&picture, reading));
    let cells = verdict::cells(&picture, reading);
    let grid = OccupancyGrid::new(picture.width, picture.height, metadata.frame, cells);
    Ok(DecodedMap { grid, warnings })
}

#[cfg(test)]
mod tests;
