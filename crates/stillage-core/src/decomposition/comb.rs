//! The borders of the places of a row, by dynamic programming.
//!
//! A row is read as a sequence of places about a pitch wide, slips (an upright between bays, a building column: the phase
//! starts anew) and clear gaps (a passage through the row). Each border earns what the cells say for it, each place pays
//! for its deviation from the pitch, slips and gaps pay a fee, and a gap earns by its length. The best sequence is found
//! exactly: a segmental model in the manner of a comb filter with springs. What is not seen is bridged by the pitch, what
//! is seen moves the borders. A place with its goods on one side costs, whatever its borders earn: goods are not cut in
//! two, and where goods end, a place ends.
//!
//! Source: the accuracy study behind this project for evidence and springs; slips and gaps are new. Cost: O(cells x
//! widths) per row and pitch.

use std::collections::VecDeque;
use std::ops::Range;

use super::evidence::Evidence;

/// How much narrower and wider than the pitch a place may be, metres: drift, and an upright now and then.
pub(super) const NARROWER_M: f64 = 0.08;
pub(super) const WIDER_M: f64 = 0.16;
/// Deviation from the pitch that costs 1, metres (accuracy study).
const SPRING_M: f64 = 0.10;
/// Cost of a place whose goods all stand on one side, and the unevenness that places have anyway.
const UNEVEN_COST: f64 = 1.0;
const USUAL_UNEVENNESS: f64 = 0.25;
/// Cost of a place's width of ground beyond the first and last border (accuracy study).
const LOOSE_END: f64 = 0.15;
/// Shortest slip, metres, and its cost.
const SLIP_M: f64 = 0.1;
const SLIP_COST: f64 = 3.0;
/// Shortest gap, metres, its cost, what a clear metre earns and what one that is not clear costs.
const GAP_M: f64 = 1.2;
const GAP_COST: f64 = 6.0;
const CLEAR_GAIN: f64 = 1.6;
const CONTENT_LOSS: f64 = 12.0;

/// What lies between two borders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Tooth {
    /// A place.
    Place,
    /// Too narrow for a place.
    Slip,
    /// A passage.
    Gap,
    /// Beyond the first or last border.
    End,
}

/// A row cut into pieces.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Comb {
    /// What the pieces are, and where each ends, cells, ascending to the end of the row.
    pub pieces: Vec<(Tooth, usize)>,
    /// What the borders earned after all costs.
    pub score: f64,
    /// Number of borders.
    pub borders: usize,
}

/// What even goods earn.
pub(super) fn even(evidence: &Evidence) -> impl Fn(usize, usize) -> f64 {
    |start, width| UNEVEN_COST * (USUAL_UNEVENNESS - evidence.unevenness(start, width))
}

impl Comb {
    /// The places, as ranges of cells.
    pub(super) fn places(&self) -> impl Iterator<Item = Range<usize>> {
        let starts = std::iter::once(0).chain(self.pieces.iter().map(|&(_, end)| end));
        let ranges = starts.zip(&self.pieces).map(|(start, &(tooth, end))| (tooth, start..end));
        ranges.filter(|(tooth, range)| *tooth == Tooth::Place && !range.is_empty()).map(|(_, range)| range)
    }
}

/// Widths of the pieces in cells.
struct Widths {
    pitch: f64,
    narrowest: usize,
    widest: usize,
    slip: usize,
    gap: usize,
}

/// Cuts a row at a pitch, metres.
pub(super) fn cut(evidence: &Evidence, pitch: f64, place: impl Fn(usize, usize) -> f64) -> Comb {
    let cell = evidence.cell;
    let cells = |metres: f64| (metres / cell).round() as usize;
    let widths = Widths {
        pitch: pitch / cell,
        narrowest: cells(pitch - NARROWER_M).max(2),
        widest: cells(pitch + WIDER_M).max(2),
        slip: cells(SLIP_M).max(1),
        gap: cells(GAP_M).max(1),
    };
    let gain: Vec<f64> = std::iter::once(0.0)
        .chain(evidence.is_clear.iter().scan(0.0, |sum, &is_clear| {
            *sum += cell * if is_clear { CLEAR_GAIN } else { -CONTENT_LOSS };
            Some(*sum)
        }))
        .collect();
    let (best, from) = forward(evidence, &gain, &widths, SPRING_M / cell, place);
    backward(&evidence.border, &gain, &widths, &best, &from)
}

/// Best score with a border at each cell, and the piece that leads there: its kind and start.
type Step = (Tooth, usize);

fn forward(
    evidence: &Evidence,
    gain: &[f64],
    widths: &Widths,
    spring: f64,
    place: impl Fn(usize, usize) -> f64,
) -> (Vec<f64>, Vec<Step>) {
    let border = &evidence.border;
    let mut best = vec![f64::NEG_INFINITY; border.len()];
    let mut from = vec![(Tooth::End, 0); border.len()];
    // The best border to start a gap from, with the gain up to there taken off.
    let (mut gap_start, mut gap_score) = (0, f64::NEG_INFINITY);
    // The borders that a slip may start from, best first; the rest of them are worse than one after them.
    let mut slip_starts = VecDeque::new();
    let stretches: Vec<f64> =
        (widths.narrowest..=widths.widest).map(|width| ((width as f64 - widths.pitch) / spring).powi(2)).collect();
    for at in 0..border.len() {
        let mut offer = |score: f64, step: Step| {
            if score > best[at] {
                (best[at], from[at]) = (score, step);
            }
        };
        if at <= widths.widest {
            offer(border[at] - LOOSE_END * at as f64 / widths.pitch, (Tooth::End, 0));
        }
        if at >= widths.gap {
            offer(border[at] + gain[at] - GAP_COST / 2.0, (Tooth::Gap, usize::MAX));
        }
        let mut candidates = [(f64::NEG_INFINITY, 0, Tooth::Place); 2];
        for (width, stretch) in (widths.narrowest..=at).zip(&stretches) {
            let score = best[at - width] - stretch + place(at - width, width);
            if score > candidates[0].0 {
                candidates[0] = (score, at - width, Tooth::Place);
            }
        }
        if let Some(start) = at.checked_sub(widths.slip) {
            while slip_starts.back().is_some_and(|&last| best[last] <= best[start]) {
                slip_starts.pop_back();
            }
            slip_starts.push_back(start);
            while slip_starts.front().is_some_and(|&first| at - first >= widths.narrowest) {
                slip_starts.pop_front();
            }
        }
        if let Some(&start) = slip_starts.front() {
            candidates[1] = (best[start] - SLIP_COST, start, Tooth::Slip);
        }
        if let Some(start) = at.checked_sub(widths.gap) {
            let score = best[start] - gain[start];
            if score > gap_score {
                (gap_score, gap_start) = (score, start);
            }
        }
        for (score, start, tooth) in candidates {
            if score + border[at] > best[at] {
                (best[at], from[at]) = (score + border[at], (tooth, start));
            }
        }
        let through = gap_score + gain[at] - GAP_COST + border[at];
        if through > best[at] {
            (best[at], from[at]) = (through, (Tooth::Gap, gap_start));
        }
    }
    (best, from)
}

fn backward(border: &[f64], gain: &[f64], widths: &Widths, best: &[f64], from: &[Step]) -> Comb {
    let length = border.len();
    let (mut last, mut score, mut tooth) = (None, 0.0, Tooth::End);
    let whole = *gain.last().unwrap_or(&0.0);
    if length > widths.gap && whole - GAP_COST / 2.0 > 0.0 {
        (score, tooth) = (whole - GAP_COST / 2.0, Tooth::Gap);
    }
    for at in 0..length {
        let left = length - 1 - at;
        let mut offer = |offered: f64, kind: Tooth| {
            if offered > score || last.is_none() && kind == Tooth::End && tooth == Tooth::End {
                (last, score, tooth) = (Some(at), offered, kind);
            }
        };
        if left <= widths.widest {
            offer(best[at] - LOOSE_END * left as f64 / widths.pitch, Tooth::End);
        }
        if left >= widths.gap {
            offer(best[at] + whole - gain[at] - GAP_COST / 2.0, Tooth::Gap);
        }
    }
    let mut pieces = vec![(tooth, length)];
    let mut borders = 0;
    while let Some(at) = last {
        borders += 1;
        let (kind, start) = from[at];
        pieces.push((kind, at));
        let is_first = kind == Tooth::End || start == usize::MAX;
        last = (!is_first).then_some(start);
    }
    pieces.reverse();
    Comb { pieces, score, borders }
}
