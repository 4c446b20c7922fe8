//! Grey levels and probabilities -> free, occupied, unknown, as `nav2_map_server` decides (`map_io.cpp`).
//!
//! In single precision, as there: `p = (255 - g) / 255`, or `g / 255` with `negate`; occupied where `p >= occupied`,
//! then free where `p <= free` (free wins), unknown between.
//! - `trinary`: that, and unknown wherever the pixel is not opaque.
//! - `scale`: nav2 spreads the shades between the thresholds over 0..100. They are no verdict, and this service knows
//!   three occupancies, so they are unknown: the cells are those of `trinary`. (A speed mask with thresholds 0 and 1 is
//!   all unknown but for pure black, which nav2 reads as 100.)
//! - `raw`: the grey level is the cell's value, 0 to 100 in per cent, anything else unknown; `negate` and opacity do
//!   not matter. The value is judged by the thresholds, as the value of a message is.
//!
//! Many files have a `free_thresh` of 0.25, which takes the grey that map savers write for unknown cells, 205, for free.
//! Unless the user gave a threshold or asked for the letter of the file, that grey is read as unknown ([`Loss::mended`]).
//!
//! ROS 1 compares strictly instead and averages opacity into the grey: maps at the very threshold differ there.
//! Cost: O(cells), one table look-up each.

use stillage_core::Occupancy;
use stillage_core::analysis::Diagnostic;
use stillage_core::spec::GridOptions;

use super::IngestError;
use super::picture::Picture;

/// How grey levels are meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    Trinary,
    Scale,
    Raw,
}

/// From which share on a cell is occupied, and up to which it is free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Thresholds {
    pub(super) free: f64,
    pub(super) occupied: f64,
}

impl Thresholds {
    /// What both `map_saver`s take for a message (`threshold_free 25`, `threshold_occupied 65`; `free_thresh_default
    /// 0.25`, `occupied_thresh_default 0.65`): a message reads as the map that would be saved from it.
    pub(super) const OF_MESSAGES: Self = Self { free: 0.25, occupied: 0.65 };

    /// The thresholds with the user's in place of the file's.
    pub(super) fn overridden(self, options: &GridOptions) -> Result<Self, IngestError> {
        let thresholds = Self {
            free: options.free_threshold.unwrap_or(self.free),
            occupied: options.occupied_threshold.unwrap_or(self.occupied),
        };
        thresholds.in_order("/options/grid/freeThreshold")
    }

    /// The thresholds, when free is below occupied.
    pub(super) fn in_order(self, pointer: &str) -> Result<Self, IngestError> {
        if self.free < self.occupied {
            return Ok(self);
        }
        let Self { free, occupied } = self;
        let message = format!("the free threshold ({free}) must be below the occupied threshold ({occupied})");
        Err(IngestError::invalid(pointer, message))
    }

    /// The verdict on a probability of being occupied.
    fn judge(self, probability: f32) -> Occupancy {
        // Both hold for a probability at either threshold only when the two round to one number: free wins.
        if probability <= self.free as f32 {
            Occupancy::Free
        } else if probability >= self.occupied as f32 {
            Occupancy::Occupied
        } else {
            Occupancy::Unknown
        }
    }

    /// The verdict on a cell of an `OccupancyGrid` message: 0 to 100 per cent, anything else is unknown.
    pub(super) fn judge_value(self, value: i8) -> Occupancy {
        if (0..=100).contains(&value) { self.judge(f32::from(value) / 100.0) } else { Occupancy::Unknown }
    }
}

/// How the pixels of a map become cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reading {
    pub(super) mode: Mode,
    pub(super) negate: bool,
    pub(super) thresholds: Thresholds,
}

impl Reading {
    /// The verdict on an opaque pixel.
    fn judge(self, grey: u8) -> Occupancy {
        match self.mode {
            // nav2 stores the level in an int8: from 128 on it is negative.
            Mode::Raw => self.thresholds.judge_value(i8::try_from(grey).unwrap_or(-1)),
            Mode::Trinary | Mode::Scale => self.thresholds.judge(self.probability(grey)),
        }
    }

    /// How occupied a grey level is, 0 to 1.
    fn probability(self, grey: u8) -> f32 {
        f32::from(if self.negate { grey } else { u8::MAX - grey }) / 255.0
    }
}

/// The cells of a picture, lowest row first.
pub(super) fn cells(picture: &Picture, reading: Reading) -> Vec<Occupancy> {
    let table: [Occupancy; 256] = std::array::from_fn(|grey| reading.judge(grey as u8));
    let mut cells = Vec::with_capacity(picture.grey.len());
    let rows = picture.grey.chunks_exact(picture.width).enumerate().rev();
    for (row, greys) in rows {
        let start = cells.len();
        cells.extend(greys.iter().map(|&grey| table[usize::from(grey)]));
        if reading.mode != Mode::Raw && !picture.transparent.is_empty() {
            let transparent = &picture.transparent[row * picture.width..][..picture.width];
            for (cell, _) in cells[start..].iter_mut().zip(transparent).filter(|(_, transparent)| **transparent) {
                *cell = Occupancy::Unknown;
            }
        }
    }
    cells
}

/// From this share of the pixels on, one grey level is not noise.
const NOTABLE_SHARE: f64 = 0.01;
/// As bright as free cells are drawn (254 by `map_saver`; 250 leaves room for rounding).
const DRAWN_FREE: f32 = 5.0 / 255.0;
/// Darker than this no tool draws free cells on purpose (the faintest seen in the wild is 243).
const DRAWN_UNKNOWN: f32 = 20.0 / 255.0;

/// How occupied the grey is that map savers write for unknown cells, 205: within what JPEG makes of it.
const SAVED_UNKNOWN: std::ops::RangeInclusive<f32> = 47.0 / 255.0..=53.0 / 255.0;
/// The free threshold that keeps it unknown: below grey 209.
const FREE_BELOW_SAVED_UNKNOWN: f64 = 0.18;

/// A grey level that the thresholds turn free though it was probably drawn as unknown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Loss {
    grey: u8,
    /// Share of the pixels that have it.
    share: f64,
    reading: Reading,
}

impl Loss {
    /// The reading that keeps the level unknown, and a word about it, if it is the one that map savers write.
    pub(super) fn mended(self) -> Option<(Reading, Diagnostic)> {
        if !SAVED_UNKNOWN.contains(&self.reading.probability(self.grey)) {
            return None;
        }
        let Self { grey, share, reading } = self;
        let (percent, free) = (share * 100.0, reading.thresholds.free);
        let message = format!(
            "{percent:.1} % of the pixels have grey level {grey}, which map savers write for unknown cells, and were read \
             as unknown, although the free threshold is {free}; to keep the letter of the file, set \
             options.grid.semantics: \"nav2\""
        );
        let thresholds = Thresholds { free: FREE_BELOW_SAVED_UNKNOWN, ..reading.thresholds };
        Some((Reading { thresholds, ..reading }, Diagnostic::new("unknown-kept", message)))
    }

    /// The warning where it stays lost.
    pub(super) fn warning(self) -> Diagnostic {
        let Self { grey, share, reading } = self;
        // The largest threshold of three decimals that leaves the level out: 0.196 for 205.
        let remedy = (f64::from(reading.probability(grey)) * 1000.0).ceil() / 1000.0 - 0.001;
        let (percent, free) = (share * 100.0, reading.thresholds.free);
        let message = format!(
            "{percent:.1} % of the pixels have grey level {grey} and were read as free, because the free threshold is \
             {free}; if they mean unknown, set options.grid.freeThreshold: {remedy:.3}"
        );
        Diagnostic::new("unknown-lost", message)
    }
}

/// Finds what the thresholds turn free though it was probably drawn as unknown: grey 205 at `free_thresh: 0.25` mostly.
pub(super) fn unknown_lost(picture: &Picture, reading: Reading) -> Option<Loss> {
    if reading.mode == Mode::Raw {
        return None;
    }
    let mut histogram = [0_usize; 256];
    for &grey in &picture.grey {
        histogram[usize::from(grey)] += 1;
    }
    let share = |grey: u8| histogram[usize::from(grey)] as f64 / picture.grey.len() as f64;
    let notable = |grey: &u8| share(*grey) > NOTABLE_SHARE;
    (0..=u8::MAX).filter(notable).find(|&grey| reading.probability(grey) <= DRAWN_FREE)?;
    let lost = (0..=u8::MAX)
        .filter(notable)
        .filter(|&grey| reading.judge(grey) == Occupancy::Free && reading.probability(grey) > DRAWN_UNKNOWN)
        .max_by_key(|&grey| histogram[usize::from(grey)])?;
    Some(Loss { grey: lost, share: share(lost), reading })
}

#[cfg(test)]
mod tests {
    use super::*;
    use Occupancy::{Free, Occupied, Unknown};

    fn reading(mode: Mode, negate: bool, free: f64, occupied: f64) -> Reading {
        Reading { mode, negate, thresholds: Thresholds { free, occupied } }
    }

    /// Levels of a ramp from 0 to 255 where the verdict changes.
    fn ramp(reading: Reading) -> Vec<(u8, Occupancy)> {
        let mut changes: Vec<(u8, Occupancy)> = Vec::new();
        for grey in 0..=u8::MAX {
            let verdict = reading.judge(grey);
            if changes.last().is_none_or(|(_, last)| *last != verdict) {
                changes.push((grey, verdict));
            }
        }
        changes
    }

    #[test]
    fn the_ramp_of_nav2() {
        // Measured with nav2's own loader: 90 occupied, 116 unknown, 50 free.
        let usual = reading(Mode::Trinary, false, 0.196, 0.65);
        assert_eq!(ramp(usual), [(0, Occupied), (90, Unknown), (206, Free)]);
        assert_eq!(ramp(Reading { mode: Mode::Scale, ..usual }), ramp(usual));
        assert_eq!(ramp(reading(Mode::Trinary, false, 0.25, 0.65)), [(0, Occupied), (90, Unknown), (192, Free)]);
        assert_eq!(ramp(reading(Mode::Trinary, true, 0.196, 0.65)), [(0, Free), (50, Unknown), (166, Occupied)]);
    }

    #[test]
    fn thresholds_are_inclusive_and_free_wins() {
        assert_eq!(ramp(reading(Mode::Trinary, false, 0.0, 1.0)), [(0, Occupied), (1, Unknown), (255, Free)]);
        // 0.2 is grey 204 exactly, 0.6 is grey 102.
        assert_eq!(ramp(reading(Mode::Trinary, false, 0.2, 0.6)), [(0, Occupied), (103, Unknown), (204, Free)]);
    }

    #[test]
    fn raw_levels_are_per_cent() {
        let raw = reading(Mode::Raw, true, 0.25, 0.65);
        assert_eq!(ramp(raw), [(0, Free), (26, Unknown), (65, Occupied), (101, Unknown)]);
    }

    #[test]
    fn rows_are_turned_upside_down_and_only_opaque_pixels_count() {
        let picture =
            Picture { width: 2, height: 2, grey: vec![0, 254, 254, 0], transparent: vec![true, false, false, false] };
        let trinary = reading(Mode::Trinary, false, 0.196, 0.65);
        assert_eq!(cells(&picture, trinary), [Free, Occupied, Unknown, Free]);
        assert_eq!(cells(&picture, Reading { mode: Mode::Raw, ..trinary }), [Unknown, Free, Free, Unknown]);
    }

    #[test]
    fn a_threshold_that_swallows_the_unknown_cells_is_named_with_its_remedy() {
        let mut grey = vec![254; 80];
        grey.extend([205; 16]);
        grey.extend([0; 4]);
        let picture = Picture { width: 100, height: 1, grey, transparent: Vec::new() };
        let loss = unknown_lost(&picture, reading(Mode::Trinary, false, 0.25, 0.65)).unwrap();
        let (mended, word) = loss.mended().unwrap();
        assert_eq!((word.code.as_str(), mended.judge(205)), ("unknown-kept", Unknown));
        assert_eq!((mended.judge(254), mended.judge(0)), (Free, Occupied));
        let warning = loss.warning();
        assert_eq!(warning.code, "unknown-lost");
        assert!(warning.message.contains("16.0 %"), "{}", warning.message);
        assert!(warning.message.ends_with("options.grid.freeThreshold: 0.196"), "{}", warning.message);
        assert_eq!(unknown_lost(&picture, reading(Mode::Trinary, false, 0.196, 0.65)), None);
    }
}
