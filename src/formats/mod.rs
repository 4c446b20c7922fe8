//! Features -> bytes: one file for each format.

pub mod csv;
pub mod flatgeobuf;
pub mod geojson;
mod json;
pub mod json_fg;
#[cfg(test)]
mod tests;
mod wkt;

pub use json::Json;
