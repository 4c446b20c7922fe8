//! The resources of the OGC API standards: collections and their features, jobs.

pub mod collections;
pub mod conformance;
mod feature_body;
pub mod filter;
pub mod item_writes;
pub mod items;
mod items_answer;
mod items_format;
pub mod items_query;
pub mod jobs;
pub mod queryables;
