//! A whole map -> a file that another program reads.
//!
//! | module | what it writes |
//! | --- | --- |
//! | [`list()`] | every export with its name, media type and purpose |
//! | [`options()`] | their options by name, checked |
//! | [`write()`], `single` | any export as bytes |
//! | `bundle`, [`archive`] | all exports with their checksums; zip archives |
//! | [`source`] | nothing: what every export reads, and how its numbers are written |
//! | [`lif_1`], [`lif_2`], `lif_layout` | Layout Interchange Format, for fleet managers; what both versions share |
//! | [`locations_csv`], [`locations_xlsx`], `location_sheet` | storage locations as tables; their columns |
//! | [`graph_ml`] | the graph, for tools that study graphs |
//! | [`nav2_masks`], [`nav2_vector_objects`], [`moving_ai`] | cells and areas where vehicles may drive |
//! | [`nav2_route`] | route graph of Nav2 |
//! | [`rmf_nav_graph`], [`rmf_building`] | Open-RMF |
//! | `straight_graph`, `yaml` | the graph cut at the bends of its lanes; texts and numbers in YAML |
//! | `faces`, `geopackage` | the faces as `FlatGeobuf`; all collections as a `GeoPackage` |
//! | [`vda5050_download_map`] | the order to a vehicle to fetch the bundle |
//! | [`vda5050_zone_set`], [`vda5050_zone_rules`], `vda5050_header` | zones of VDA 5050; their rules; heads of messages |
//! | `zones`, `hole_free` | what vehicles may do on each face; areas without holes |
//!
//! Every export is a pure function from an [`ExportSource`] to a serde struct typed after its schema, or to bytes. The
//! same source gives the same bytes. Coordinates are metres and headings radians of the map frame, unless the head of a
//! module says otherwise. Cost: O(size of the map) each.

pub mod archive;
mod bundle;
mod faces;
mod geopackage;
pub mod graph_ml;
mod hole_free;
pub mod lif_1;
pub mod lif_2;
mod lif_layout;
mod list;
mod location_sheet;
pub mod locations_csv;
pub mod locations_xlsx;
pub mod moving_ai;
pub mod nav2_masks;
pub mod nav2_route;
pub mod nav2_vector_objects;
mod options;
pub mod rmf_building;
pub mod rmf_nav_graph;
mod single;
pub mod source;
mod straight_graph;
pub mod vda5050_download_map;
mod vda5050_header;
pub mod vda5050_zone_rules;
pub mod vda5050_zone_set;
mod write;
mod yaml;
mod zones;

#[cfg(test)]
mod tests;

pub use archive::NamedFile;
pub use list::{Export, ExportKind, SingleExport, list};
pub use location_sheet::InventoryOptions;
pub use options::{ExportOption, ExportOptions, OptionProblem, option, options};
pub use source::{ExportError, ExportSource};
pub use vda5050_header::Recipient;
pub use write::write;
