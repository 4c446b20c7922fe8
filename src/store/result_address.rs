//! What identifies a result.

use serde_json::Value;

use super::BlobId;

/// What identifies a result: hash of the upload, the process with its version, and its inputs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ResultAddress(String);

impl ResultAddress {
    /// The address of what a process makes of an upload with some inputs.
    #[must_use]
    pub fn of(source: &BlobId, process: &str, version: u32, inputs: &Value) -> Self {
        let identity = format!("{source}\n{process}\n{version}\n{inputs}");
        Self(blake3::hash(identity.as_bytes()).to_hex().to_string())
    }

    pub(super) const fn from_digits(digits: String) -> Self {
        Self(digits)
    }

    /// The digits.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }
}
