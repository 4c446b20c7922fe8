//! The styles of drawings.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// What a drawing shows of storage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DrawingStyle {
    /// Each place a solid rectangle.
    Solid,
    /// Each rack one solid body.
    Racks,
    /// Each place an outline.
    Outlined,
    /// Each row an outline, with a line between two bays.
    Lined,
    /// The uprights at the borders of bays alone, on both faces of a row.
    Uprights,
    /// Each place on four legs.
    Pods,
    /// The frames between bays alone: short lines across the row.
    Ticks,
    /// Each rack an outline filled with hatching.
    Hatched,
    /// A dash along both faces of each bay.
    Dashed,
}

impl DrawingStyle {
    /// All styles.
    pub const ALL: [Self; 9] = [
        Self::Solid,
        Self::Racks,
        Self::Outlined,
        Self::Lined,
        Self::Uprights,
        Self::Pods,
        Self::Ticks,
        Self::Hatched,
        Self::Dashed,
    ];

    /// Its name on the command line and in the names of folders.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Solid => "solid",
            Self::Racks => "racks",
            Self::Outlined => "outlined",
            Self::Lined => "lined",
            Self::Uprights => "uprights",
            Self::Pods => "pods",
            Self::Ticks => "ticks",
            Self::Hatched => "hatched",
            Self::Dashed => "dashed",
        }
    }

    /// What it draws.
    #[must_use]
    pub const fn description(self) -> &'static str {
        match self {
            Self::Solid => "each place a solid rectangle",
            Self::Racks => "each rack one solid body",
            Self::Outlined => "each place an outline",
            Self::Lined => "rows outlined, with a line between bays",
            Self::Uprights => "only the uprights at the borders of bays, on both faces",
            Self::Pods => "each place on four legs",
            Self::Ticks => "only the frames between bays: short lines across the row",
            Self::Hatched => "each rack an outline with hatching",
            Self::Dashed => "a dash along both faces of each bay",
        }
    }

    /// Whether an empty place looks unlike a full one.
    pub(super) const fn shows_empty_places(self) -> bool {
        matches!(self, Self::Solid | Self::Outlined | Self::Pods)
    }

    /// Whether a rack shows no places: then it is one place.
    pub(super) const fn is_whole(self) -> bool {
        matches!(self, Self::Racks | Self::Hatched)
    }

    /// Whether something runs across a row, so that one sees what is a row and what is an aisle.
    pub(super) const fn shows_sides(self) -> bool {
        !matches!(self, Self::Uprights | Self::Pods | Self::Dashed)
    }

    /// Distances from place to place, metres: pallets and pods, or bays of one to three pallets.
    pub(super) const fn pitch(self) -> Range<f64> {
        match self {
            Self::Solid | Self::Outlined => 0.8..1.6,
            Self::Pods => 1.0..1.6,
            _ => 0.9..2.8,
        }
    }
}

impl fmt::Display for DrawingStyle {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

impl FromStr for DrawingStyle {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|style| style.name() == text).ok_or_else(|| {
            let names: Vec<&str> = Self::ALL.iter().map(|style| style.name()).collect();
            format!("there is no style {text}: name one of {}", names.join(", "))
        })
    }
}
