//! The pieces that a comb cuts a row into, and what each is.

use std::ops::Range;

use super::comb::{Comb, PieceKind};
use super::rack_row::RackRow;
use crate::decomposition::ground::RegionFrame;
use crate::decomposition::parcel::Parcel;
use crate::plot::PlotKind;

/// Narrower pieces that are no place are given to a neighbour, metres.
const SLIVER_M: f64 = 0.4;
/// A piece at an end of the row whose width differs from the pitch by less than this share of the pitch is a place.
const END_SHARE: f64 = 0.3;

/// The pieces of a comb at a pitch, metres: ranges of cells, ascending, without slivers.
pub(super) fn of_comb(comb: &Comb, pitch: f64, frame: &RegionFrame) -> Vec<(Range<usize>, PlotKind)> {
    let mut pieces: Vec<(Range<usize>, PlotKind)> = Vec::new();
    let mut start = 0;
    for &(kind, end) in &comb.pieces {
        if end <= start {
            continue;
        }
        let width = (end - start) as f64 * frame.cell;
        let kind = match kind {
            PieceKind::Place => PlotKind::Place,
            PieceKind::Passage => PlotKind::Passage,
            PieceKind::End if (width - pitch).abs() < END_SHARE * pitch => PlotKind::Place,
            PieceKind::PhaseSlip | PieceKind::End => PlotKind::Other,
        };
        pieces.push((start..end, kind));
        start = end;
    }
    without_slivers(pieces, frame.cells_of(SLIVER_M))
}

/// The pieces of a row of some length that is one place, cells.
pub(super) fn of_one_place(place: Range<usize>, length: usize) -> Vec<(Range<usize>, PlotKind)> {
    let pieces =
        [(0..place.start, PlotKind::Other), (place.clone(), PlotKind::Place), (place.end..length, PlotKind::Other)];
    pieces.into_iter().filter(|(range, _)| !range.is_empty()).collect()
}

/// The pieces of a row of some length by the borders of its places, cells; without slivers.
pub(super) fn of_borders(borders: &[usize], length: usize, frame: &RegionFrame) -> Vec<(Range<usize>, PlotKind)> {
    let [first, last] = [borders.first(), borders.last()].map(|border| border.copied().unwrap_or(0));
    let ends = [(0..first, PlotKind::Other), (last..length, PlotKind::Other)];
    let places = borders.windows(2).map(|pair| (pair[0]..pair[1], PlotKind::Place));
    let [before, after] = ends;
    let pieces = std::iter::once(before).chain(places).chain([after]).filter(|(range, _)| !range.is_empty());
    without_slivers(pieces.collect(), frame.cells_of(SLIVER_M))
}

/// The pieces of a row as parcels.
pub(super) fn parcels(row: &RackRow, pieces: Vec<(Range<usize>, PlotKind)>) -> impl Iterator<Item = Parcel> {
    let start = row.rect.range(row.axis).start;
    pieces.into_iter().map(move |(piece, kind)| {
        let rect = row.rect.with(row.axis, start + piece.start..start + piece.end);
        Parcel { layers: row.layers.clone(), ..Parcel::new(rect, kind, Some(row.axis)) }
    })
}

/// Gives pieces of no kind that are shorter than `least` to the shorter of their neighbours, from the first one on.
fn without_slivers(pieces: Vec<(Range<usize>, PlotKind)>, least: usize) -> Vec<(Range<usize>, PlotKind)> {
    let mut kept: Vec<(Range<usize>, PlotKind)> = Vec::with_capacity(pieces.len());
    let mut rest = pieces.into_iter().peekable();
    while let Some((range, kind)) = rest.next() {
        let is_sliver = kind == PlotKind::Other && range.len() < least;
        match (kept.last_mut(), rest.peek_mut()) {
            (Some((before, _)), Some((after, _))) if is_sliver && before.len() <= after.len() => before.end = range.end,
            (_, Some((after, _))) if is_sliver => after.start = range.start,
            (Some((before, _)), None) if is_sliver => before.end = range.end,
            _ => kept.push((range, kind)),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The first sliver goes to a neighbour, until there is none; quadratic.
    fn one_by_one(mut pieces: Vec<(Range<usize>, PlotKind)>, least: usize) -> Vec<(Range<usize>, PlotKind)> {
        let is_sliver = |(range, kind): &(Range<usize>, PlotKind)| *kind == PlotKind::Other && range.len() < least;
        while let Some(index) = pieces.iter().position(is_sliver).filter(|_| pieces.len() > 1) {
            let (range, _) = pieces.remove(index);
            let before = index.checked_sub(1).map(|before| pieces[before].0.len());
            let after = pieces.get(index).map(|(range, _)| range.len());
            match (before, after) {
                (Some(before), Some(after)) if after < before => pieces[index].0.start = range.start,
                (Some(_), _) => pieces[index - 1].0.end = range.end,
                (None, _) => pieces[index].0.start = range.start,
            }
        }
        pieces
    }

    proptest! {
        #[test]
        fn slivers_go_to_the_shorter_neighbour(lengths in proptest::collection::vec((1_usize..20, 0_usize..3), 0..30)) {
            let kinds = [PlotKind::Place, PlotKind::Passage, PlotKind::Other];
            let pieces: Vec<_> = lengths.iter().scan(0, |end, &(length, kind)| {
                *end += length;
                Some((*end - length..*end, kinds[kind]))
            }).collect();
            prop_assert_eq!(without_slivers(pieces.clone(), 8), one_by_one(pieces, 8));
        }
    }
}
