//! A whole map -> a file that another program reads.
//!
//! | module | what it writes |
//! | --- | --- |
//! | [`source`] | nothing: what every export reads, and how its numbers are written |
//! | [`lif_1`], [`lif_2`], `lif_layout` | Layout Interchange Format, for fleet managers; what both versions share |
//!
//! Every export is a pure function from an [`ExportSource`] to a serde struct typed after its schema, or to bytes. The
//! same source gives the same bytes. Coordinates are metres and headings radians of the map frame, unless the head of a
//! module says otherwise. Cost: O(size of the map) each.

pub mod lif_1;
pub mod lif_2;
mod lif_layout;
pub mod source;

#[cfg(test)]
mod tests;

pub use source::{ExportError, ExportSource};
