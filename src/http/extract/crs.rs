//! Coordinate reference systems as clients name them.

use axum::http::{HeaderName, HeaderValue};
use serde::Deserialize;
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{ObjectBuilder, Schema, Type};
use utoipa::{PartialSchema, ToSchema};

use crate::coordinates::{Crs, Georeference, Transform, UtmZone};

/// The header of OGC API Features part 2: the system of the coordinates of an answer.
pub const CONTENT_CRS: HeaderName = HeaderName::from_static("content-crs");
/// Longitude, latitude in degrees: the default.
pub const CRS84: &str = "http://www.opengis.net/def/crs/OGC/1.3/CRS84";
/// Web Mercator. Of a map without georeference these are the metres of the map frame.
pub const EPSG_3857: &str = "http://www.opengis.net/def/crs/EPSG/0/3857";

/// A coordinate reference system as a parameter: its OGC URI or a name that means the same.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct CrsName(pub Crs);

impl PartialSchema for CrsName {
    fn schema() -> RefOr<Schema> {
        let names = [CRS84, EPSG_3857, "CRS84", "OGC:CRS84", "EPSG:3857"];
        let builder = ObjectBuilder::new().schema_type(Type::String).enum_values(Some(names));
        let description = "A coordinate reference system of the map. The URIs, URNs and short forms that mean the same \
            are taken too, and of a georeferenced map those of its UTM zone: see `crs` of its collections.";
        builder.description(Some(description)).into()
    }
}

impl ToSchema for CrsName {}

impl TryFrom<String> for CrsName {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        read(&text).map(Self).ok_or_else(|| {
            format!(
                "must be {CRS84} (CRS84), {EPSG_3857} (EPSG:3857) or the UTM zone of a georeferenced map (EPSG:32633)"
            )
        })
    }
}

/// Reads an OGC URI (`http://www.opengis.net/def/crs/EPSG/0/3857`), a URN (`urn:ogc:def:crs:EPSG::3857`) or a CURIE
/// (`EPSG:3857`, `[EPSG:3857]`), of whatever version of the registry.
fn read(text: &str) -> Option<Crs> {
    let text = text.trim();
    let text = text.strip_prefix('[').and_then(|text| text.strip_suffix(']')).unwrap_or(text);
    let uri = ["http://www.opengis.net/def/crs/", "https://www.opengis.net/def/crs/"];
    let (authority, code) = if let Some(path) = uri.iter().find_map(|prefix| text.strip_prefix(prefix)) {
        versioned(path, '/')?
    } else if let Some(names) = text.strip_prefix("urn:ogc:def:crs:") {
        versioned(names, ':')?
    } else {
        text.split_once(':').unwrap_or(("OGC", text))
    };
    match (authority, code) {
        ("OGC", "CRS84") => Some(Crs::Crs84),
        ("EPSG", "3857") => Some(Crs::WebMercator),
        ("EPSG", code) => code.parse().ok().and_then(UtmZone::of_epsg).map(Crs::Utm),
        _ => None,
    }
}

/// Splits authority, version and code; a version is digits and dots, or nothing.
fn versioned(text: &str, separator: char) -> Option<(&str, &str)> {
    let mut parts = text.split(separator);
    let (authority, version, code) = (parts.next()?, parts.next()?, parts.next()?);
    let is_version = version.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    (is_version && parts.next().is_none()).then_some((authority, code))
}

impl CrsName {
    /// Its OGC URI.
    #[must_use]
    pub fn uri(self) -> String {
        match self.0.epsg() {
            None => CRS84.to_owned(),
            Some(code) => format!("http://www.opengis.net/def/crs/EPSG/0/{code}"),
        }
    }

    /// The value of a `Content-Crs` header (OGC API Features part 2).
    #[must_use]
    pub fn header(self) -> HeaderValue {
        HeaderValue::try_from(format!("<{}>", self.uri())).expect("the URIs are ASCII")
    }

    /// From the frame of a map to this system.
    ///
    /// # Errors
    /// When the map does not answer in it: the systems in which it does.
    pub fn transform(self, georeference: Option<Georeference>) -> Result<Transform, String> {
        let systems = Crs::of_map(georeference);
        if systems.contains(&self.0) {
            return Ok(Transform::new(self.0, georeference));
        }
        let uris: Vec<String> = systems.into_iter().map(|crs| Self(crs).uri()).collect();
        Err(format!("the map answers in {}", uris.join(", ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn systems_have_many_names() {
        let degrees = [
            CRS84,
            "https://www.opengis.net/def/crs/OGC/1.3/CRS84",
            "http://www.opengis.net/def/crs/OGC/0/CRS84",
            "urn:ogc:def:crs:OGC:1.3:CRS84",
            "urn:ogc:def:crs:OGC::CRS84",
            "OGC:CRS84",
            "CRS84",
        ];
        let metres = [
            EPSG_3857,
            "https://www.opengis.net/def/crs/EPSG/0/3857",
            "http://www.opengis.net/def/crs/EPSG/9.9.1/3857",
            "urn:ogc:def:crs:EPSG::3857",
            "EPSG:3857",
            "[EPSG:3857]",
        ];
        for (names, crs) in [(degrees.as_slice(), Crs::Crs84), (metres.as_slice(), Crs::WebMercator)] {
            for name in names {
                assert_eq!(CrsName::try_from((*name).to_owned()), Ok(CrsName(crs)), "{name}");
            }
        }
        for wrong in ["", "EPSG:4326", "EPSG", "[EPSG:3857", "EPSG:32661", "urn:ogc:def:crs:EPSG:x:3857", "OGC:CRS83"] {
            assert!(CrsName::try_from(wrong.to_owned()).is_err(), "{wrong}");
        }
        assert_eq!(CrsName(Crs::WebMercator).header(), format!("<{EPSG_3857}>"));
    }

    #[test]
    fn a_map_has_no_zone_but_its_own() {
        let zone = CrsName::try_from("EPSG:32633".to_owned()).expect("is a zone");
        assert_eq!(zone.uri(), "http://www.opengis.net/def/crs/EPSG/0/32633");
        let halmstad = Some(Georeference { lon: 12.8572, lat: 56.6745, heading: 0.0 });
        assert!(zone.transform(halmstad).is_ok());
        let refused = zone.transform(None).expect_err("has no place on Earth");
        assert_eq!(refused, format!("the map answers in {CRS84}, {EPSG_3857}"));
        assert!(CrsName::try_from("EPSG:32632".to_owned()).expect("is a zone").transform(halmstad).is_err());
    }
}
