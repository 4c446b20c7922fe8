//! JSON documents: what clients send and are sent, and what the command line prints, one file for each resource.
//!
//! A view is made from a record or from an analysed map and knows nothing of requests; the edge adds the links.

pub mod alignment;
pub mod analysis;
pub mod audit;
pub mod carried;
pub mod category;
pub mod cogency_matrix;
pub mod comparison;
pub mod correction;
pub mod deleted_map;
pub mod diagnostics;
pub mod evaluation;
pub mod export;
pub mod face_difference;
pub mod feature;
pub mod feature_schema;
pub mod georeference;
pub mod graph_report;
pub mod id;
pub mod job;
pub mod label_preview;
pub mod layout;
pub mod link;
pub mod map;
pub mod name;
pub mod names;
pub mod occupancy_grid;
pub mod options;
pub mod process;
pub mod registry;
pub mod remarks;
pub mod rule_set;
pub mod semantics;
pub mod truth;
