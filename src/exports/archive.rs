//! Files, and a zip archive of them.
//!
//! Source: PKWARE APPNOTE 6.3, through the crate `zip`. Every entry has the earliest time that the format can tell, so
//! that the same files give the same bytes.

use std::io::{Cursor, Write as _};

use rayon::prelude::*;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

/// A file with its name in an archive.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedFile {
    /// Name without folders.
    pub name: String,
    /// Content.
    pub bytes: Vec<u8>,
}

/// How hard files are packed, 1 to 9. Level 6 makes the bundle of a site of the paper's size slower by half.
const LEVEL: i64 = 1;
const FITS: &str = "an archive in memory takes every file";

/// Packs files, on all threads.
#[must_use]
#[allow(clippy::missing_panics_doc, reason = "memory takes every byte")]
pub fn zip(files: &[NamedFile]) -> Vec<u8> {
    let packed: Vec<Vec<u8>> = files.par_iter().map(zip_one).collect();
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for archive in packed {
        writer.merge_archive(ZipArchive::new(Cursor::new(archive)).expect(FITS)).expect(FITS);
    }
    writer.finish().expect(FITS).into_inner()
}

/// An archive of one file.
fn zip_one(NamedFile { name, bytes }: &NamedFile) -> Vec<u8> {
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(LEVEL))
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644);
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    writer.start_file(name.as_str(), options.large_file(bytes.len() > u32::MAX as usize)).expect(FITS);
    writer.write_all(bytes).expect(FITS);
    writer.finish().expect(FITS).into_inner()
}
