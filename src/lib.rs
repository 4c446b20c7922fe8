//! stillage: an occupancy map goes in, a semantic map comes out, over REST and GeoJSON.
//!
//! The straight line: [`ingest`] turns bytes into a grid, [`jobs`] runs [`stillage_core::analyze`] on it, [`store`]
//! keeps the result, [`app`] holds the use cases, [`features`] reads the collections off the result, [`formats`],
//! [`views`], [`exports`] and [`render`] write what is answered, [`http`] and [`cli`] are the two edges. Dependencies point one way:
//! `cli, http -> views -> app -> jobs, store -> core` and `formats -> features -> core`.

pub mod access;
pub mod allowed_hosts;
pub mod config;
pub mod core_split;
pub mod ingest;
pub mod options;

pub mod coordinates;
pub mod exports;
pub mod features;
pub mod formats;
pub mod render;

pub mod records;

mod blocking;
pub mod cql2;
mod did_you_mean;
mod fail_point;
mod pace;

mod storage_address;
pub mod store;

pub mod jobs;
pub mod measures;
pub mod stage_clock;

pub mod app;

pub mod views;

pub mod http;
pub mod server;

pub mod cli;
