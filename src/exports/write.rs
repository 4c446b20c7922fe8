//! Any export as bytes.

use super::archive::zip;
use super::bundle;
use super::list::{Export, ExportKind, ExportOptions};
use super::single::{json, single};
use super::source::{ExportError, ExportSource};
use super::vda5050_download_map::download_map;

/// Writes an export of a map.
///
/// # Errors
/// [`ExportError`] when the format has no place for the map.
pub fn write(export: &Export, source: &ExportSource<'_>, options: &ExportOptions) -> Result<Vec<u8>, ExportError> {
    let bundle = || zip(&bundle::files(source, options));
    match export.kind {
        ExportKind::Single(export) => single(export, source, options),
        ExportKind::Bundle => Ok(bundle()),
        ExportKind::DownloadMap => Ok(json(&download_map(source, &options.download, bundle::sha256(&bundle())))),
    }
}
