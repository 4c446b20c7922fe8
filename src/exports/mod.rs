//! A whole map -> a file that another program reads.
//!
//! | module | what it writes |
//! | --- | --- |
//! | [`list()`] | every export with its name, media type and purpose |
//! | [`write()`], `single` | any export as bytes |
//! | `bundle`, [`archive`] | all exports with their checksums; zip archives |
//! | [`source`] | nothing: what every export reads, and how its numbers are written |
//! | [`lif_1`], [`lif_2`], `lif_layout` | Layout Interchange Format, for fleet managers; what both versions share |
//! | [`locations_csv`], [`locations_xlsx`], `location_sheet` | storage locations as tables; their columns |
//! | [`graph_ml`] | the graph, for tools that study graphs |
//! | [`nav2_masks`], [`moving_ai`] | cells where vehicles may drive |
//! | [`rmf_nav_graph`], [`rmf_building`], `rmf_graph`, `yaml` | Open-RMF; what both files share; texts |
//! | [`nav2_route`] | route graph of Nav2 |
//! | [`vda5050_download_map`] | the order to a vehicle to fetch the bundle |
//! | [`vda5050_zone_set`], `zones`, `hole_free` | zones of VDA 5050; rules of faces; areas without holes |
//!
//! Every export is a pure function from an [`ExportSource`] to a serde struct typed after its schema, or to bytes. The
//! same source gives the same bytes. Coordinates are metres and headings radians of the map frame, unless the head of a
//! module says otherwise. Cost: O(size of the map) each.

pub mod archive;
mod bundle;
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
pub mod rmf_building;
mod rmf_graph;
pub mod rmf_nav_graph;
mod single;
pub mod source;
pub mod vda5050_download_map;
pub mod vda5050_zone_set;
mod write;
mod yaml;
mod zones;

#[cfg(test)]
mod tests;

pub use archive::NamedFile;
pub use list::{Export, ExportKind, ExportOptions, SingleExport, list};
pub use location_sheet::InventoryOptions;
pub use source::{ExportError, ExportSource};
pub use write::write;
