//! Colours and lines of the semantic map and its legend.

use stillage_core::semantics::Cogency;

use super::drawing::{Colour, Stroke};

/// Behind everything.
pub(super) const PAPER: Colour = [255, 255, 255];
/// Of texts and obstructions.
pub(super) const INK: Colour = [20, 20, 24];
const NO_COLOUR: Colour = [205, 205, 205];
const ACCESS: Colour = [226, 74, 20];

/// The line of an edge.
pub(super) const fn stroke(cogency: Cogency, thickness: f64) -> Stroke {
    match cogency {
        Cogency::Cogent => Stroke { colour: INK, opacity: 1.0, thickness },
        Cogency::StorageAccess => Stroke { colour: ACCESS, opacity: 1.0, thickness: 2.0 * thickness },
        Cogency::Invalid => Stroke { colour: INK, opacity: 0.2, thickness },
    }
}

/// `#rrggbb`; grey for anything else.
pub(super) fn parse_colour(text: &str) -> Colour {
    let number = text.strip_prefix('#').filter(|digits| digits.len() == 6);
    let number = number.and_then(|digits| u32::from_str_radix(digits, 16).ok());
    number.map_or(NO_COLOUR, |number| [(number >> 16) as u8, (number >> 8) as u8, number as u8])
}
