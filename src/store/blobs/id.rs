//! Addresses of blobs.

use std::fmt;

/// Address of a blob: 64 hexadecimal digits.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BlobId(String);

impl BlobId {
    /// The digits.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The address of these bytes.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        Self(blake3::hash(bytes).to_hex().to_string())
    }

    /// The address that a name is, if it is one.
    pub(super) fn find(name: &str) -> Option<Self> {
        let is_address = name.len() == 64 && name.bytes().all(|byte| byte.is_ascii_hexdigit());
        is_address.then(|| Self(name.to_owned()))
    }

    /// The address with these digits, which the store wrote earlier.
    pub(in crate::store) const fn from_digits(digits: String) -> Self {
        Self(digits)
    }
}

impl fmt::Display for BlobId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}
