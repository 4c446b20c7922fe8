//! The resources of the OGC API standards: collections and their features, jobs.

pub mod collections;
pub mod conformance;
pub mod filter;
pub mod item_names;
pub mod items;
mod items_answer;
mod items_format;
pub mod items_query;
pub mod jobs;
pub mod queryables;
