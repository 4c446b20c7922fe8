//! Whose things are.

use std::fmt;
use std::str::FromStr;

/// Longest name of a tenant, characters: those of a label of DNS.
const MAX_NAME: usize = 63;

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

/// A text that is no name of a tenant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a tenant has a name of 1 to {MAX_NAME} characters: a to z, 0 to 9, and `-`, `_`, `.` behind the first")]
pub struct NoTenant;

impl FromStr for Tenant {
    type Err = NoTenant;

    fn from_str(name: &str) -> Result<Self, NoTenant> {
        let is_word = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit();
        let is_name = name.len() <= MAX_NAME
            && name.bytes().next().is_some_and(is_word)
            && name.bytes().all(|byte| is_word(byte) || b"-_.".contains(&byte));
        if is_name { Ok(Self::new(name)) } else { Err(NoTenant) }
    }
}

impl fmt::Display for Tenant {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_plain_and_nobody_has_none() {
        for name in ["local", "7", "hall-3.north_west"] {
            assert_eq!(name.parse(), Ok(Tenant::new(name)));
        }
        for name in ["", "-a", ".", "Hall", "a b", "a\n", "ä", &"a".repeat(64)] {
            assert_eq!(name.parse::<Tenant>(), Err(NoTenant), "{name}");
        }
    }
}
