//! All collections of a map as a `GeoPackage`, for geographic information systems.

use super::source::ExportSource;
use crate::coordinates::{Crs, Transform};
use crate::features::{Collection, features};
use crate::formats::geopackage::{self, PackageLayer};

/// The collections in the system in which nothing is lost: of a map without georeference the metres of its frame.
pub(super) fn map(source: &ExportSource<'_>) -> Vec<u8> {
    let systems = Crs::of_map(source.georeference);
    let crs = systems.last().copied().unwrap_or_default();
    let view = source.view();
    let layers = Collection::ALL.map(|collection| PackageLayer { collection, features: features(&view, collection) });
    geopackage::file(&layers, &Transform::new(crs, source.georeference), &source.created_text())
}
