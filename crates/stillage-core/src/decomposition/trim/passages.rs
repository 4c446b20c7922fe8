//! Passages through rows that lie beside one another.
//!
//! Empty places and open floor look alike; only together rows tell them apart. A stretch on which vehicles find room is
//! a passage where it goes on, at the same place, through three rows and across an aisle, or where the comb found a gap
//! in one row and such a stretch in the next. Its sides are those that most of its rows have.
//!
//! Cost: O(cells of the rows + stretches^2). Limits: places that are empty opposite one another in three rows are lost.

use std::ops::Range;

use super::row_ends::PieceRow;
use crate::decomposition::ground::{Cell, RegionFrame};
use crate::decomposition::plot::PlotKind;

/// Narrowest passage, metres: two empty places are none.
const PASSAGE_M: f64 = 2.6;
/// Rows with at most one aisle between them, metres.
const NEXT_ROW_M: f64 = 5.0;
/// Two rows back to back are less deep than this, metres: what goes on beyond them crosses an aisle.
const PAIR_M: f64 = 3.6;
/// Least rows of a passage that no comb found.
const LEAST_ROWS: usize = 3;
/// Share of a piece that a passage covers, and on which vehicles find room; share that two stretches have in common.
const SHARE: f64 = 0.75;

/// A stretch of a row on which vehicles find room.
struct OpenRun {
    row: usize,
    along: Range<usize>,
    has_gap: bool,
}

/// The rows that a passage goes through, and from where to where.
pub(super) type RowPassage = (Vec<usize>, Range<usize>);

/// Finds the passages through some rows.
pub(super) fn find(frame: &RegionFrame, rows: &[PieceRow]) -> Vec<RowPassage> {
    let least = frame.cells_of(PASSAGE_M);
    let stretches: Vec<OpenRun> = (0..rows.len()).flat_map(|row| stretches(frame, rows, row, least)).collect();
    (0..stretches.len()).filter_map(|seed| passage(frame, rows, &stretches, seed)).collect()
}

/// Makes gaps of the pieces that passages go through.
pub(super) fn open(frame: &RegionFrame, rows: &mut [PieceRow], passages: Vec<RowPassage>) {
    for (members, passage) in passages {
        for row in members {
            let row = &mut rows[row];
            for piece in &mut row.pieces {
                let along = piece.rect.range(row.axis);
                if common(along, &passage) as f64 >= SHARE * along.len() as f64
                    && frame.share(&piece.rect, Cell::is_drivable) >= SHARE
                {
                    piece.kind = PlotKind::Passage;
                }
            }
        }
    }
}

fn common(one: &Range<usize>, other: &Range<usize>) -> usize {
    one.end.min(other.end).saturating_sub(one.start.max(other.start))
}

fn stretches(frame: &RegionFrame, rows: &[PieceRow], number: usize, least: usize) -> Vec<OpenRun> {
    let row = &rows[number];
    if row.pieces.iter().all(|piece| piece.kind != PlotKind::Place) {
        return Vec::new();
    }
    let is_open: Vec<bool> =
        row.pieces.iter().map(|piece| frame.share(&piece.rect, Cell::is_drivable) >= SHARE).collect();
    let mut first = 0;
    let mut found = Vec::new();
    for run in is_open.chunk_by(PartialEq::eq) {
        let pieces = &row.pieces[first..first + run.len()];
        first += run.len();
        let along = row.along(&pieces[0]).start..row.along(&pieces[pieces.len() - 1]).end;
        if run[0] && along.len() >= least {
            let has_gap = pieces.iter().any(|piece| piece.kind == PlotKind::Passage && row.along(piece).len() >= least);
            found.push(OpenRun { row: number, along, has_gap });
        }
    }
    found
}

/// The passage through a stretch.
fn passage(frame: &RegionFrame, rows: &[PieceRow], stretches: &[OpenRun], seed: usize) -> Option<RowPassage> {
    let next = frame.cells_of(NEXT_ROW_M);
    let width = &stretches[seed].along;
    let goes_on = |other: &OpenRun| common(width, &other.along) as f64 >= SHARE * width.len() as f64;
    let mut is_member: Vec<bool> = vec![false; stretches.len()];
    is_member[seed] = true;
    let mut waiting = vec![seed];
    let mut members = Vec::new();
    while let Some(from) = waiting.pop() {
        members.push(&stretches[from]);
        let across = &rows[stretches[from].row].across;
        for (number, other) in stretches.iter().enumerate() {
            let beside = &rows[other.row].across;
            let distance = beside.start.saturating_sub(across.end).max(across.start.saturating_sub(beside.end));
            if !is_member[number] && distance <= next && goes_on(other) {
                is_member[number] = true;
                waiting.push(number);
            }
        }
    }
    let across = members.iter().map(|member| &rows[member.row].across);
    let low = across.clone().map(|across| across.start).min().unwrap_or(0);
    let depth = across.map(|across| across.end).max().unwrap_or(low) - low;
    let crosses_aisle = members.len() >= LEAST_ROWS && depth > frame.cells_of(PAIR_M);
    let is_passage = crosses_aisle || (members.len() > 1 && members.iter().any(|member| member.has_gap));
    is_passage.then(|| {
        let (start, end) = (members.iter().map(|of| of.along.start), members.iter().map(|of| of.along.end));
        (members.iter().map(|member| member.row).collect(), middle(start.collect(), true)..middle(end.collect(), false))
    })
}

/// The middle one of some numbers, of two the greater or the lesser one.
fn middle(mut numbers: Vec<usize>, is_greater: bool) -> usize {
    numbers.sort_unstable();
    let at = if is_greater { numbers.len() / 2 } else { numbers.len().saturating_sub(1) / 2 };
    numbers.get(at).copied().unwrap_or(0)
}
