//! Core types -> wire shape. (to be written)

use serde::{Deserialize, Serialize};
use stillage_core::Analysis;
use stillage_core::layout::Location;
use stillage_core::semantics::SemanticMap;

/// The collections of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Collection {
    Faces,
    Edges,
    Vertices,
    Nodes,
    Links,
    Lines,
    Regions,
    Places,
    Locations,
}

impl Collection {
    /// All of them, in the order in which they are listed.
    pub const ALL: [Self; 9] = [
        Self::Faces,
        Self::Edges,
        Self::Vertices,
        Self::Nodes,
        Self::Links,
        Self::Lines,
        Self::Regions,
        Self::Places,
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
