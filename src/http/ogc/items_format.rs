//! The formats in which features are served.

use crate::http::extract::format;
use crate::http::extract::negotiation::Accept;
use crate::http::links::{CSV, FLAT_GEOBUF, GEO_JSON, HTML, JSON_FG};

/// A format of features.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    GeoJson,
    JsonFg,
    Html,
    Csv,
    FlatGeobuf,
}

impl Format {
    /// All of them; the first is the default.
    pub const ALL: [Self; 5] = [Self::GeoJson, Self::JsonFg, Self::Html, Self::Csv, Self::FlatGeobuf];
    /// Those of a single feature.
    pub const OF_ONE: [Self; 3] = [Self::GeoJson, Self::JsonFg, Self::Html];

    /// The one of these that the client wants most.
    pub fn wanted<const N: usize>(accept: &Accept, formats: [Self; N]) -> Self {
        let media_type = accept.best(&formats.map(Self::media_type));
        formats.into_iter().find(|format| format.media_type() == media_type).unwrap_or(Self::GeoJson)
    }

    /// Its media type.
    pub const fn media_type(self) -> &'static str {
        match self {
            Self::GeoJson => GEO_JSON,
            Self::JsonFg => JSON_FG,
            Self::Html => HTML,
            Self::Csv => CSV,
            Self::FlatGeobuf => FLAT_GEOBUF,
        }
    }

    /// Its name as the parameter `f`.
    pub fn name(self) -> &'static str {
        format::name(self.media_type())
    }

    /// Whether a file is downloaded whole where no limit is given.
    pub const fn is_whole(self) -> bool {
        matches!(self, Self::Csv | Self::FlatGeobuf)
    }

    /// What it is, for people.
    pub const fn title(self) -> &'static str {
        match self {
            Self::GeoJson => "As GeoJSON",
            Self::JsonFg => "As JSON-FG, with metres",
            Self::Html => "As a page",
            Self::Csv => "As a table",
            Self::FlatGeobuf => "As FlatGeobuf",
        }
    }
}
