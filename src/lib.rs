//! stillage: an occupancy map goes in, a semantic map comes out, over REST and GeoJSON.
//!
//! The straight line: [`ingest`] turns bytes into a grid, [`jobs`] runs [`stillage_core::analyze`] on it, [`store`]
//! keeps the result, [`app`] holds the use cases, [`geojson`] and [`render`] give answers their shape, [`http`] and
//! [`cli`] are the two edges. Dependencies point one way: `cli, http -> app -> jobs, store -> core`.

pub mod config;
pub mod ingest;
pub mod options;

pub mod geojson;
pub mod render;

pub mod records;

mod fail_point;

pub mod store;

pub mod jobs;
pub mod stage_clock;

pub mod app;

pub mod http;
pub mod server;

pub mod cli;
