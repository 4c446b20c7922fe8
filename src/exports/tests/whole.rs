//! All exports at once.

use std::collections::BTreeSet;
use std::path::Path;

use super::Site;
use crate::exports::{Export, ExportOptions, list, write};

#[test]
fn every_export_has_a_name_of_its_own_and_the_same_bytes_each_time() {
    let source = Site::whole().source();
    let options = ExportOptions::default();
    let names: BTreeSet<&str> = list().iter().map(|export| export.name).collect();
    assert_eq!(names.len(), list().len());
    for export in list() {
        assert_eq!(Export::find(export.name), Some(export));
        let bytes = write(export, &source, &options).unwrap();
        assert!(!bytes.is_empty(), "{}", export.name);
        assert_eq!(bytes, write(export, &source, &options).unwrap(), "{}", export.name);
    }
}

/// Writes all exports of the hall to the folder that `STILLAGE_EXPORTS` names, for `tests/exports/validate.py`.
#[test]
fn exports_for_the_validator() {
    let Some(folder) = std::env::var_os("STILLAGE_EXPORTS") else { return };
    std::fs::create_dir_all(&folder).unwrap();
    for export in list() {
        let bytes = write(export, &Site::whole().source(), &ExportOptions::default()).unwrap();
        std::fs::write(Path::new(&folder).join(export.name), bytes).unwrap();
    }
}
