//! The real server under clients that mean no good, under an orderly stop, and as its operators see it. `docs/reliability.md`
//! lists what must hold.

#![allow(clippy::panic, reason = "a test is read from top to bottom: no detours")]

mod backup;
mod framing;
mod image_files;
mod images;
mod logs;
mod metrics;
mod server;
mod slow_clients;
mod soak;
mod stop;
mod storage;
#[cfg(feature = "otel")]
mod traces;
mod upgrade;
mod uploads;
