//! Blocks: rows side by side with their borders in line.
//!
//! A rack of two bays shows three frames, and three equal marks are no evidence. Several such racks one behind the other,
//! with their frames in line, are. A frame that stands at a wall does not show, and a frame may be seen in part, so rows are
//! as long and as deep as most of their block.

use super::marked_row::{MarkCounts, MarkedRow};
use super::range::{length, median, middle};
use crate::geometry::DisjointSets;

/// Rows of a block differ in pitch by at most this share, and in where their borders lie by this, metres.
const PITCH_SHARE: f64 = 0.04;
const SAME_BORDER_M: f64 = 0.2;
/// Least number of rows of a block, and of the things that they explain.
const LEAST_ROWS: usize = 3;
const LEAST_THINGS: usize = 12;
/// Least number of things that a block explains beyond one for each run and two for the block.
const LEAST_SURPLUS: usize = 4;
/// Least share of the places of a block that are empty inside of its rows, where some at the ends are taken for empty.
const LEAST_EMPTY_SHARE: f64 = 0.05;
/// Share of the rows that reach an end of their block: a quarter does where half of the places are empty.
const REACHED_SHARE: f64 = 0.25;
/// Most empty places at an end: where half are empty, one row in thirty has more.
const MOST_EMPTY: usize = 4;

/// The rows of those blocks that are no chance.
pub(super) fn rows(rows: &[MarkedRow]) -> Vec<MarkedRow> {
    let is_certain = |block: &Vec<usize>| {
        let counts = MarkCounts::of_rows(block.iter().map(|&row| &rows[row]));
        block.len() >= LEAST_ROWS
            && counts.explained >= LEAST_THINGS
            && counts.explained >= counts.runs + 2 + LEAST_SURPLUS
    };
    let certain = blocks(rows).into_iter().filter(is_certain);
    certain.flat_map(|block| with_common_size(&block.iter().map(|&row| &rows[row]).collect::<Vec<_>>())).collect()
}

/// Adds the empty places at the ends of rows whose places are seen by what stands in them, where other rows of their block
/// have places; not where no place inside of these rows is empty.
pub(super) fn add_empty_ends(rows: &mut [MarkedRow]) {
    for block in blocks(rows) {
        let counts = MarkCounts::of_rows(block.iter().map(|&row| &rows[row]));
        let seen = (counts.explained + counts.irregular) as f64;
        if rows[block[0]].has_frames || seen > (1.0 - LEAST_EMPTY_SHARE) * counts.full as f64 {
            continue;
        }
        // Ends from the outermost one inwards.
        let reached = |side: usize, sign: f64| {
            let mut ends: Vec<f64> = block.iter().map(|&row| sign * rows[row].along()[side]).collect();
            ends.sort_by(|one, other| other.total_cmp(one));
            sign * ends[((REACHED_SHARE * ends.len() as f64) as usize).min(ends.len() - 1)]
        };
        let (low, high) = (reached(0, -1.0), reached(1, 1.0));
        for &row in &block {
            let most = MOST_EMPTY as f64 * rows[row].pitch();
            let [first, last] = rows[row].along();
            rows[row] = rows[row].up_to([low.max(first - most), high.min(last + most)]);
        }
    }
}

/// Numbers of the rows of each block.
fn blocks(rows: &[MarkedRow]) -> Vec<Vec<usize>> {
    let mut sets = DisjointSets::new(rows.len());
    for one in 0..rows.len() {
        for other in one + 1..rows.len() {
            if is_in_line(&rows[one], &rows[other]) {
                sets.join(one, other);
            }
        }
    }
    let mut blocks: Vec<Vec<usize>> = vec![Vec::new(); rows.len()];
    for number in 0..rows.len() {
        blocks[sets.find(number)].push(number);
    }
    blocks.retain(|block| !block.is_empty());
    blocks
}

/// Whether two rows lie side by side with their borders in line.
fn is_in_line(one: &MarkedRow, other: &MarkedRow) -> bool {
    let (pitch, other_pitch) = (one.pitch(), other.pitch());
    let shift = (one.borders[0] - other.borders[0] + pitch / 2.0).rem_euclid(pitch) - pitch / 2.0;
    let [low, high] = [one.along()[0].max(other.along()[0]), one.along()[1].min(other.along()[1])];
    (pitch - other_pitch).abs() <= PITCH_SHARE * pitch && shift.abs() <= SAME_BORDER_M && high - low >= 0.5 * pitch
}

/// The rows of a block, those shorter or less deep than most made as large.
fn with_common_size(block: &[&MarkedRow]) -> Vec<MarkedRow> {
    let usual = |of: &dyn Fn(&MarkedRow) -> f64| median(block.iter().map(|row| of(row))).unwrap_or(0.0);
    let ends = [usual(&|row| row.along()[0]), usual(&|row| row.along()[1])];
    let depth = usual(&|row| length(row.across));
    let sized = |row: &&MarkedRow| {
        let half = length(row.across).max(depth) / 2.0;
        let across = [middle(row.across) - half, middle(row.across) + half];
        MarkedRow { across, ..row.up_to(ends) }
    };
    block.iter().map(sized).collect()
}
