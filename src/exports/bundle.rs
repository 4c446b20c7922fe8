//! All exports of a map in one archive, with their checksums.
//!
//! Method: the files of all other exports, CSV in every profile; `manifest.json` tells of each its size, SHA-256 (FIPS
//! 180-4) and purpose, `SHA256SUMS` the same sums as `sha256sum --check` reads them. An export that has no place for
//! the map is left out and listed with the reason; an option that does not fit the map is an error. Messages to a vehicle
//! are for any vehicle. The same version of a map gives the same bytes.

use rayon::prelude::*;
use serde::Serialize;
use sha2::{Digest, Sha256};

use super::archive::NamedFile;
use super::list::{Export, ExportKind, SingleExport, list};
use super::locations_csv::{self, Profile};
use super::options::ExportOptions;
use super::single::{json, single};
use super::source::{CREATOR, ExportError, ExportSource};
use super::vda5050_header::Recipient;

/// What is in a bundle.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
struct Manifest<'a> {
    creator: &'static str,
    map_id: &'a str,
    map_name: &'a str,
    map_version: &'a str,
    created: String,
    files: Vec<BundledFile>,
    left_out: Vec<LeftOut>,
}

/// A file of a bundle.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct BundledFile {
    name: String,
    bytes: usize,
    sha256: String,
    purpose: &'static str,
}

/// An export that a bundle lacks.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct LeftOut {
    name: &'static str,
    reason: String,
}

/// SHA-256 of some bytes, in hexadecimal digits.
pub(super) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The files of a bundle.
pub(super) fn files(source: &ExportSource<'_>, options: &ExportOptions) -> Result<Vec<NamedFile>, ExportError> {
    let options = ExportOptions { recipient: Recipient::default(), link: None, ..options.clone() };
    let singles = list().par_iter().filter_map(|export| match export.kind {
        ExportKind::Single(kind) => Some((export, parts(export.name, kind, source, &options))),
        ExportKind::Bundle | ExportKind::DownloadMap => None,
    });
    let made: Vec<(&Export, Result<Vec<NamedFile>, ExportError>)> = singles.collect();
    let mut purposes = Vec::new();
    let mut files = Vec::new();
    let mut left_out = Vec::new();
    for (export, parts) in made {
        match parts {
            Ok(parts) => {
                purposes.extend(parts.iter().map(|_| export.purpose));
                files.extend(parts);
            }
            Err(misfit @ ExportError::UnknownLabel { .. }) => return Err(misfit),
            Err(reason) => left_out.push(LeftOut { name: export.name, reason: reason.to_string() }),
        }
    }
    let entry = |(file, &purpose): (&NamedFile, &&'static str)| BundledFile {
        name: file.name.clone(),
        bytes: file.bytes.len(),
        sha256: sha256(&file.bytes),
        purpose,
    };
    let entries: Vec<BundledFile> = files.par_iter().zip(&purposes).map(entry).collect();
    files.extend(manifest(source, entries, left_out));
    Ok(files)
}

/// The files that tell what the others are.
fn manifest(source: &ExportSource<'_>, files: Vec<BundledFile>, left_out: Vec<LeftOut>) -> [NamedFile; 2] {
    let sums: String = files.iter().map(|entry| format!("{}  {}\n", entry.sha256, entry.name)).collect();
    let manifest = Manifest {
        creator: CREATOR,
        map_id: source.map_id,
        map_name: source.name,
        map_version: source.version,
        created: source.created_text(),
        files,
        left_out,
    };
    [
        NamedFile { name: "manifest.json".to_owned(), bytes: json(&manifest) },
        NamedFile { name: "SHA256SUMS".to_owned(), bytes: sums.into_bytes() },
    ]
}

/// The files of one export: a CSV for each profile, one file of all others.
fn parts(
    name: &str,
    kind: SingleExport,
    source: &ExportSource<'_>,
    options: &ExportOptions,
) -> Result<Vec<NamedFile>, ExportError> {
    if kind != SingleExport::LocationsCsv {
        return Ok(vec![NamedFile { name: name.to_owned(), bytes: single(kind, source, options)? }]);
    }
    let table = |profile: Profile| NamedFile {
        name: format!("locations-{}.csv", profile.name()),
        bytes: locations_csv::locations(source, profile, &options.inventory),
    };
    Ok(Profile::ALL.map(table).into())
}
