//! How far a copy is.

/// How far a copy is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CopyProgress {
    /// Files that were copied or read.
    pub done: u64,
    /// Files in all, as far as it is known.
    pub of: u64,
}
