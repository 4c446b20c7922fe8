//! Colours and lines of the pictures and their legends.

use stillage_core::semantics::Cogency;

use super::drawing::{Colour, Stroke};

/// Behind everything.
pub(super) const PAPER: Colour = [255, 255, 255];
/// Of texts and obstructions.
pub(super) const INK: Colour = [20, 20, 24];
const NO_COLOUR: Colour = [205, 205, 205];
const ACCESS: Colour = [226, 74, 20];

/// Colours of categories and regions that stay apart for most eyes (after Okabe and Ito, 2008), then turns of the wheel.
const COLOURS: [Colour; 8] = [
    [86, 180, 233],
    [230, 159, 0],
    [0, 158, 115],
    [240, 228, 66],
    [204, 121, 167],
    [213, 94, 0],
    [0, 114, 178],
    [153, 153, 153],
];

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

/// The colour of a category, a region or a component.
pub(super) fn colour(index: usize) -> Colour {
    COLOURS.get(index).copied().unwrap_or_else(|| {
        // The golden angle never comes back to a hue; one in three is darker.
        let hue = (index as f64 * 137.507_764) % 360.0;
        let value = if index.is_multiple_of(3) { 0.6 } else { 0.9 };
        let channel = |shift: f64| {
            let distance = ((hue / 60.0 + shift) % 6.0 - 3.0).abs() - 1.0;
            (value * 255.0 * (0.3 + 0.7 * distance.clamp(0.0, 1.0))).round() as u8
        };
        [channel(0.0), channel(4.0), channel(2.0)]
    })
}
