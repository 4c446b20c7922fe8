//! A copy of the store of one process, made while that process works, and a store made of the copy.
//!
//! ```text
//! backup.json          what the backup is, and the hash of the list of files
//! checksums.txt        blake3 hash and name of every other file, as `b3sum --check` reads them
//! stillage.sqlite3     one committed state of the rows
//! blobs/ab/abcd...     the blobs that these rows name
//! ```
//!
//! The state of the rows is taken after the blobs: blobs are copied, the rows are copied, and where these name blobs that came
//! meanwhile, both once more. So nothing has to be held in the service, and a blob that is deleted meanwhile is either copied or
//! not named any more.
//!
//! A backup is written beside its place and gets its name when it is whole.

mod error;
mod layout;
mod make;
mod manifest;
mod progress;
mod restore;

pub use error::BackupError;
pub use make::back_up;
pub use manifest::BackupContents;
pub use progress::CopyProgress;
pub use restore::{check_backup, restore};
