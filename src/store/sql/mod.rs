//! All SQL: what the contract promises, written once for both databases.
//!
//! Statements keep to the words that SQLite and PostgreSQL share: ids, JSON and names are text, times and numbers 64-bit
//! integers. Where the engines differ, the difference is in one place:
//!
//! | file | what it hides |
//! | --- | --- |
//! | `database` | whose connections, how a transaction begins |
//! | `statement`, `columns` | the driver's types of parameters and rows |
//! | `locks` | SQLite's writers come one after another; PostgreSQL's wait for those that write the same |
//! | `blob_rows` | a blob is written before its row, and removed when no row names it |
//!
//! Every write begins by `Database::write`, which adds the entry of its change to the log of changes (`audit`).
//!
//! `copying` moves all rows to another database. The other files have the rows of what they are named for.

mod analyses;
mod audit;
mod blob_rows;
mod capacity;
mod columns;
mod copying;
mod database;
mod hidden_maps;
mod jobs;
mod keys;
mod locks;
mod maps;
mod queue;
mod registries;
mod rows;
mod rule_sets;
mod semantics;
mod statement;
mod store;

pub use copying::{Moved, move_all};
pub use database::Database;
pub use store::{SqlStore, open_blobs};
