//! Whole filters: the test data and the examples of the standard, wrong filters, filters that are too much, any text.

mod any_filter;
mod examples;
mod hostile;
mod json_writer;
mod places;
mod standard_data;
mod standard_rows;
mod wrong;

use std::path::{Path, PathBuf};

use super::FilterCoordinates;

/// Degrees that stay as they are.
const DEGREES: FilterCoordinates<'static> = FilterCoordinates { are_degrees: true, to_data: &|position| position };

/// A file or folder of the standard, `None` (with a printed line) where it is missing.
fn standard(path: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let roots = match std::env::var_os("STILLAGE_SHARED") {
        Some(path) => vec![PathBuf::from(path)],
        None => vec![root.join("../shared")],
    };
    let found = roots.iter().map(|root| root.join("schemas/cql2-1.0").join(path)).find(|path| path.exists());
    if found.is_none() {
        assert!(std::env::var("CI").as_deref() != Ok("true"), "{path} is missing in {roots:?}");
        eprintln!("skipped: {path} is missing in {roots:?} (STILLAGE_SHARED names another place)");
    }
    found
}
