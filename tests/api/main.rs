//! The API as a client sees it: real requests against the real service in a temporary folder, without a socket.

mod client;
mod document;
mod features;
mod jobs;
mod maps;
mod protocol;
mod routes;
mod semantics;
mod uploads;
