//! Coordinate reference systems as clients name them.

use axum::http::HeaderValue;
use serde::Deserialize;
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{ObjectBuilder, Schema, Type};
use utoipa::{PartialSchema, ToSchema};

use crate::coordinates::Crs;

/// Longitude, latitude in degrees: the default.
pub const CRS84: &str = "http://www.opengis.net/def/crs/OGC/1.3/CRS84";
/// Web Mercator. Of a map without georeference these are the metres of the map frame.
pub const EPSG_3857: &str = "http://www.opengis.net/def/crs/EPSG/0/3857";

/// A coordinate reference system as a parameter: its OGC URI or its short form.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct CrsName(pub Crs);

impl PartialSchema for CrsName {
    fn schema() -> RefOr<Schema> {
        let names = [CRS84, EPSG_3857, "CRS84", "OGC:CRS84", "EPSG:3857"];
        ObjectBuilder::new().schema_type(Type::String).enum_values(Some(names)).into()
    }
}

impl ToSchema for CrsName {}

impl TryFrom<String> for CrsName {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        match text.as_str() {
            CRS84 | "CRS84" | "OGC:CRS84" => Ok(Self(Crs::Crs84)),
            EPSG_3857 | "EPSG:3857" => Ok(Self(Crs::WebMercator)),
            _ => Err(format!("must be {CRS84} (CRS84) or {EPSG_3857} (EPSG:3857)")),
        }
    }
}

impl CrsName {
    /// Its OGC URI.
    #[must_use]
    pub const fn uri(self) -> &'static str {
        match self.0 {
            Crs::Crs84 => CRS84,
            Crs::WebMercator => EPSG_3857,
        }
    }

    /// The value of a `Content-Crs` header (OGC API Features part 2).
    #[must_use]
    pub fn header(self) -> HeaderValue {
        HeaderValue::try_from(format!("<{}>", self.uri())).expect("the URIs are ASCII")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn systems_have_a_long_and_a_short_name() {
        for (name, crs) in [(CRS84, Crs::Crs84), ("CRS84", Crs::Crs84), (EPSG_3857, Crs::WebMercator)] {
            assert_eq!(CrsName::try_from(name.to_owned()), Ok(CrsName(crs)));
        }
        assert!(CrsName::try_from("EPSG:4326".to_owned()).is_err());
        assert_eq!(CrsName(Crs::WebMercator).header(), format!("<{EPSG_3857}>"));
    }
}
