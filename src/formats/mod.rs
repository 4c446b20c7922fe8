//! Features -> bytes: one file for each format.

pub mod csv;
pub mod flatgeobuf;
pub mod geojson;
mod json;
#[cfg(test)]
mod tests;

pub use json::Json;
