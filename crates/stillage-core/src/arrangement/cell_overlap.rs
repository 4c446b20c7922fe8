//! The cells that faces of two arrangements of one grid have in common.

use std::collections::HashMap;

use super::cell_faces::CellFaces;
use super::ids::FaceId;

/// Cells that lie in a face of one arrangement and in a face of another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CellOverlap {
    /// The face of the new arrangement.
    pub new: FaceId,
    /// The face of the old one.
    pub old: FaceId,
    /// How many cells they have in common.
    pub cells: u64,
}

impl CellFaces {
    /// The overlaps with the faces of an old arrangement of the same grid, the unbounded faces too, ascending. O(cells).
    #[must_use]
    pub fn overlaps(&self, old: &Self) -> Vec<CellOverlap> {
        let mut counts: HashMap<(FaceId, FaceId), u64> = HashMap::new();
        // Neighbours mostly lie in the same faces: a run of them is counted at once.
        for (new, run) in self.runs(0..self.len().min(old.len())) {
            for (old, run) in old.runs(run) {
                *counts.entry((new, old)).or_default() += run.len() as u64;
            }
        }
        let overlap = |((new, old), cells)| CellOverlap { new, old, cells };
        let mut overlaps: Vec<CellOverlap> = counts.into_iter().map(overlap).collect();
        overlaps.sort_unstable_by_key(|overlap| (overlap.new, overlap.old));
        overlaps
    }
}
