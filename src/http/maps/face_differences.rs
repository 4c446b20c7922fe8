//! Faces that are different, as GeoJSON.

use stillage_core::compare::{FaceDifference, LabelledFace};

use crate::app::MapContext;
use crate::coordinates::Transform;
use crate::features::{Collection, Feature, FeatureId};
use crate::formats::Json;
use crate::formats::geojson::{self, GeoJsonFeature};
use crate::views::face_difference::DifferentFace;

/// The GeoJSON of faces that are different between two readings of a map: so many features, and `members` beside them. A face
/// is shown as it is now, with its id; also as it was, without one, where its shape changed or it is gone.
pub fn written(
    (before, now): (&MapContext, &MapContext),
    differences: &[FaceDifference],
    limit: usize,
    transform: &Transform,
    members: &[(&'static str, &dyn Json)],
) -> Vec<u8> {
    let (before, now) = (before.features(Collection::Faces), now.features(Collection::Faces));
    let shown = differences.iter().flat_map(|difference| {
        let was = difference.before.as_ref().filter(|_| difference.is_reshaped || difference.now.is_none());
        let shapes = [
            (was.and_then(|face| find(before, face)), true),
            (difference.now.as_ref().and_then(|face| find(now, face)), false),
        ];
        shapes
            .into_iter()
            .filter_map(move |(shape, is_before)| Some((shape?, DifferentFace::new(difference, is_before), is_before)))
    });
    let shown: Vec<(&Feature, DifferentFace<'_>, bool)> = shown.collect();
    let documents = shown.iter().take(limit).map(|(face, properties, is_before)| GeoJsonFeature {
        id: Some(&face.id).filter(|_| !is_before),
        geometry: &face.geometry,
        properties,
        members: &[],
    });
    let (matched, returned) = (shown.len(), shown.len().min(limit));
    let mut all: Vec<(&str, &dyn Json)> = vec![("numberMatched", &matched), ("numberReturned", &returned)];
    all.extend(members.iter().copied());
    geojson::document_collection(documents, transform, &all)
}

fn find<'a>(faces: &'a [Feature], face: &LabelledFace) -> Option<&'a Feature> {
    let id = FeatureId::Number(face.face.0.into());
    faces.binary_search_by(|face| face.id.cmp(&id)).ok().map(|index| &faces[index])
}
