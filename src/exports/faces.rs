//! The faces with their properties as `FlatGeobuf`, for geographic information systems.

use super::source::ExportSource;
use crate::coordinates::{Crs, Transform};
use crate::features::query::PropertySelection;
use crate::features::{Collection, features};
use crate::formats::flatgeobuf;

/// The faces in a system of coordinates.
pub(super) fn faces(source: &ExportSource<'_>, crs: Crs) -> Vec<u8> {
    let faces = features(&source.view(), Collection::Faces);
    let all = PropertySelection::all(Collection::Faces);
    flatgeobuf::collection(&all, &faces, &Transform::new(crs, source.georeference))
}
