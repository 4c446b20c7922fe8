//! Maps: pictures, their metadata, messages.

use stillage::ingest::{DecodedMap, IngestError, Limits, MapSource, decode};
use stillage_core::spec::GridOptions;

use super::check_refusal;

/// Small enough that a picture of that size is decoded in a moment.
const LIMITS: Limits = Limits { max_bytes: 1 << 20, max_cells: 1 << 20, max_side: 4_096 };
/// Longest pointer to what is wrong, bytes.
const LONGEST_POINTER: usize = 100;
const METADATA: &[u8] =
    b"image: map.png\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
/// Three pixels: occupied, unknown, free.
const IMAGE: &[u8] = b"P5\n3 1\n255\n\x00\xcd\xfe";

/// The picture of a map.
pub fn map_image(bytes: &[u8]) {
    check(read(&MapSource::Image { image: bytes.to_vec(), metadata: METADATA.to_vec() }));
}

/// The metadata beside a picture.
pub fn map_metadata(bytes: &[u8]) {
    check(read(&MapSource::Image { image: IMAGE.to_vec(), metadata: bytes.to_vec() }));
}

/// An `OccupancyGrid` message, as JSON or as YAML.
pub fn map_message(bytes: &[u8]) {
    check(read(&MapSource::Message(bytes.to_vec())));
}

fn read(source: &MapSource) -> Result<DecodedMap, IngestError> {
    decode(source, &GridOptions::default(), &LIMITS)
}

fn check(answer: Result<DecodedMap, IngestError>) {
    match answer {
        Ok(map) => {
            let cells = map.grid.width() * map.grid.height();
            assert!(cells > 0 && cells as u64 <= LIMITS.max_cells);
            map.warnings.iter().for_each(|warning| check_refusal(&warning.message));
        }
        Err(error) => {
            assert!(error.pointer.len() <= LONGEST_POINTER, "{}", error.pointer);
            check_refusal(&error);
        }
    }
}
