//! The pieces of a row, one after another.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::decomposition::ground::Axis;
use crate::decomposition::parcel::Parcel;
use crate::plot::PlotKind;

/// Pieces that follow one another without a gap, ascending.
pub(super) struct PieceRow {
    pub axis: Axis,
    pub across: Range<usize>,
    pub pieces: Vec<Parcel>,
}

impl PieceRow {
    /// The rows of some pieces along `axis`.
    pub fn all<'a>(pieces: impl Iterator<Item = &'a Parcel>, axis: Axis) -> Vec<Self> {
        let mut by_lines: BTreeMap<(usize, usize), Vec<Parcel>> = BTreeMap::new();
        for piece in pieces {
            let across = piece.rect.range(axis.other());
            by_lines.entry((across.start, across.end)).or_default().push(piece.clone());
        }
        let mut rows = Vec::new();
        for ((start, end), mut pieces) in by_lines {
            pieces.sort_by_key(|piece| piece.rect.range(axis).start);
            for row in pieces.chunk_by(|one, next| one.rect.range(axis).end == next.rect.range(axis).start) {
                rows.push(Self { axis, across: start..end, pieces: row.to_vec() });
            }
        }
        rows
    }

    /// Range of a piece along the row.
    pub fn along(&self, piece: &Parcel) -> Range<usize> {
        piece.rect.range(self.axis).clone()
    }

    /// Whether any of its pieces is a place.
    pub fn holds_places(&self) -> bool {
        self.pieces.iter().any(|piece| piece.kind == PlotKind::Place)
    }
}
