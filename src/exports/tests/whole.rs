//! All exports at once.

use std::collections::BTreeSet;

use stillage_core::graph::NavigationGraph;

use super::Site;
use crate::exports::{Export, ExportOptions, ExportSource, list, write};

fn options() -> ExportOptions {
    ExportOptions { link: Some("https://maps.example/bundle.zip".to_owned()), ..ExportOptions::default() }
}

#[test]
fn every_export_has_a_name_of_its_own_and_the_same_bytes_each_time() {
    let source = Site::whole().source();
    let options = options();
    let names: BTreeSet<&str> = list().iter().map(|export| export.name).collect();
    assert_eq!(names.len(), list().len());
    for export in list() {
        assert_eq!(Export::find(export.name), Some(export));
        let bytes = write(export, &source, &options).unwrap();
        assert!(!bytes.is_empty(), "{}", export.name);
        assert_eq!(bytes, write(export, &source, &options).unwrap(), "{}", export.name);
    }
}

#[test]
fn exports_without_a_radius_do_not_read_the_graph() {
    let (source, empty) = (Site::whole().source(), NavigationGraph::default());
    for export in list().iter().filter(|export| !export.reads_graph()) {
        let without = write(export, &ExportSource { graph: &empty, ..source }, &options()).unwrap();
        assert_eq!(without, write(export, &source, &options()).unwrap(), "{}", export.name);
    }
}
