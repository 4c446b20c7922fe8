//! Any export as bytes.

use super::archive::zip;
use super::bundle;
use super::list::{Export, ExportKind};
use super::options::ExportOptions;
use super::single::{json, single};
use super::source::{ExportError, ExportSource};
use super::vda5050_download_map::download_map;

/// Writes an export of a map.
///
/// # Errors
/// [`ExportError`] when the format has no place for the map, or an option does not fit it.
pub fn write(export: &Export, source: &ExportSource<'_>, options: &ExportOptions) -> Result<Vec<u8>, ExportError> {
    let bundle = || bundle::files(source, options).map(|files| zip(&files));
    match export.kind {
        ExportKind::Single(export) => single(export, source, options),
        ExportKind::Bundle => bundle(),
        ExportKind::DownloadMap => {
            let link = options.link.as_deref().ok_or(ExportError::NoLink)?;
            Ok(json(&download_map(source, &options.recipient, link, bundle::sha256(&bundle()?))))
        }
    }
}
