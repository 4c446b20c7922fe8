//! `cql2-json`: expressions (`reader`) and the GeoJSON in them (`geojson`).

mod geojson;
mod reader;

pub use reader::read;
