//! Whose things are.

use std::fmt;

/// Whose a map, job or rule set is. What belongs to one tenant does not exist for another.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Tenant(String);

impl Tenant {
    /// The only tenant of a service without keys.
    #[must_use]
    pub fn local() -> Self {
        Self::new("local")
    }

    /// Nobody: whose the maps are that were deleted and may be restored. No caller is nobody.
    #[must_use]
    pub fn nobody() -> Self {
        Self::new("")
    }

    /// The tenant with this id.
    #[must_use]
    pub fn new(id: impl Into<String>) -> Self {
        Self(id.into())
    }

    /// Its id.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Tenant {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}
