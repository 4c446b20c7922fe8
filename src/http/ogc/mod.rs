//! The resources of the OGC API standards: collections and their features, processes and jobs.

pub mod collections;
pub mod conformance;
pub mod event_streams;
mod execution_body;
mod feature_body;
pub mod filter;
pub mod item_query;
pub mod item_writes;
pub mod items;
mod items_answer;
mod items_format;
pub mod items_query;
pub mod job_events;
pub mod jobs;
pub mod processes;
mod profile;
pub mod queryables;
pub mod root;
