//! The faces with their properties as `FlatGeobuf`, for geographic information systems.

use super::source::ExportSource;
use crate::coordinates::{Crs, Transform};
use crate::features::{Collection, features};
use crate::formats::flatgeobuf;

/// The faces in a system of coordinates.
pub(super) fn faces(source: &ExportSource<'_>, crs: Crs) -> Vec<u8> {
    let faces = features(&source.view(), Collection::Faces);
    flatgeobuf::collection(Collection::Faces, &faces, &Transform::new(crs, source.georeference))
}
