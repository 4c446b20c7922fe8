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
//! Cost: O(cells of the row + dividers^3). Limits: a row of fewer than [`LEAST_PLACES`] places shows no pitch of its own;
//! rows whose bays are parted by uprights of some width have no lattice.

use std::collections::BTreeMap;
use std::ops::Range;

use super::Reading;
use super::evidence::RowEvidence;
use super::rack_row::RackRow;
use crate::decomposition::ground::{Patch, RegionFrame};
use crate::plot::PlotKind;
use crate::runs::runs_where;

/// A line with at least this share of its length filled is a front or a back. Half of the places of a row may be empty.
const RIM_SHARE: f64 = 0.45;
/// The steps of a slanted line lie on the lines beside it; least share of a line that they take.
const STEP_SHARE: f64 = 0.08;
/// A row with more of its depth in such lines is solid, a share.
const SOLID_SHARE: f64 = 0.4;
/// Lumps with a gap below this share of the usual gap between them are one divider: the legs of two neighbours.
const JOINED_SHARE: f64 = 0.4;
/// Widest divider, as a share of the usual gap.
const WIDEST_SHARE: f64 = 0.45;
/// Greatest share of a row that goods and columns wider than dividers may take.
const WIDE_SHARE: f64 = 0.2;
/// Widest gap between the goods of two places, metres: a wider one is floor.
const WIDEST_GAP_M: f64 = 0.3;
/// Least share of the depth that goods fill.
const GOODS_SHARE: f64 = 0.5;
/// Pitches that dividers may have, metres: narrower are the stringers of pallets.
const PITCHES_M: [f64; 2] = [0.7, 3.2];
/// Tolerance of a place on the lattice: a share of the pitch, and metres for the cells at both ends.
const TOLERANCE_SHARE: f64 = 0.06;
const TOLERANCE_M: f64 = 0.05;
/// What a border of the lattice without a divider costs, and a divider off the lattice; a divider on it gains 1.
const MISSING_COST: f64 = 0.35;
const STRAY_COST: f64 = 0.7;
/// Least share of the borders that show dividers, and of the dividers that are borders.
const SEEN_SHARE: f64 = 0.6;
const EXPLAINED_SHARE: f64 = 0.75;
/// Least number of places that show a pitch of their own, and that show a phase.
const LEAST_PLACES: usize = 3;
const LEAST_PLACES_OF_PITCH: usize = 2;
/// Most dividers that a pair which tells the pitch is apart.
const APART: usize = 3;
/// Least number of places of all divided rows of a direction, and least share of the length of its rows.
const LEAST_PLACES_OF_ALL: usize = 8;
const LEAST_SHARE_OF_ALL: f64 = 0.5;

/// The borders between the places of a row.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Dividers {
    /// Where the dividers are, and those that are missing beside empty places: cells from the start of the row.
    borders: Vec<usize>,
}

impl Dividers {
    /// The pieces of its row of some length, cells.
    pub(super) fn pieces(&self, length: usize) -> Vec<(Range<usize>, PlotKind)> {
        let borders = [&[0], self.borders.as_slice(), &[length]].concat();
        let kind = |index: usize| {
            let is_inside = index > 0 && index + 2 < borders.len();
            if is_inside { PlotKind::Place } else { PlotKind::Other }
        };
        let pieces = borders.windows(2).enumerate().map(|(index, pair)| (pair[0]..pair[1], kind(index)));
        pieces.filter(|(range, _)| !range.is_empty()).collect()
    }
}

/// Parts the rows of one direction in those that show dividers and the others, with their evidence; none is divided unless
/// most of their length is.
pub(super) fn parted(
    frame: &RegionFrame,
    rows: Vec<RackRow>,
    evidence: Vec<RowEvidence>,
    reading: Reading,
) -> (Vec<(RackRow, Dividers)>, Vec<RackRow>, Vec<RowEvidence>) {
    let marks: Vec<Option<Vec<f64>>> = rows.iter().map(|row| marks(frame, row, reading)).collect();
    let mut lattices: Vec<Option<Lattice>> =
        marks.iter().map(|marks| Lattice::of(marks.as_ref()?, frame.cell)).collect();
    if let Some(pitch) = usual_pitch(&lattices) {
        for (lattice, marks) in lattices.iter_mut().zip(&marks).filter(|(lattice, _)| lattice.is_none()) {
            *lattice = marks.as_ref().and_then(|marks| Lattice::at(marks, pitch, frame.cell));
        }
    }
    let along = |row: &RackRow| row.rect.range(row.axis).clone();
    let is_divided = |(_, lattice): &(&RackRow, &Option<Lattice>)| lattice.is_some();
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
            let dividers =
                Dividers { borders: lattice.borders(ends[&along(&row).start], along(&row).len(), frame.cell) };
            found.0.push((row, dividers));
        } else {
            found.1.push(row);
            found.2.push(evidence);
        }
    }
    found
}

/// The pitch of most places, cells.
fn usual_pitch(lattices: &[Option<Lattice>]) -> Option<f64> {
    lattices.iter().flatten().max_by_key(|lattice| lattice.count).map(|lattice| lattice.pitch)
}

/// First and last border of the rows that begin at the same line, by that line.
fn shared_ends<'a>(rows: impl Iterator<Item = (Range<usize>, &'a Option<Lattice>)>) -> BTreeMap<usize, [f64; 2]> {
    let mut ends: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    for (along, lattice) in rows {
        let Some(lattice) = lattice else { continue };
        let last = lattice.first + lattice.pitch * lattice.count as f64;
        let [low, high] = ends.entry(along.start).or_insert([lattice.first, last]);
        (*low, *high) = (low.min(lattice.first), high.max(last));
    }
    ends
}

/// Borders at regular distances along a row, cells.
#[derive(Debug, Clone, PartialEq)]
struct Lattice {
    /// The first border that shows a divider.
    first: f64,
    pitch: f64,
    /// Number of places up to the last border that shows one.
    count: usize,
    score: f64,
}

impl Lattice {
    /// The lattice that explains the dividers of a row best.
    fn of(marks: &[f64], cell: f64) -> Option<Self> {
        let mut best: Option<Self> = None;
        for (index, &mark) in marks.iter().enumerate() {
            for (&next, apart) in marks[index + 1..].iter().zip(0..APART) {
                for places in 1..=apart + 1 {
                    let pitch = (next - mark) / places as f64;
                    if !(PITCHES_M[0]..=PITCHES_M[1]).contains(&(pitch * cell)) {
                        continue;
                    }
                    let found = Self::through(marks, mark, pitch, cell, LEAST_PLACES);
                    best = better(best, found);
                }
            }
        }
        best
    }

    /// The same at a pitch, cells.
    fn at(marks: &[f64], pitch: f64, cell: f64) -> Option<Self> {
        let found = marks.iter().map(|&mark| Self::through(marks, mark, pitch, cell, LEAST_PLACES_OF_PITCH));
        found.fold(None, better)
    }

    /// The lattice through a mark, moved and stretched to fit the marks on it.
    fn through(marks: &[f64], mark: f64, pitch: f64, cell: f64, least: usize) -> Option<Self> {
        let tolerance = TOLERANCE_SHARE * pitch + TOLERANCE_M / cell;
        // Number of the border nearest to each mark that lies on the lattice.
        let on = |first: f64, pitch: f64| -> Vec<(f64, f64)> {
            let number = |&place: &f64| (((place - first) / pitch).round(), place);
            let is_near = |&(number, place): &(f64, f64)| (place - first - number * pitch).abs() <= tolerance;
            marks.iter().map(number).filter(is_near).collect()
        };
        let (first, pitch) = fitted(&on(mark, pitch), mark, pitch);
        let met = on(first, pitch);
        let mut numbers: Vec<i64> = met.iter().map(|&(number, _)| number as i64).collect();
        numbers.dedup();
        let (low, high) = (*numbers.first()?, *numbers.last()?);
        let (seen, borders) = (numbers.len() as f64, (high - low + 1) as f64);
        let is_regular = numbers.len() > least
            && seen >= SEEN_SHARE * borders
            && met.len() as f64 >= EXPLAINED_SHARE * marks.len() as f64;
        let score = seen - MISSING_COST * (borders - seen) - STRAY_COST * (marks.len() - met.len()) as f64;
        is_regular.then(|| Self { first: first + low as f64 * pitch, pitch, count: (high - low) as usize, score })
    }

    /// The borders of a row of some length that begins and ends like its neighbours, cells.
    fn borders(&self, [low, high]: [f64; 2], length: usize, cell: f64) -> Vec<usize> {
        let tolerance = TOLERANCE_SHARE * self.pitch + TOLERANCE_M / cell;
        let before = ((self.first - low + tolerance) / self.pitch).floor().max(0.0) as i64;
        let after = ((high + tolerance - self.first) / self.pitch).floor().max(self.count as f64) as i64;
        let border = |number: i64| (self.first + number as f64 * self.pitch).round().clamp(0.0, length as f64) as usize;
        let mut borders: Vec<usize> = (-before..=after).map(border).collect();
        borders.dedup();
        borders
    }
}

fn better(one: Option<Lattice>, other: Option<Lattice>) -> Option<Lattice> {
    match (one, other) {
        (Some(one), Some(other)) => Some(if other.score > one.score { other } else { one }),
        (one, other) => one.or(other),
    }
}

/// First border and pitch by least squares from numbered borders; those given where a single one is known.
fn fitted(numbered: &[(f64, f64)], first: f64, pitch: f64) -> (f64, f64) {
    let count = numbered.len() as f64;
    let [numbers, places] =
        [0, 1].map(|part| numbered.iter().map(|pair| if part == 0 { pair.0 } else { pair.1 }).sum::<f64>() / count);
    let square: f64 = numbered.iter().map(|(number, _)| (number - numbers).powi(2)).sum();
    if square <= 0.0 {
        return (first, pitch);
    }
    let product: f64 = numbered.iter().map(|(number, place)| (number - numbers) * (place - places)).sum();
    let pitch = product / square;
    (places - numbers * pitch, pitch)
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
        return dividers(&lumps, length);
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
    let (thin, wide): (Vec<Range<usize>>, Vec<Range<usize>>) =
        joined.into_iter().partition(|lump| lump.len() as f64 <= WIDEST_SHARE * usual);
    let taken: usize = wide.iter().map(ExactSizeIterator::len).sum();
    let middle = |lump: Range<usize>| f64::midpoint(lump.start as f64, lump.end as f64);
    (taken as f64 <= WIDE_SHARE * length as f64).then(|| thin.into_iter().map(middle).collect())
}
