//! Rows that show what divides their places, and not what stands in them: uprights, the lines of a drawing, the legs of
//! two neighbours.
//!
//! Whatever is thin and stands in clear ground at a regular distance bounds places: goods are wider than the gaps beside
//! them, dividers are narrower. So the borders of such a row are known where they show, and a gap as long as several places
//! holds several empty ones.
//!
//! Method: lines that are filled along most of the row are its front and its back and are left out. The columns that are
//! not clear in the other lines form lumps. Lumps nearer to each other than [`JOINED_SHARE`] of the usual gap are one
//! divider. A row is divided if one lattice, a pitch and a phase, explains most of its dividers and most of the lattice
//! shows dividers. Rows that show too little take the pitch of the others, and rows between the same two cross aisles begin
//! and end together.
//!
//! Cost: O(cells of the row + dividers^2). Limits: a row of two places shows no pitch of its own; rows whose bays are parted
//! by uprights of some width have no lattice.

use std::collections::BTreeMap;
use std::ops::Range;

use super::divider_lattice::DividerLattice;
use super::evidence::RowEvidence;
use super::rack_row::RackRow;
use super::reading::Reading;
use crate::decomposition::ground::{Patch, RegionFrame};
use crate::runs::runs_where;

/// A line with at least this share of its length filled is a front or a back. Half of the places of a row may be empty.
const RIM_SHARE: f64 = 0.45;
/// The steps of a slanted line lie on the lines beside it; least share of a line that they take.
const STEP_SHARE: f64 = 0.08;
/// A row with more of its depth in such lines is solid, a share.
const SOLID_SHARE: f64 = 0.4;
/// Lumps with a gap below this share of the usual gap between them are one divider: the legs of two neighbours.
const JOINED_SHARE: f64 = 0.4;
/// Widest divider, and widest one of several lumps, as shares of the usual gap.
const WIDEST_SHARE: f64 = 0.45;
const WIDEST_JOINED_SHARE: f64 = 0.75;
/// Widest pause in the line of a front, metres.
const WIDEST_PAUSE_M: f64 = 1.1;
/// Greatest share of a row that goods and columns wider than dividers may take.
const WIDE_SHARE: f64 = 0.2;
/// Widest gap between the goods of two places, metres: a wider one is floor.
const WIDEST_GAP_M: f64 = 0.3;
/// Least share of the depth that goods fill.
const GOODS_SHARE: f64 = 0.5;
/// Least number of places of all divided rows of a direction, and least share of the length of its rows.
const LEAST_PLACES_OF_ALL: usize = 8;
const LEAST_SHARE_OF_ALL: f64 = 0.5;

/// A row with the borders between its places, cells from its start.
pub(super) struct DividedRow {
    pub row: RackRow,
    pub borders: Vec<usize>,
}

/// Parts the rows of one direction in those that show dividers and the others, with their evidence; none is divided unless
/// most of their length is.
pub(super) fn parted(
    frame: &RegionFrame,
    rows: Vec<RackRow>,
    evidence: Vec<RowEvidence>,
    reading: Reading,
) -> (Vec<DividedRow>, Vec<RackRow>, Vec<RowEvidence>) {
    let marks: Vec<Option<Vec<f64>>> = rows.iter().map(|row| marks(frame, row, reading)).collect();
    let mut lattices: Vec<Option<DividerLattice>> =
        marks.iter().map(|marks| DividerLattice::of(marks.as_ref()?, frame.cell)).collect();
    if let Some(pitch) = usual_pitch(&lattices) {
        for (lattice, marks) in lattices.iter_mut().zip(&marks).filter(|(lattice, _)| lattice.is_none()) {
            *lattice = marks.as_ref().and_then(|marks| DividerLattice::at(marks, pitch, frame.cell));
        }
    }
    let along = |row: &RackRow| row.rect.range(row.axis).clone();
    let is_divided = |(_, lattice): &(&RackRow, &Option<DividerLattice>)| lattice.is_some();
    let whole: usize = rows.iter().map(|row| along(row).len()).sum();
    let divided: usize = rows.iter().zip(&lattices).filter(is_divided).map(|(row, _)| along(row).len()).sum();
    let places: usize = lattices.iter().flatten().map(|lattice| lattice.count).sum();
    if places < LEAST_PLACES_OF_ALL || (divided as f64) < LEAST_SHARE_OF_ALL * whole as f64 {
        return (Vec::new(), rows, evidence);
    }
    let ends = shared_ends(rows.iter().map(along).zip(&lattices));
    let mut found = (Vec::new(), Vec::new(), Vec::new());
    for ((row, evidence), lattice) in rows.into_iter().zip(evidence).zip(lattices) {
        if let Some(lattice) = lattice {
            let along = along(&row);
            let borders = lattice.borders(ends[&along.start], along.len(), frame.cell);
            found.0.push(DividedRow { row, borders });
        } else {
            found.1.push(row);
            found.2.push(evidence);
        }
    }
    found
}

/// The pitch of most places, cells.
fn usual_pitch(lattices: &[Option<DividerLattice>]) -> Option<f64> {
    lattices.iter().flatten().max_by_key(|lattice| lattice.count).map(|lattice| lattice.pitch)
}

/// First and last border of the rows that begin at the same line, by that line.
fn shared_ends<'a>(
    rows: impl Iterator<Item = (Range<usize>, &'a Option<DividerLattice>)>,
) -> BTreeMap<usize, [f64; 2]> {
    let mut ends: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    for (along, lattice) in rows {
        let Some(lattice) = lattice else { continue };
        let last = lattice.first + lattice.pitch * lattice.count as f64;
        let [low, high] = ends.entry(along.start).or_insert([lattice.first, last]);
        (*low, *high) = (low.min(lattice.first), high.max(last));
    }
    ends
}

/// The middles of the dividers of a row, or of the gaps between its goods, cells from its start; `None` where it shows
/// neither.
fn marks(frame: &RegionFrame, row: &RackRow, reading: Reading) -> Option<Vec<f64>> {
    let length = row.rect.range(row.axis).len();
    let mut is_clear = vec![true; length];
    let mut is_solid = false;
    for layer in row.patches(frame) {
        is_solid |= mark_lumps(&layer, &mut is_clear).is_none();
    }
    if !is_solid {
        let lumps: Vec<Range<usize>> = runs_where(length, |column| !is_clear[column]).collect();
        return dividers(&lumps, length).or_else(|| pauses(frame, row));
    }
    if reading == Reading::Goods {
        return None;
    }
    let mut is_clear = vec![true; length];
    for layer in row.patches(frame) {
        mark_goods(&layer, &mut is_clear);
    }
    gaps(&is_clear, frame.cells_of(WIDEST_GAP_M))
}

/// The middles of the pauses in the lines along the fronts of a row, cells from its start.
fn pauses(frame: &RegionFrame, row: &RackRow) -> Option<Vec<f64>> {
    let mut is_clear = vec![true; row.rect.range(row.axis).len()];
    for layer in row.patches(frame) {
        for line in 0..layer.height {
            is_clear.iter_mut().zip(layer.row(line)).for_each(|(is_clear, cell)| *is_clear &= cell.is_free());
        }
    }
    gaps(&is_clear, frame.cells_of(WIDEST_PAUSE_M))
}

/// Marks the columns of a layer that hold goods.
fn mark_goods(layer: &Patch, is_clear: &mut [bool]) {
    for (column, is_clear) in is_clear.iter_mut().enumerate() {
        let filled = (0..layer.height).filter(|&line| !layer.row(line)[column].is_free()).count();
        *is_clear &= (filled as f64) < GOODS_SHARE * layer.height as f64;
    }
}

/// The middles of gaps between goods; `None` where there are none.
fn gaps(is_clear: &[bool], widest: usize) -> Option<Vec<f64>> {
    let gaps = runs_where(is_clear.len(), |column| is_clear[column]);
    let is_inside = |gap: &Range<usize>| gap.start > 0 && gap.end < is_clear.len() && gap.len() <= widest;
    let middles: Vec<f64> = gaps.filter(is_inside).map(|gap| f64::midpoint(gap.start as f64, gap.end as f64)).collect();
    (!middles.is_empty()).then_some(middles)
}

/// Marks the columns of a layer that are not clear beside its front and its back; `None` for solid goods.
fn mark_lumps(layer: &Patch, is_clear: &mut [bool]) -> Option<()> {
    let share = |lines: Range<usize>, columns: &mut dyn Iterator<Item = usize>| {
        let is_taken = |column: &usize| lines.clone().any(|line| !layer.row(line)[*column].is_free());
        columns.filter(is_taken).count() as f64 / layer.width.max(1) as f64
    };
    let is_filled = |line: &usize| {
        let near = line.saturating_sub(1)..(line + 2).min(layer.height);
        share(*line..line + 1, &mut (0..layer.width)) >= STEP_SHARE && share(near, &mut (0..layer.width)) >= RIM_SHARE
    };
    let filled: Vec<usize> = (0..layer.height).filter(is_filled).collect();
    (filled.len() as f64 <= SOLID_SHARE * layer.height as f64).then_some(())?;
    for line in (0..layer.height).filter(|line| !filled.contains(line)) {
        is_clear.iter_mut().zip(layer.row(line)).for_each(|(is_clear, cell)| *is_clear &= cell.is_free());
    }
    Some(())
}

/// The middles of dividers, cells; `None` where lumps are too wide or too few.
fn dividers(lumps: &[Range<usize>], length: usize) -> Option<Vec<f64>> {
    let mut gaps: Vec<usize> = lumps.windows(2).map(|pair| pair[1].start - pair[0].end).collect();
    gaps.sort_unstable();
    let whole: usize = gaps.iter().sum();
    let mut passed = 0;
    // The gap at the middle of the length of all gaps.
    let usual = *gaps.iter().find(|&&gap| {
        passed += gap;
        2 * passed >= whole
    })? as f64;
    let mut joined: Vec<Range<usize>> = Vec::with_capacity(lumps.len());
    for lump in lumps {
        match joined.last_mut() {
            Some(last) if ((lump.start - last.end) as f64) < JOINED_SHARE * usual => last.end = lump.end,
            _ => joined.push(lump.clone()),
        }
    }
    let is_thin = |lump: &Range<usize>| lump.len() as f64 <= WIDEST_SHARE * usual;
    let is_wide = |lump: &&Range<usize>| !is_thin(lump);
    let is_of_wide = |joined: &Range<usize>| {
        lumps.iter().filter(is_wide).any(|lump| joined.start <= lump.start && lump.end <= joined.end)
    };
    let (thin, wide): (Vec<Range<usize>>, Vec<Range<usize>>) =
        joined.into_iter().partition(|lump| lump.len() as f64 <= WIDEST_JOINED_SHARE * usual && !is_of_wide(lump));
    let taken: usize = wide.iter().map(ExactSizeIterator::len).sum();
    let middle = |lump: Range<usize>| f64::midpoint(lump.start as f64, lump.end as f64);
    (taken as f64 <= WIDE_SHARE * length as f64).then(|| thin.into_iter().map(middle).collect())
}
