//! The resources of the OGC API standards: collections and their features, jobs.

pub mod collections;
mod feature_documents;
pub mod items;
mod items_query;
pub mod jobs;
