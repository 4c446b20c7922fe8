//! Faces of the subdivision.

use std::sync::Arc;

use stillage_core::arrangement::{FaceId, Subdivision};

use super::common::{FUNCTIONALITY, LABEL, LABEL_NAME};
use crate::features::geometry::{Geometry, GeometryType};
use crate::features::property::{Kind, Property};
use crate::features::shape;
use crate::features::table::{Column, Table};
use crate::features::view::{AnalysedMap, LabelWords, rounded};
use crate::features::words;

/// A face.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceRow {
    id: u32,
    category: u8,
    category_shares: Vec<f64>,
    membership: Option<Vec<f64>>,
    label: Arc<LabelWords>,
    confidence: f64,
    evidence: &'static str,
    area: f64,
    /// Long and short side of the smallest box around it, metres.
    extent: [f64; 2],
    orientation: f64,
    elongation: f64,
    free_fraction: f64,
    occupied_fraction: f64,
    unknown_fraction: f64,
    region: u8,
    edges: Vec<u32>,
    place: Option<u32>,
    location: Option<String>,
    name: Option<String>,
}

/// The collection.
pub const TABLE: Table<FaceRow> = Table {
    title: "Faces",
    description: "The cells of the decomposition, with category, label and occupancy",
    geometry: GeometryType::AREAS,
    columns: &[
        Column::new(Property::new("id", Kind::Integer, "Id", "Number of the face"), |face| face.id.into()),
        Column::new(
            Property::new(
                "category",
                Kind::Integer,
                "Category",
                "Place category in force; those after the clusters are occupied, unknown and outside",
            ),
            |face| face.category.into(),
        ),
        Column::new(
            Property::new(
                "categoryShares",
                Kind::Numbers,
                "Category shares",
                "Share of each cluster among the categorized cells of the face",
            ),
            |face| face.category_shares.as_slice().into(),
        ),
        Column::new(
            Property::new(
                "membership",
                Kind::Numbers,
                "Membership",
                "Distribution over the clusters, where it differs from the category shares",
            )
            .nullable(),
            |face| face.membership.as_deref().into(),
        ),
        Column::new(LABEL, |face| face.label.id.as_str().into()),
        Column::new(LABEL_NAME, |face| face.label.name.as_str().into()),
        Column::new(FUNCTIONALITY, |face| face.label.functionality.as_slice().into()),
        Column::new(Property::new("confidence", Kind::Number, "Confidence", "How sure the label is, 0 to 1"), |face| {
            face.confidence.into()
        }),
        Column::new(
            Property::new(
                "evidence",
                Kind::Word(words::EVIDENCE),
                "Evidence",
                "Whether cells show most of the border, or it follows from its surroundings",
            ),
            |face| face.evidence.into(),
        ),
        Column::new(Property::new("areaM2", Kind::Number, "Area", "Area").unit("m2"), |face| face.area.into()),
        Column::new(
            Property::new("lengthM", Kind::Number, "Length", "Long side of the smallest box around it").unit("m"),
            |face| face.extent[0].into(),
        ),
        Column::new(Property::new("widthM", Kind::Number, "Width", "Short side of that box").unit("m"), |face| {
            face.extent[1].into()
        }),
        Column::new(
            Property::new(
                "orientation",
                Kind::Number,
                "Orientation",
                "Direction of the long side, counter-clockwise from the map's x axis, from -90 to 90",
            )
            .unit("deg"),
            |face| face.orientation.into(),
        ),
        Column::new(Property::new("elongation", Kind::Number, "Elongation", "Long side over short side"), |face| {
            face.elongation.into()
        }),
        Column::new(Property::new("freeFraction", Kind::Number, "Free", "Share of its cells that are free"), |face| {
            face.free_fraction.into()
        }),
        Column::new(
            Property::new("occupiedFraction", Kind::Number, "Occupied", "Share of its cells that are occupied"),
            |face| face.occupied_fraction.into(),
        ),
        Column::new(
            Property::new("unknownFraction", Kind::Number, "Unknown", "Share of its cells that are unknown"),
            |face| face.unknown_fraction.into(),
        ),
        Column::new(Property::new("region", Kind::Integer, "Region", "Id of its region"), |face| face.region.into()),
        Column::new(Property::new("edges", Kind::Integers, "Edges", "Ids of the edges around it, ascending"), |face| {
            face.edges.as_slice().into()
        }),
        Column::new(
            Property::new("place", Kind::Integer, "Place", "Id of the place it is part of").nullable(),
            |face| face.place.into(),
        ),
        Column::new(
            Property::new(
                "location",
                Kind::Text,
                "Location",
                "Code of the storage location it is; of the first one where it is cut into several",
            )
            .nullable(),
            |face| face.location.as_deref().into(),
        ),
        Column::new(
            Property::new("name", Kind::Text, "Name", "What people call its location, or the face in a correction")
                .nullable(),
            |face| face.name.as_deref().into(),
        ),
    ],
};

/// The faces of a map, by id.
#[must_use]
pub fn read(view: &AnalysedMap<'_>) -> Vec<(Geometry, FaceRow)> {
    let subdivision = &view.analysis.subdivision;
    let mut locations: Vec<Option<usize>> = vec![None; subdivision.face_count()];
    for (index, location) in view.layout.locations.iter().enumerate() {
        locations[location.face.index()].get_or_insert(index);
    }
    let labels = view.labels();
    let row = |face: FaceId| {
        let annotation = &view.analysis.faces[face.index()];
        let location = locations[face.index()];
        let name_of_location = location.and_then(|index| view.names.location(index).name);
        let numbers = |shares: &[f32]| shares.iter().map(|&share| rounded(f64::from(share))).collect::<Vec<f64>>();
        FaceRow {
            id: face.0,
            category: annotation.category,
            category_shares: numbers(&annotation.category_shares),
            membership: annotation.membership.as_deref().map(numbers),
            label: labels.of(view.semantic.labels[face.index()]),
            confidence: rounded(view.semantic.confidences[face.index()]),
            evidence: words::evidence(annotation.evidence),
            area: rounded(annotation.area),
            extent: annotation.extent.map(rounded),
            orientation: view.orientation_degrees(annotation.heading),
            elongation: rounded(annotation.elongation),
            free_fraction: rounded(annotation.free_fraction),
            occupied_fraction: rounded(annotation.occupied_fraction),
            unknown_fraction: rounded(annotation.unknown_fraction),
            region: annotation.region,
            edges: edges_around(subdivision, face),
            place: view.semantic.face_places[face.index()],
            location: location.map(|index| view.layout.locations[index].code.clone()),
            name: name_of_location.or_else(|| view.names.faces.get(&face.0).cloned()),
        }
    };
    subdivision.faces().map(|face| (shape::of_face(view, face), row(face))).collect()
}

/// The edges around a face, ascending, each once.
fn edges_around(subdivision: &Subdivision, face: FaceId) -> Vec<u32> {
    let mut edges: Vec<u32> = subdivision.boundary(face).map(|half| half.edge().0).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}
