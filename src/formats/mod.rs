//! Features -> bytes: one file for each format.

pub mod csv;
mod feature_texts;
pub mod flatgeobuf;
pub mod geojson;
pub mod geopackage;
mod json;
pub mod json_fg;
#[cfg(test)]
mod tests;
mod wkt;

pub use feature_texts::FeatureTexts;
pub use json::Json;
