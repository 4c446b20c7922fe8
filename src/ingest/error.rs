//! Why a map cannot be read.

/// Which kind of refusal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// Over a limit: 413.
    TooLarge,
    /// Not a format that is read: 415.
    UnsupportedFormat,
    /// Read, and found wrong: 422.
    Invalid,
}

/// A source that cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct IngestError {
    /// Which kind of refusal.
    pub refusal: Refusal,
    /// JSON pointer to the culprit: `/image`, `/metadata/resolution`, `/info/width` ...
    pub pointer: String,
    /// What is wrong, where, and how to mend it.
    pub message: String,
}

impl IngestError {
    pub(super) fn too_large(pointer: impl Into<String>, message: impl Into<String>) -> Self {
        Self { refusal: Refusal::TooLarge, pointer: pointer.into(), message: message.into() }
    }

    pub(super) fn unsupported(pointer: impl Into<String>, message: impl Into<String>) -> Self {
        Self { refusal: Refusal::UnsupportedFormat, pointer: pointer.into(), message: message.into() }
    }

    pub(super) fn invalid(pointer: impl Into<String>, message: impl Into<String>) -> Self {
        Self { refusal: Refusal::Invalid, pointer: pointer.into(), message: message.into() }
    }
}
