//! Links between resources, absolute, under the name by which the client reached the service.

use std::convert::Infallible;
use std::fmt::Write as _;

use axum::extract::FromRequestParts;
use axum::http::HeaderValue;
use axum::http::request::Parts;

use super::public_address::PublicAddress;
use crate::views::link::Link;

/// JSON.
pub const JSON: &str = "application/json";
/// GeoJSON (RFC 7946).
pub const GEO_JSON: &str = "application/geo+json";
/// Comma-separated values (RFC 4180).
pub const CSV: &str = "text/csv";
/// OGC Features and Geometries JSON, version 1.0.
pub const JSON_FG: &str = "application/fg+json";
/// The binary format of features.
pub const FLAT_GEOBUF: &str = "application/flatgeobuf";
/// All collections of a map in one `SQLite` file.
pub const GEO_PACKAGE: &str = "application/geopackage+sqlite3";
/// A page for people.
pub const HTML: &str = "text/html";
/// A JSON Schema.
pub const JSON_SCHEMA: &str = "application/schema+json";
/// Portable Network Graphics.
pub const PNG: &str = "image/png";
/// A drawing.
pub const SVG: &str = "image/svg+xml";
/// An OpenAPI 3.1 document.
pub const OPENAPI_3_1: &str = "application/vnd.oai.openapi+json;version=3.1";
/// An OpenAPI 3.0 document, the version that GIS read.
pub const OPENAPI_3_0: &str = "application/vnd.oai.openapi+json;version=3.0";

/// A link as the value of a `Link` header (RFC 8288).
#[must_use]
pub fn header(link: &Link) -> HeaderValue {
    let text = format!("<{}>; rel=\"{}\"; type=\"{}\"", link.href, link.rel, link.r#type);
    HeaderValue::try_from(text).expect("addresses are percent-encoded")
}

/// The root of the service as the client sees it.
#[derive(Debug, Clone)]
pub struct Base(String);

impl Base {
    /// A link to a path of the service.
    #[must_use]
    pub fn link(&self, rel: &'static str, path: &str, media_type: &'static str) -> Link {
        Link { href: format!("{}{path}", self.0), rel, r#type: media_type, title: None }
    }
}

impl<S: Sync> FromRequestParts<S> for Base {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Infallible> {
        Ok(Self(parts.extensions.get().map(PublicAddress::root).unwrap_or_default()))
    }
}

/// Writes a value for use in a query string.
#[must_use]
pub fn encode(value: &str) -> String {
    let mut encoded = String::with_capacity(value.len());
    for byte in value.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b',' | b':' | b'/' => {
                encoded.push(char::from(byte));
            }
            byte => {
                // Writing to a string cannot fail.
                let _ = write!(encoded, "%{byte:02X}");
            }
        }
    }
    encoded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_percent_encoded() {
        assert_eq!(encode("01-002&limit=ü"), "01-002%26limit%3D%C3%BC");
    }

    #[test]
    fn a_link_is_a_header_too() {
        let link = Base("http://robots:8080".into()).link("next", "/v1/maps?after=1", JSON);
        assert_eq!(header(&link), "<http://robots:8080/v1/maps?after=1>; rel=\"next\"; type=\"application/json\"");
    }
}
