//! The real server under clients that mean no good, and under an orderly stop. `docs/reliability.md` lists what must hold.

#![allow(clippy::panic, reason = "a test is read from top to bottom: no detours")]

mod backup;
mod framing;
mod server;
mod slow_clients;
mod stop;
mod uploads;
