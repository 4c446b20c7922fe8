//! Core types -> GeoJSON features of the ten collections.
//!
//! A [`Feature`] carries its geometry in map-frame metres; a [`Transform`] writes it in the coordinates a client asked
//! for. What all properties have in common: lengths are metres and areas square metres; orientations and headings are
//! degrees counter-clockwise from the map's x axis (orientations of undirected lines in [-90, 90), headings in
//! [-180, 180)); positions among the properties are map-frame metres whatever the coordinates of the geometry.
//! Numbers are rounded to four decimals: a tenth of a millimetre.
//!
//! Pure; O(size of the collection).

mod csv;
mod decomposition;
mod feature;
mod rings;
mod semantics;
mod subdivision;
mod transform;

#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};
use stillage_core::Analysis;
use stillage_core::layout::Location;
use stillage_core::semantics::SemanticMap;

pub use csv::locations_csv;
pub use feature::{Feature, FeatureId, Geometry, feature_collection};
pub use transform::Transform;

/// The collections of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Collection {
    /// Faces of the subdivision, with their labels.
    Faces,
    /// Edges of the subdivision, with their cogency.
    Edges,
    /// Vertices of the subdivision.
    Vertices,
    /// Nodes of the adjacency graph.
    Nodes,
    /// Links of the adjacency graph, with their connectivity.
    Links,
    /// Lines that the radiography found.
    Lines,
    /// Regions of one texture.
    Regions,
    /// Rooms, and mutually open faces of one label, merged.
    Places,
    /// Narrow passages between places.
    Doors,
    /// Storage locations.
    Locations,
}

impl Collection {
    /// All of them, in the order in which they are listed.
    pub const ALL: [Self; 10] = [
        Self::Faces,
        Self::Edges,
        Self::Vertices,
        Self::Nodes,
        Self::Links,
        Self::Lines,
        Self::Regions,
        Self::Places,
        Self::Doors,
        Self::Locations,
    ];

    /// The id in URLs and file names.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Faces => "faces",
            Self::Edges => "edges",
            Self::Vertices => "vertices",
            Self::Nodes => "nodes",
            Self::Links => "links",
            Self::Lines => "lines",
            Self::Regions => "regions",
            Self::Places => "places",
            Self::Doors => "doors",
            Self::Locations => "locations",
        }
    }

    /// The collection with an id.
    #[must_use]
    pub fn find(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|collection| collection.id() == id)
    }
}

/// Where the map frame lies on Earth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Georeference {
    /// Longitude of the map frame's origin, degrees.
    pub lon: f64,
    /// Latitude of the map frame's origin, degrees.
    pub lat: f64,
    /// Compass heading of the map frame's y axis, degrees clockwise from north.
    #[serde(default)]
    pub heading: f64,
}

/// Coordinates of an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Crs {
    /// Longitude, latitude.
    #[default]
    Crs84,
    /// EPSG:3857; for a map without georeference these are the metres of the map frame.
    WebMercator,
}

/// A map ready to be written.
#[derive(Debug, Clone, Copy)]
pub struct MapView<'a> {
    /// The geometric level.
    pub analysis: &'a Analysis,
    /// The human level.
    pub semantic: &'a SemanticMap,
    /// The storage locations, by code.
    pub locations: &'a [Location],
    /// Where the map frame lies on Earth; nominal, at (0, 0), when absent.
    pub georeference: Option<Georeference>,
}

/// The features of a collection, by id (locations: by code).
#[must_use]
pub fn features(view: &MapView<'_>, collection: Collection) -> Vec<Feature> {
    match collection {
        Collection::Faces => subdivision::faces(view),
        Collection::Edges => subdivision::edges(view),
        Collection::Vertices => subdivision::vertices(view),
        Collection::Nodes => subdivision::nodes(view),
        Collection::Links => subdivision::links(view),
        Collection::Lines => decomposition::lines(view),
        Collection::Regions => decomposition::regions(view),
        Collection::Places => semantics::places(view),
        Collection::Doors => semantics::doors(view),
        Collection::Locations => semantics::locations(view),
    }
}

/// Rounds to four decimals.
fn rounded(value: f64) -> f64 {
    // Adding 0 turns -0 into 0.
    (value * 1e4).round() / 1e4 + 0.0
}

/// An undirected line's angle in the grid frame -> degrees in the map frame, `[-90, 90)`.
fn orientation_degrees(view: &MapView<'_>, angle: f64) -> f64 {
    let degrees =
        rounded(stillage_core::geometry::fold_half_turn(view.analysis.frame.angle_to_map(angle)).to_degrees());
    if degrees >= 90.0 { degrees - 180.0 } else { degrees }
}

/// A direction in the grid frame -> degrees in the map frame, `[-180, 180)`.
fn heading_degrees(view: &MapView<'_>, angle: f64) -> f64 {
    let turned = (view.analysis.frame.angle_to_map(angle).to_degrees() + 180.0).rem_euclid(360.0) - 180.0;
    let degrees = rounded(turned);
    if degrees >= 180.0 { degrees - 360.0 } else { degrees }
}
