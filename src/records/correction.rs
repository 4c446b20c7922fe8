//! Corrections of a map, as they are kept: immutable lists that versions of the semantics name.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use stillage_core::corrections::Correction;

/// The id of a correction: `c` and a number from 1, which no other correction of the map ever has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct CorrectionId(pub u32);

impl fmt::Display for CorrectionId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "c{}", self.0)
    }
}

/// A text that is no id of a correction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("is not the id of a correction, such as c1")]
pub struct NoCorrectionId;

impl FromStr for CorrectionId {
    type Err = NoCorrectionId;

    /// An id has one spelling: no sign, no zeros in front.
    fn from_str(text: &str) -> Result<Self, NoCorrectionId> {
        let number = text.strip_prefix('c').and_then(|number| number.parse().ok());
        number.map(Self).filter(|id| id.0 > 0 && id.to_string() == text).ok_or(NoCorrectionId)
    }
}

/// A correction of a list.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CorrectionRecord {
    /// Its id.
    pub id: CorrectionId,
    /// What it says, in metres of the map frame.
    pub correction: Correction,
}

/// A stored list of corrections. It never changes, so that versions share it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CorrectionList {
    /// Its number among the lists of its map, from 1.
    pub number: u32,
    /// How many corrections it has, at least one.
    pub count: u32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_has_one_spelling() {
        assert_eq!("c12".parse(), Ok(CorrectionId(12)));
        assert_eq!(CorrectionId(12).to_string(), "c12");
        for wrong in ["", "c", "12", "c0", "c01", "c+1", "C1", "c99999999999"] {
            assert_eq!(wrong.parse::<CorrectionId>(), Err(NoCorrectionId), "{wrong:?}");
        }
    }
}
