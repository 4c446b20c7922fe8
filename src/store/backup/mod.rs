//! A copy of the store of one process, made while that process works, and a store made of the copy.
//!
//! ```text
//! backup.json          what the backup is, and the hash of the list of files
//! checksums.txt        blake3 hash and name of every other file, as `b3sum --check` reads them
//! stillage.sqlite3     one committed state of the rows
//! blobs/ab/abcd...     the blobs that these rows name
//! ```
//!
//! The rows are copied first, as one committed state, and then the blobs that they name. Where a blob was deleted meanwhile, a
//! newer state of the rows does not name it any more: the rows are copied once more, and what they name beyond what is there. So
//! nothing has to be held up in the service.
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
