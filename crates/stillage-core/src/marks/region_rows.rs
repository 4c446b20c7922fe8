//! The rows of equal marks of one region.
//!
//! Rows are looked for along both directions of the region, among its things, among its things with dotted lines as one
//! frame, and among the holes in its things. Of these readings the one is taken that explains most things by fewest runs.

use super::block;
use super::mark::{self, GridParts, Mark, Marks};
use super::mark_line::MarkLine;
use super::mark_run;
use super::marked_row::{self, MarkCounts, MarkedRow, RowFrame};
use super::pitch;
use super::range::middle;
use crate::grid::OccupancyGrid;
use crate::segmentation::RegionMap;
use crate::watch::{Stopped, Watch};

/// What a run of marks costs, in things: where it begins, and where it lies across.
const RUN_COST: f64 = 2.0;
/// Marks so near to rows should stand in them, metres.
const AROUND_M: f64 = 0.5;
/// Pitches of a region at most: no region holds more sorts of storage.
const MOST_PITCHES: usize = 6;
/// Least number of places of all rows.
const LEAST_PLACES: usize = 8;
/// Least share of the marks around rows that stand in them: what a person drew is rows and little else.
const EXPLAINED: f64 = 0.65;

/// The rows of a region, the share of the marks around them that they explain, and its blocks.
#[derive(Debug, Default)]
pub(super) struct RegionRows {
    pub rows: Vec<MarkedRow>,
    pub explained: f64,
    pub blocks: Vec<MarkedRow>,
}

impl RegionRows {
    /// The rows of a region with a first direction, radians.
    pub fn find(
        grid: &OccupancyGrid,
        parts: &GridParts,
        regions: &RegionMap,
        (region, angle): (u8, f64),
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let Marks { things, holes } = Marks::find(grid, parts, regions, (region, angle), watch)?;
        let mut found = Self::default();
        let (mut most, mut most_of_blocks) = (0.0, 0);
        for axis in [0, 1] {
            let framed = mark::with_dotted_frames(&things, axis, watch)?;
            let readings = [&things, &framed, &holes];
            let differs = |&at: &usize| at == 0 || readings[at].len() != readings[at - 1].len();
            for marks in (0..readings.len()).filter(differs).map(|at| readings[at]) {
                watch.check()?;
                let frame = RowFrame { region, angle, axis };
                let rows = rows_of_lines(MarkLine::all(marks, axis), frame, grid.resolution(), watch)?;
                let blocks = block::rows(&rows);
                let of_blocks = MarkCounts::of_rows(&blocks).explained;
                if of_blocks > most_of_blocks {
                    (most_of_blocks, found.blocks) = (of_blocks, blocks);
                }
                let rows: Vec<MarkedRow> = rows.into_iter().filter(MarkedRow::is_long).collect();
                let counts = MarkCounts::of_rows(&rows);
                let score = counts.explained as f64 - RUN_COST * counts.runs as f64;
                if score > most {
                    let around = things_around(&rows, marks) - counts.irregular;
                    found.explained = counts.explained as f64 / around as f64;
                    (most, found.rows) = (score, rows);
                }
            }
        }
        block::add_empty_ends(&mut found.rows);
        if found.explained < EXPLAINED || found.rows.iter().map(MarkedRow::count).sum::<usize>() < LEAST_PLACES {
            found.rows.clear();
        }
        Ok(found)
    }
}

/// Number of things in those marks that lie within the box around some rows.
fn things_around(rows: &[MarkedRow], marks: &[Mark]) -> usize {
    let mut whole = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    for row in rows {
        for (side, [low, high]) in [(row.frame.axis, row.along()), (1 - row.frame.axis, row.across)] {
            whole[side] = [whole[side][0].min(low - AROUND_M), whole[side][1].max(high + AROUND_M)];
        }
    }
    let is_within =
        |mark: &&Mark| mark.sides.iter().zip(whole).all(|(&side, [low, high])| (low..=high).contains(&middle(side)));
    marks.iter().filter(is_within).map(|mark| mark.things).sum()
}

/// The rows of some lines, pitch by pitch; `cell` is the side of a cell, metres.
fn rows_of_lines(
    mut lines: Vec<MarkLine>,
    frame: RowFrame,
    cell: f64,
    watch: &Watch<'_>,
) -> Result<Vec<MarkedRow>, Stopped> {
    let mut found = Vec::new();
    for _ in 0..MOST_PITCHES {
        let Some(pitch) = pitch::common(&lines, cell, watch)? else { break };
        let (runs, others) = mark_run::of_lines(lines, pitch);
        lines = others;
        if runs.is_empty() {
            break;
        }
        found.extend(marked_row::of_runs(runs, frame, pitch));
    }
    Ok(found)
}
