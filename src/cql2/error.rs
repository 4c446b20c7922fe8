//! What is wrong with a filter, and where.

use std::fmt;

/// A filter that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FilterError {
    place: FaultPlace,
    detail: String,
}

/// Where in the filter.
#[derive(Debug, Clone, PartialEq, Eq)]
enum FaultPlace {
    /// The detail says it.
    Named,
    /// A character of the text, counted from 1.
    Column(usize),
    /// A JSON pointer.
    Pointer(String),
}

impl FilterError {
    /// The detail names the culprit itself.
    pub(super) fn new(detail: impl Into<String>) -> Self {
        Self { place: FaultPlace::Named, detail: detail.into() }
    }

    /// At a byte of the text.
    pub(super) fn in_text(text: &str, byte: usize, detail: impl Into<String>) -> Self {
        Self { place: FaultPlace::Column(text[..byte].chars().count() + 1), detail: detail.into() }
    }

    /// At a JSON pointer; the empty one is the whole filter.
    pub(super) fn at(pointer: &str, detail: impl Into<String>) -> Self {
        Self { place: FaultPlace::Pointer(pointer.to_owned()), detail: detail.into() }
    }
}

impl fmt::Display for FilterError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            FaultPlace::Column(column) => write!(formatter, "column {column}: {}", self.detail),
            FaultPlace::Pointer(pointer) if !pointer.is_empty() => write!(formatter, "{pointer}: {}", self.detail),
            FaultPlace::Pointer(_) | FaultPlace::Named => formatter.write_str(&self.detail),
        }
    }
}
