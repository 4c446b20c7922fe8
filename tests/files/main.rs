//! Files in, files out: the ingest against real maps found in the wild, and `stillage analyze`.
//!
//! The maps lie beside the repository in `../shared/maps` (`STILLAGE_SHARED` names another place). Where they are
//! missing the tests say so and pass, except under `CI=true`.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::needless_pass_by_value,
    reason = "a test that unwraps says what it expects well enough"
)]

mod analyze;
mod authors_categories;
mod cases;
mod drawings;
mod evaluate;
mod export;
mod maps;
mod wild_metadata;

use std::path::{Path, PathBuf};

/// A folder of the shared material, `None` (with a printed line) where it is missing.
fn shared(folder: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    // Beside the repository, or a folder further up for a work tree of it.
    let roots = match std::env::var_os("STILLAGE_SHARED") {
        Some(path) => vec![PathBuf::from(path)],
        None => vec![root.join("../shared"), root.join("../../shared")],
    };
    let found = roots.iter().map(|root| root.join(folder)).find(|path| path.is_dir());
    if found.is_none() {
        assert!(std::env::var("CI").as_deref() != Ok("true"), "{folder} is missing in {roots:?}");
        println!("skipped: {folder} is missing in {roots:?} (STILLAGE_SHARED names another place)");
    }
    found
}
