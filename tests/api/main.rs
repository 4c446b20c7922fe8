//! The API as a client sees it: real requests against the real service in a temporary folder, without a socket.

#![allow(clippy::panic, reason = "helpers of tests fail like tests")]
#![allow(clippy::assigning_clones, reason = "what is cloned is borrowed from the old value")]

mod client;
mod document;
mod features;
mod jobs;
mod maps;
mod protocol;
mod routes;
mod semantics;
mod uploads;
