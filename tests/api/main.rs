//! The API as a client sees it: real requests against the real service in a temporary folder, without a socket.

#![allow(
    clippy::panic,
    clippy::type_complexity,
    clippy::assigning_clones,
    reason = "a test is read from top to bottom: no detours"
)]

mod access;
mod bodies;
mod client;
mod clients;
mod corrections;
mod damage;
mod dashboard;
mod deletion;
mod document;
mod evaluations;
mod exports;
mod feature_writes;
mod features;
mod filters;
mod graph_report;
mod injection;
mod jobs;
mod key_client;
mod keys;
mod maps;
mod names;
mod nearest;
mod ogc_formats;
mod ogc_part_1;
mod ogc_part_2;
#[path = "../servers/postgres.rs"]
#[cfg(feature = "postgres")]
mod postgres;
mod processes;
mod protocol;
mod routes;
mod semantics;
mod semantics_changes;
#[cfg(feature = "postgres")]
mod shared_database;
mod sign_in;
mod sites;
mod uploads;
