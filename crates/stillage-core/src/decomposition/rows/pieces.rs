//! The pieces that a comb cuts a row into, and what each is.

use std::ops::Range;

use super::comb::{Comb, Tooth};
use crate::decomposition::ground::Frame;
use crate::decomposition::plot::PlotKind;

/// Pieces narrower than this are given to their neighbour, metres.
const SLIVER_M: f64 = 0.4;
/// An end piece that differs from the pitch by less than this share of it is a place.
const END_SHARE: f64 = 0.3;

/// The pieces of a comb at a pitch, metres: ranges of cells, ascending, without slivers.
pub(super) fn of_comb(comb: &Comb, pitch: f64, frame: &Frame) -> Vec<(Range<usize>, PlotKind)> {
    let mut pieces: Vec<(Range<usize>, PlotKind)> = Vec::new();
    let mut start = 0;
    for &(tooth, end) in &comb.pieces {
        if end <= start {
            continue;
        }
        let width = (end - start) as f64 * frame.cell;
        let kind = match tooth {
            Tooth::Place => PlotKind::Place,
            Tooth::Gap => PlotKind::Passage,
            Tooth::End if (width - pitch).abs() < END_SHARE * pitch => PlotKind::Place,
            Tooth::Slip | Tooth::End => PlotKind::Other,
        };
        pieces.push((start..end, kind));
        start = end;
    }
    absorb_slivers(&mut pieces, frame.cells_of(SLIVER_M));
    pieces
}

/// Gives pieces too narrow for anything to the narrower of their neighbours.
fn absorb_slivers(pieces: &mut Vec<(Range<usize>, PlotKind)>, least: usize) {
    while let Some(index) =
        pieces.iter().position(|(range, kind)| *kind == PlotKind::Other && range.len() < least && pieces.len() > 1)
    {
        let (range, _) = pieces.remove(index);
        let before = index.checked_sub(1).map(|before| pieces[before].0.len());
        let after = pieces.get(index).map(|(range, _)| range.len());
        match (before, after) {
            (Some(before), Some(after)) if after < before => pieces[index].0.start = range.start,
            (Some(_), _) => pieces[index - 1].0.end = range.end,
            (None, _) => pieces[index].0.start = range.start,
        }
    }
}
