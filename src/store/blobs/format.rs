//! Values as bytes: one format byte, then a zstd frame of the value in postcard.
//!
//! Postcard writes the members of a type in their order and nothing else, so every change of a stored type changes the
//! layout. The format byte tells the layouts of one type apart; it is raised with each change, and [`Stored::upgrade`]
//! rewrites the earlier ones. `tests` keeps bytes of every format.
//!
//! Release 0.1 wrote no format byte. Its blobs begin with the magic number of a zstd frame, 28 B5 2F FD
//! (RFC 8878, 3.1.1), so no format has the number 0x28, and what begins with it has format 0.

use serde::Serialize;
use serde::de::DeserializeOwned;
use stillage_core::grid::GridFrame;
use stillage_core::spec::{
    AnnotationOptions, CategorizationOptions, DecompositionOptions, GridOptions, OrientationOptions, RegionOptions,
};
use stillage_core::{Analysis, AnalysisOptions};

use crate::ingest::MapSource;

/// First byte of a zstd frame, where a blob has no format byte.
const FRAME: u8 = 0x28;

/// zstd's own default: category maps shrink about tenfold at several hundred MB/s.
const COMPRESSION_LEVEL: i32 = 3;

/// A type whose values are kept as blobs.
pub trait Stored: Serialize + DeserializeOwned {
    /// The format that is written.
    const FORMAT: u8;

    /// Rewrites postcard bytes of an earlier format in [`Self::FORMAT`]; `None` when that format is no longer read.
    fn upgrade(format: u8, plain: Vec<u8>) -> Option<Vec<u8>>;
}

impl Stored for MapSource {
    const FORMAT: u8 = 1;

    /// Format 0 has the layout of format 1. Uploads are read for ever: they cannot be made again.
    fn upgrade(_: u8, plain: Vec<u8>) -> Option<Vec<u8>> {
        Some(plain)
    }
}

impl Stored for Analysis {
    const FORMAT: u8 = 2;

    /// Up to format 1 the options of the grid were two thresholds. Format 0 had the first seven groups of the options
    /// alone; what was added since has its default. All before and after the options is the same.
    fn upgrade(format: u8, plain: Vec<u8>) -> Option<Vec<u8>> {
        let (_, from_options): ((GridFrame, usize, usize), _) = postcard::take_from_bytes(&plain).ok()?;
        let before = &plain[..plain.len() - from_options.len()];
        let (first, rest): (FirstOptions, _) = postcard::take_from_bytes(from_options).ok()?;
        let (seed, occupied_threshold, free_threshold) = first;
        let grid = GridOptions { occupied_threshold, free_threshold, ..GridOptions::default() };
        let mut options = postcard::to_stdvec(&(seed, grid)).ok()?;
        let mut after = rest;
        if format == 0 {
            let (_, from_declutter): (GroupsOfFormat0, _) = postcard::take_from_bytes(rest).ok()?;
            options.extend_from_slice(&rest[..rest.len() - from_declutter.len()]);
            options.extend(postcard::to_stdvec(&AnalysisOptions::default().declutter).ok()?);
            after = from_declutter;
        }
        Some([before, &options, after].concat())
    }
}

/// Seed and thresholds, with which the options began up to format 1.
type FirstOptions = (u64, Option<f64>, Option<f64>);

/// The options of format 0 that follow them, in their order.
type GroupsOfFormat0 =
    (CategorizationOptions, OrientationOptions, RegionOptions, DecompositionOptions, AnnotationOptions);

/// Why bytes are not a value.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum FormatError {
    /// They are not what was written.
    Damaged(String),
    /// This release does not read their format.
    Unreadable(String),
}

pub(super) fn encode<T: Stored>(value: &T) -> Vec<u8> {
    let plain = postcard::to_stdvec(value).expect("stored types have sequences of known length");
    let frame = zstd::encode_all(plain.as_slice(), COMPRESSION_LEVEL).expect("memory can be read and written");
    [&[T::FORMAT], frame.as_slice()].concat()
}

pub(super) fn decode<T: Stored>(bytes: &[u8]) -> Result<T, FormatError> {
    let (format, frame) = match bytes {
        [] => return Err(FormatError::Damaged("it is empty".into())),
        [FRAME, ..] => (0, bytes),
        [format, frame @ ..] => (*format, frame),
    };
    if format > T::FORMAT {
        let known = T::FORMAT;
        return Err(FormatError::Unreadable(format!(
            "it was stored by a newer release (format {format}, this one reads up to {known}): run the newer release"
        )));
    }
    let plain = zstd::decode_all(frame).map_err(|error| FormatError::Damaged(error.to_string()))?;
    if format == T::FORMAT {
        return read(&plain).map_err(FormatError::Damaged);
    }
    let upgraded = T::upgrade(format, plain).and_then(|plain| read(&plain).ok());
    upgraded.ok_or_else(|| {
        FormatError::Unreadable(format!(
            "it was stored by an earlier release (format {format}) and cannot be read any more: analyse the map again"
        ))
    })
}

/// Reads all of the bytes: some that are left over belong to another layout.
fn read<T: DeserializeOwned>(plain: &[u8]) -> Result<T, String> {
    match postcard::take_from_bytes(plain) {
        Ok((value, [])) => Ok(value),
        Ok((_, rest)) => Err(format!("{} bytes are left over", rest.len())),
        Err(error) => Err(error.to_string()),
    }
}

#[cfg(test)]
mod tests;
