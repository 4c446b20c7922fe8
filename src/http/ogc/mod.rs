//! The resources of the OGC API standards: collections and their features, jobs.

pub mod bbox;
pub mod collections;
pub mod items;
pub mod jobs;
