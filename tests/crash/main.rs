//! The real server, killed with SIGKILL at every place that matters, cut off from what it needs, and asked afterwards whether all
//! is in order.
//!
//! What must hold, whatever dies and when ([`audit::Ledger::check`]): every job that was accepted ends successful exactly
//! once; nothing is lost, nothing is there twice, nothing is there by half.
//!
//! `STILLAGE_CRASH_JOBS=2000 STILLAGE_CRASH_KILLS=1000 cargo test --test crash nothing` runs the long campaigns: one
//! process on SQLite, two processes on one PostgreSQL. That the harness can fail is shown by taking the fence out of the
//! database: then it finds two results of one job. `STILLAGE_DATABASE_CRASHES`, `STILLAGE_PARTITION_S` and `STILLAGE_OUTAGE_S` make
//! the other ones long (`docs/reliability.md`).

mod audit;
mod buckets;
mod campaigns;
mod clocks;
mod deployment;
mod determinism;
mod fail_points;
mod moving;
#[path = "../servers/object_store.rs"]
mod object_store;
mod outages;
#[path = "../servers/postgres.rs"]
mod postgres;
#[path = "../servers/proxy.rs"]
mod proxy;
mod rolling;
mod server;
mod settings;
