//! What a drawing shows beyond the walls.

use std::str::FromStr;

use serde::Serialize;

use crate::scanner::grey;

/// What a drawing shows beyond the walls of the hall.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outside {
    /// Nothing is known there.
    Unknown,
    /// Everything is solid.
    Black,
    /// Everything is free.
    White,
}

impl Outside {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Unknown, Self::Black, Self::White];

    /// Its grey.
    pub(super) const fn grey(self) -> u8 {
        match self {
            Self::Unknown => grey::UNKNOWN,
            Self::Black => grey::OCCUPIED,
            Self::White => grey::FREE,
        }
    }
}

impl FromStr for Outside {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "unknown" => Ok(Self::Unknown),
            "black" => Ok(Self::Black),
            "white" => Ok(Self::White),
            _ => Err(format!("{text} is no ground: name unknown, black or white")),
        }
    }
}
