//! Bytes -> occupancy grid, the truth of a site, and names and corrections that people bring along.
//!
//! A map arrives as an image with `map_server` metadata, or as a `nav_msgs/OccupancyGrid` message in JSON or
//! YAML. Cells are
//! read as `nav2_map_server` reads them (`map_io.cpp`), but for one mistake that many files make ([`verdict`]); the files of the wild that loaders
//! stumble over are read with a warning where their meaning is plain, and refused with a remedy where it is not.
//!
//! Nothing here opens a file: the `image` entry of the metadata is never followed. Sizes are compared with the
//! [`Limits`] before anything of that size is allocated. Cost: O(bytes + cells), about six bytes a cell at the peak for
//! a grey image.

mod corrections;
mod document;
mod error;
mod geojson;
mod limits;
mod message;
mod metadata;
mod names;
mod picture;
mod source;
mod truth;
mod verdict;

use stillage_core::analysis::Diagnostic;
use stillage_core::spec::{GridOptions, GridSemantics};
use stillage_core::{Occupancy, OccupancyGrid};

pub use corrections::{CorrectionFeature, correction_features};
pub use error::{IngestError, Refusal};
pub use limits::Limits;
pub use message::is_message;
pub use metadata::image_entry;
pub use names::{NameRow, NameTarget, NamedCollection, name_areas, name_table};
pub use source::{DecodedMap, MapSource};
pub use truth::ground_truth;

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
    let mut picture = picture::decode(image, limits)?;
    if options.semantics == GridSemantics::Intended && picture.is_nowhere_opaque() {
        let message = "no pixel of the image is fully opaque, so opacity was not taken for unknown and the grey levels \
                       were read; to keep the letter of nav2, set options.grid.semantics: \"nav2\"";
        warnings.push(Diagnostic::new("opacity-ignored", message));
        picture.transparent.clear();
    }
    let mut reading = verdict::Reading { mode: metadata.mode, negate: metadata.negate, thresholds };
    if let Some(loss) = verdict::unknown_lost(&picture, reading) {
        let may_mend = options.semantics == GridSemantics::Intended && options.free_threshold.is_none();
        match loss.mended().filter(|_| may_mend) {
            Some((mended, word)) => {
                reading = mended;
                warnings.push(word);
            }
            None => warnings.push(loss.warning()),
        }
    }
    let cells = verdict::cells(&picture, reading);
    if !picture.transparent.is_empty() && !cells.contains(&Occupancy::Free) {
        let message = "no opaque pixel is free: transparent pixels were read as unknown, as nav2 reads them; if they are \
                       the floor, save the image without transparency";
        warnings.push(Diagnostic::new("transparent-floor", message));
    }
    let grid = OccupancyGrid::new(picture.width, picture.height, metadata.frame, cells);
    Ok(DecodedMap { grid, warnings })
}

#[cfg(test)]
mod tests;
