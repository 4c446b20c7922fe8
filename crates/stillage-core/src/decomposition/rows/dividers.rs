//! Rows that show what divides their places, and not what stands in them: uprights, the lines of a drawing, the legs of
//! two neighbours.
//!
//! Whatever is thin and stands in clear ground at a regular distance bounds places: goods are wider than the gaps beside
//! them, dividers are narrower. So the borders of such a row are known where they show, and a gap as long as several places
//! holds several empty ones.
//!
//! Method: lines that are filled along most of the row are its front and its back and are left out. The columns that are
//! not clear in the other lines form lumps. Lumps nearer to each other than [`JOINED_SHARE`] of the usual gap are one
//! divider. A row is divided if the distances of its dividers are multiples of one pitch along nearly all of its length.
//!
//! Cost: O(cells of the row). Limits: a row of fewer than [`LEAST_PLACES`] places shows no pitch of its own.

use std::ops::Range;

use super::evidence::RowEvidence;
use super::rack_row::RackRow;
use crate::decomposition::ground::{Patch, RegionFrame};
use crate::plot::PlotKind;
use crate::runs::runs_where;

/// A line with at least this share of its length filled is a front or a back. Half of the places of a row may be empty.
const RIM_SHARE: f64 = 0.4;
/// A row with more of its depth in such lines is solid, a share.
const SOLID_SHARE: f64 = 0.4;
/// Lumps with a gap below this share of the usual gap between them are one divider: the legs of two neighbours.
const JOINED_SHARE: f64 = 0.4;
/// Widest divider, as a share of the usual gap.
const WIDEST_SHARE: f64 = 0.45;
/// Greatest share of a row that goods and columns wider than dividers may take.
const WIDE_SHARE: f64 = 0.2;
/// Pitches that dividers may have, metres: narrower are the stringers of pallets.
const PITCHES_M: [f64; 2] = [0.7, 3.2];
/// Tolerance of a distance: a share of the pitch, and metres for the cells at both ends.
const TOLERANCE_SHARE: f64 = 0.06;
const TOLERANCE_M: f64 = 0.05;
/// Least share of the length between the first and the last divider that regular distances take.
const REGULAR_SHARE: f64 = 0.8;
/// Least number of distances of one pitch that show it.
const LEAST_PLACES: usize = 3;

/// Least number of places of all divided rows of a direction, and least share of the length of its rows.
const LEAST_PLACES_OF_ALL: usize = 8;
const LEAST_SHARE_OF_ALL: f64 = 0.5;

/// The dividers of a row.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Dividers {
    /// Middles of the dividers, and of those that are missing beside empty places: cells from the start of the row.
    pub borders: Vec<usize>,
    /// Distance of the dividers, metres.
    pub pitch: f64,
}

impl Dividers {
    /// The dividers of a row, if it shows any at a regular distance.
    pub(super) fn of(frame: &RegionFrame, row: &RackRow) -> Option<Self> {
        let mut is_clear = vec![true; row.rect.range(row.axis).len()];
        for layer in row.patches(frame) {
            mark_lumps(&layer, &mut is_clear)?;
        }
        let lumps = lumps(&is_clear);
        let middles = dividers(&lumps, is_clear.len())?;
        let pitch = pitch(&middles, frame.cell)?;
        let borders = borders(&middles, pitch, frame.cell)?;
        Some(Self { borders, pitch })
    }

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
) -> (Vec<(RackRow, Dividers)>, Vec<RackRow>, Vec<RowEvidence>) {
    let dividers: Vec<Option<Dividers>> = rows.iter().map(|row| Dividers::of(frame, row)).collect();
    let length = |row: &RackRow| row.rect.range(row.axis).len();
    let whole: usize = rows.iter().map(length).sum();
    let divided: usize =
        rows.iter().zip(&dividers).filter(|(_, dividers)| dividers.is_some()).map(|(row, _)| length(row)).sum();
    let places: usize = dividers.iter().flatten().map(|dividers| dividers.borders.len() - 1).sum();
    if places < LEAST_PLACES_OF_ALL || (divided as f64) < LEAST_SHARE_OF_ALL * whole as f64 {
        return (Vec::new(), rows, evidence);
    }
    let mut found = (Vec::new(), Vec::new(), Vec::new());
    for ((row, evidence), dividers) in rows.into_iter().zip(evidence).zip(dividers) {
        match dividers {
            Some(dividers) => found.0.push((row, dividers)),
            None => {
                found.1.push(row);
                found.2.push(evidence);
            }
        }
    }
    found
}

/// Marks the columns of a layer that are not clear beside its front and its back; `None` for solid goods.
fn mark_lumps(layer: &Patch, is_clear: &mut [bool]) -> Option<()> {
    let is_filled = |line: &usize| {
        layer.row(*line).iter().filter(|cell| !cell.is_free()).count() as f64 >= RIM_SHARE * layer.width as f64
    };
    let filled: Vec<usize> = (0..layer.height).filter(is_filled).collect();
    (filled.len() as f64 <= SOLID_SHARE * layer.height as f64).then_some(())?;
    for line in (0..layer.height).filter(|line| !filled.contains(line)) {
        is_clear.iter_mut().zip(layer.row(line)).for_each(|(is_clear, cell)| *is_clear &= cell.is_free());
    }
    Some(())
}

/// Runs of columns that are not clear, as first and end.
fn lumps(is_clear: &[bool]) -> Vec<[usize; 2]> {
    runs_where(is_clear.len(), |column| !is_clear[column]).map(|run| [run.start, run.end]).collect()
}

/// Twice the middles of dividers, cells; `None` where lumps are too wide or too few.
fn dividers(lumps: &[[usize; 2]], length: usize) -> Option<Vec<usize>> {
    let mut gaps: Vec<usize> = lumps.windows(2).map(|pair| pair[1][0] - pair[0][1]).collect();
    gaps.sort_unstable();
    let whole: usize = gaps.iter().sum();
    let mut passed = 0;
    // The gap at the middle of the length of all gaps.
    let usual = *gaps.iter().find(|&&gap| {
        passed += gap;
        2 * passed >= whole
    })? as f64;
    let mut joined: Vec<[usize; 2]> = Vec::with_capacity(lumps.len());
    for &lump in lumps {
        match joined.last_mut() {
            Some(last) if ((lump[0] - last[1]) as f64) < JOINED_SHARE * usual => last[1] = lump[1],
            _ => joined.push(lump),
        }
    }
    let (thin, wide): (Vec<[usize; 2]>, Vec<[usize; 2]>) =
        joined.into_iter().partition(|[start, end]| (end - start) as f64 <= WIDEST_SHARE * usual);
    let taken: usize = wide.iter().map(|[start, end]| end - start).sum();
    (taken as f64 <= WIDE_SHARE * length as f64).then(|| thin.into_iter().map(|[start, end]| start + end).collect())
}

/// The pitch that most distances have, metres.
fn pitch(middles: &[usize], cell: f64) -> Option<f64> {
    let distances: Vec<f64> = middles.windows(2).map(|pair| (pair[1] - pair[0]) as f64 * cell / 2.0).collect();
    let within = distances.iter().filter(|&&distance| (PITCHES_M[0]..=PITCHES_M[1]).contains(&distance));
    let like = |pitch: f64| {
        let near: Vec<f64> =
            distances.iter().copied().filter(|distance| (distance - pitch).abs() <= tolerance(pitch)).collect();
        (near.len(), near.iter().sum::<f64>() / near.len().max(1) as f64)
    };
    let (count, pitch) = within.map(|&pitch| like(pitch)).max_by(|one, other| {
        let order = one.0.cmp(&other.0);
        order.then(other.1.total_cmp(&one.1))
    })?;
    (count >= LEAST_PLACES).then_some(pitch)
}

fn tolerance(pitch: f64) -> f64 {
    TOLERANCE_SHARE * pitch + TOLERANCE_M
}

/// The borders at a pitch, metres: the middles of the dividers, and between them those of empty places; `None` where too few
/// distances are regular.
fn borders(middles: &[usize], pitch: f64, cell: f64) -> Option<Vec<usize>> {
    let (first, last) = (*middles.first()?, *middles.last()?);
    let mut borders = vec![first / 2];
    let (mut regular, mut from) = (0, first);
    // A divider off the lattice is a column or a thing in a place: the next one that fits goes on.
    for &middle in &middles[1..] {
        let distance = (middle - from) as f64 * cell / 2.0;
        let count = (distance / pitch).round();
        if count < 1.0 {
            continue;
        }
        if (distance - count * pitch).abs() <= tolerance(pitch) {
            let count = count as usize;
            borders.extend((1..=count).map(|step| (from + (middle - from) * step / count) / 2));
            regular += middle - from;
            from = middle;
        } else if count > 1.0 || distance > pitch {
            borders.push(middle / 2);
            from = middle;
        }
    }
    (regular as f64 >= REGULAR_SHARE * (last - first) as f64).then_some(borders)
}
