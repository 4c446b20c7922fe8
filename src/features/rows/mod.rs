//! One file for each collection: what a row of it is, which properties it has, and how it is read off a map.

pub mod aisles;
mod common;
pub mod doors;
pub mod edges;
pub mod faces;
pub mod lines;
pub mod links;
pub mod locations;
pub mod nodes;
pub mod places;
pub mod regions;
pub mod storage_rows;
pub mod vertices;
