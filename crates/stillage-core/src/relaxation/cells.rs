//! Relaxation on the measured cells of a grid.
//!
//! Distributions are kept in 16 bits per share, for measured cells alone, and changed in place: a task works through a
//! band of rows with three of them unpacked (the one before, itself, the one after), as they were before the iteration;
//! the rows on either side of a band are put aside first. Every task reads and writes the same numbers whatever the
//! number of threads. Cost: O(cells x (8 k + k^2)) per iteration, 2 k bytes per cell.

use std::ops::Range;

use rayon::prelude::*;

use super::{Compatibilities, REST, RelaxationReport, entropy, greatest, soften};
use crate::spec::RelaxationOptions;
use crate::watch::{Stopped, Watch};

/// Rows that one task relaxes.
const BAND: usize = 64;
/// The whole of a distribution.
const WHOLE: f32 = u16::MAX as f32;

/// Distributions over the categories, of one measured cell after the other.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Memberships {
    count: usize,
    /// `count` shares for each cell, in parts of 65,535.
    values: Vec<u16>,
}

impl Memberships {
    /// Room for the distributions of `cells` cells over `count` categories.
    #[must_use]
    pub fn new(cells: usize, count: usize) -> Self {
        Self { count, values: vec![0; cells * count] }
    }

    /// Number of categories.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Packs shares, in the order of cells and categories, into the places of `values` (see [`Self::values_mut`]).
    pub fn pack(shares: &[f32], values: &mut [u16]) {
        for (value, share) in values.iter_mut().zip(shares) {
            *value = (share * WHOLE).round() as u16;
        }
    }

    /// The packed shares.
    #[must_use]
    pub fn values(&self) -> &[u16] {
        &self.values
    }

    /// The packed shares, to be filled in blocks of whole cells.
    pub fn values_mut(&mut self) -> &mut [u16] {
        &mut self.values
    }

    /// The shares of one cell, sum 1.
    pub fn of(&self, cell: usize) -> impl Iterator<Item = f32> + Clone {
        unpacked(&self.values[cell * self.count..(cell + 1) * self.count])
    }

    /// The category of each cell: the greatest share, the first of equals.
    #[must_use]
    pub fn categories(&self) -> Vec<u8> {
        self.values.par_chunks_exact(self.count.max(1)).map(|shares| greatest(shares.iter().copied()) as u8).collect()
    }
}

/// Shares of sum 1: rounding has moved the packed ones a little off it.
fn unpacked(values: &[u16]) -> impl Iterator<Item = f32> + Clone {
    let sum: u32 = values.iter().map(|&value| u32::from(value)).sum();
    let whole = sum.max(1) as f32;
    values.iter().map(move |&value| f32::from(value) / whole)
}

/// Where the measured cells lie: the columns of each lattice row.
#[derive(Debug)]
pub struct Lattice {
    columns: usize,
    /// Column of each measured cell.
    of_cells: Vec<u32>,
    /// The measured cells of each row.
    rows: Vec<Range<usize>>,
}

impl Lattice {
    /// The lattice of measured cells (row-major numbers, ascending) of a grid that is `width` cells wide: every
    /// `stride`-th column and row, or every one where a cell lies off those.
    #[must_use]
    pub fn new(cells: &[u32], width: usize, stride: usize) -> Self {
        let width = width.max(1);
        let place = |cell: u32| (cell as usize % width, cell as usize / width);
        let is_on = |&cell: &u32| {
            let (column, row) = place(cell);
            column.is_multiple_of(stride) && row.is_multiple_of(stride)
        };
        let stride = if cells.par_iter().all(is_on) { stride } else { 1 };
        let row_of = |cell: u32| place(cell).1 / stride;
        let height = cells.last().map_or(0, |&last| row_of(last) + 1);
        let mut rows = Vec::with_capacity(height);
        let mut start = 0;
        for row in 0..height {
            let end = start + cells[start..].partition_point(|&cell| row_of(cell) <= row);
            rows.push(start..end);
            start = end;
        }
        let of_cells = cells.iter().map(|&cell| (place(cell).0 / stride) as u32).collect();
        Self { columns: width.div_ceil(stride), of_cells, rows }
    }

    /// Splits what belongs to the cells, `count` each, into bands of rows.
    fn bands<'a>(&self, mut values: &'a mut [u16], count: usize) -> Vec<(Range<usize>, &'a mut [u16])> {
        let mut bands = Vec::new();
        for first in (0..self.rows.len()).step_by(BAND) {
            let rows = first..(first + BAND).min(self.rows.len());
            let cells = self.rows[rows.end - 1].end - self.rows[first].start;
            let (band, rest) = values.split_at_mut(cells * count);
            values = rest;
            bands.push((rows, band));
        }
        bands
    }
}

/// Relaxes the distributions of the measured cells.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn relax_cells(
    lattice: &Lattice,
    memberships: &mut Memberships,
    options: RelaxationOptions,
    watch: &Watch<'_>,
) -> Result<RelaxationReport, Stopped> {
    let before = memberships.categories();
    let compatibilities = co_occurrence(lattice, &before, memberships.count, watch)?;
    let mut report = RelaxationReport {
        nodes: before.len(),
        entropy_before: mean_entropy(memberships, watch)?,
        ..RelaxationReport::default()
    };
    soften_all(memberships, watch)?;
    for _ in 0..options.iterations {
        let moves = iterate(lattice, memberships, &compatibilities, watch)?;
        report.changed_by_iteration.push(moves.changed);
        if f32::from(moves.farthest) < REST * WHOLE {
            break;
        }
    }
    let changed = before.iter().zip(memberships.categories()).filter(|(before, after)| **before != *after);
    report.changed = changed.count();
    report.entropy_after = mean_entropy(memberships, watch)?;
    Ok(report)
}

/// Cells that a task handles at once where their order does not matter.
const CELLS_PER_BLOCK: usize = 1 << 14;

fn mean_entropy(memberships: &Memberships, watch: &Watch<'_>) -> Result<f64, Stopped> {
    let count = memberships.count.max(1);
    let blocks: Result<Vec<f64>, Stopped> = memberships
        .values
        .par_chunks(CELLS_PER_BLOCK * count)
        .map(|block| {
            watch.check()?;
            Ok(block.chunks_exact(count).map(|values| entropy(unpacked(values))).sum())
        })
        .collect();
    let cells = (memberships.values.len() / count).max(1);
    Ok(blocks?.iter().sum::<f64>() / cells as f64)
}

fn soften_all(memberships: &mut Memberships, watch: &Watch<'_>) -> Result<(), Stopped> {
    let count = memberships.count.max(1);
    memberships.values.par_chunks_mut(CELLS_PER_BLOCK * count).try_for_each(|block| {
        watch.check()?;
        let mut shares = vec![0.0; count];
        for values in block.chunks_exact_mut(count) {
            shares.iter_mut().zip(unpacked(values)).for_each(|(share, packed)| *share = packed);
            soften(&mut shares);
            Memberships::pack(&shares, values);
        }
        Ok(())
    })
}

/// Counts which categories are neighbours.
fn co_occurrence(
    lattice: &Lattice,
    categories: &[u8],
    count: usize,
    watch: &Watch<'_>,
) -> Result<Compatibilities, Stopped> {
    let in_row = |row: usize| -> Result<Vec<u64>, Stopped> {
        watch.check()?;
        let mut pairs = vec![0_u64; count * count];
        // The cells before it in its row, and the three above: each pair of neighbours once.
        let line = |row: usize| {
            let mut line = vec![u8::MAX; lattice.columns + 2];
            for cell in lattice.rows[row].clone() {
                line[lattice.of_cells[cell] as usize + 1] = categories[cell];
            }
            line
        };
        let own = line(row);
        let above = if row > 0 { line(row - 1) } else { vec![u8::MAX; lattice.columns + 2] };
        for cell in lattice.rows[row].clone() {
            let column = lattice.of_cells[cell] as usize + 1;
            let neighbors = [own[column - 1], above[column - 1], above[column], above[column + 1]];
            for neighbor in neighbors.into_iter().filter(|&neighbor| neighbor != u8::MAX) {
                pairs[usize::from(own[column]) * count + usize::from(neighbor)] += 1;
                pairs[usize::from(neighbor) * count + usize::from(own[column])] += 1;
            }
        }
        Ok(pairs)
    };
    let add = |mut sums: Vec<u64>, more: Vec<u64>| {
        sums.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
        Ok(sums)
    };
    // Whole numbers: their sum does not hang on the order.
    let pairs = (0..lattice.rows.len()).into_par_iter().map(in_row).try_reduce(|| vec![0; count * count], add)?;
    let pairs: Vec<f64> = pairs.into_iter().map(|pairs| pairs as f64).collect();
    Ok(Compatibilities::from_pairs(&pairs, count))
}

/// What one iteration moved.
#[derive(Default, Clone, Copy)]
struct Moves {
    changed: usize,
    /// Largest change of a packed share.
    farthest: u16,
}

/// One iteration over all cells.
fn iterate(
    lattice: &Lattice,
    memberships: &mut Memberships,
    compatibilities: &Compatibilities,
    watch: &Watch<'_>,
) -> Result<Moves, Stopped> {
    let count = memberships.count;
    // The rows before and after each band, as they are now.
    let aside = |row: Option<usize>| {
        let cells = row.and_then(|row| lattice.rows.get(row)).cloned().unwrap_or_default();
        memberships.values[cells.start * count..cells.end * count].to_vec()
    };
    let starts = (0..lattice.rows.len()).step_by(BAND);
    let borders: Vec<[Vec<u16>; 2]> =
        starts.map(|first| [aside(first.checked_sub(1)), aside(Some(first + BAND))]).collect();
    let bands = lattice.bands(&mut memberships.values, count);
    bands
        .into_par_iter()
        .zip(borders)
        .map(|((rows, values), borders)| relax_band(lattice, rows, values, &borders, compatibilities, watch))
        .try_reduce(Moves::default, |one, other| {
            Ok(Moves { changed: one.changed + other.changed, farthest: one.farthest.max(other.farthest) })
        })
}

/// One iteration over the rows of a band.
fn relax_band(
    lattice: &Lattice,
    rows: Range<usize>,
    values: &mut [u16],
    [before, after]: &[Vec<u16>; 2],
    compatibilities: &Compatibilities,
    watch: &Watch<'_>,
) -> Result<Moves, Stopped> {
    let count = compatibilities.count;
    let offset = lattice.rows[rows.start].start;
    let columns_of = |row: usize| &lattice.of_cells[lattice.rows[row].clone()];
    let place = |row: usize| {
        let cells = &lattice.rows[row];
        (cells.start - offset) * count..(cells.end - offset) * count
    };
    let mut lines = [(); 3].map(|()| Line::new(count, lattice.columns));
    let mut around = Line::new(count, lattice.columns);
    let mut raised = Raised::new(count, lattice.columns);
    if rows.start > 0 {
        lines[0].unpack(columns_of(rows.start - 1), before);
    }
    lines[1].unpack(columns_of(rows.start), &values[place(rows.start)]);
    let mut moves = Moves::default();
    for row in rows.clone() {
        watch.check()?;
        match row + 1 {
            next if next < rows.end => lines[2].unpack(columns_of(next), &values[place(next)]),
            next if next < lattice.rows.len() => lines[2].unpack(columns_of(next), after),
            _ => lines[2].clear(),
        }
        around.sum_neighbors(&lines);
        lines[1].raise(&around, compatibilities, &mut raised);
        raised.pack(columns_of(row), &mut values[place(row)], &mut moves);
        lines.rotate_left(1);
    }
    Ok(moves)
}

/// A row of the lattice, category by category, with a column without shares at either end.
struct Line {
    width: usize,
    /// 1 where there is a measured cell; of a sum, their number.
    cells: Vec<f32>,
    /// Shares, all of one category first.
    shares: Vec<f32>,
}

impl Line {
    fn new(count: usize, columns: usize) -> Self {
        let width = columns + 2;
        Self { width, cells: vec![0.0; width], shares: vec![0.0; width * count] }
    }

    fn clear(&mut self) {
        self.cells.fill(0.0);
        self.shares.fill(0.0);
    }

    fn unpack(&mut self, columns: &[u32], values: &[u16]) {
        self.clear();
        let count = self.shares.len() / self.width;
        for (&column, values) in columns.iter().zip(values.chunks_exact(count.max(1))) {
            let at = column as usize + 1;
            self.cells[at] = 1.0;
            for (category, share) in unpacked(values).enumerate() {
                self.shares[category * self.width + at] = share;
            }
        }
    }

    /// Sums over the eight neighbours of each column.
    fn sum_neighbors(&mut self, [before, own, after]: &[Self; 3]) {
        sum_around(&mut self.cells, [&before.cells, &own.cells, &after.cells]);
        let planes = self.shares.chunks_exact_mut(self.width);
        let lines = [before, own, after].map(|line| line.shares.chunks_exact(self.width));
        let [before, own, after] = lines;
        for (((sums, before), own), after) in planes.zip(before).zip(own).zip(after) {
            sum_around(sums, [before, own, after]);
        }
    }

    /// Raises the shares of this row, as they were before the iteration, by their support.
    fn raise(&self, around: &Self, compatibilities: &Compatibilities, raised: &mut Raised) {
        raised.sums.fill(0.0);
        let planes = self.shares.chunks_exact(self.width).zip(raised.shares.chunks_exact_mut(self.width));
        for (own, (shares, raised_shares)) in planes.enumerate() {
            raised.support.fill(0.0);
            for (r, around) in compatibilities.row(own).iter().zip(around.shares.chunks_exact(self.width)) {
                for (support, around) in raised.support.iter_mut().zip(around) {
                    *support += r * around;
                }
            }
            let supported = shares.iter().zip(&raised.support).zip(&around.cells);
            for ((((share, support), cells), raised), sum) in supported.zip(raised_shares).zip(&mut raised.sums) {
                *raised = share * (1.0 + support / cells.max(1.0)).max(0.0);
                *sum += *raised;
            }
        }
    }
}

/// A row after one iteration, not yet of sum 1.
struct Raised {
    width: usize,
    shares: Vec<f32>,
    sums: Vec<f32>,
    support: Vec<f32>,
}

impl Raised {
    fn new(count: usize, columns: usize) -> Self {
        let width = columns + 2;
        Self { width, shares: vec![0.0; width * count], sums: vec![0.0; width], support: vec![0.0; width] }
    }

    /// Packs the shares of the measured cells.
    fn pack(&self, columns: &[u32], values: &mut [u16], moves: &mut Moves) {
        let count = self.shares.len() / self.width;
        for (&column, values) in columns.iter().zip(values.chunks_exact_mut(count.max(1))) {
            let at = column as usize + 1;
            if self.sums[at] <= 0.0 {
                continue;
            }
            let before = greatest(values.iter().copied());
            for (value, plane) in values.iter_mut().zip(self.shares.chunks_exact(self.width)) {
                let packed = (plane[at] / self.sums[at] * WHOLE).round() as u16;
                moves.farthest = moves.farthest.max(packed.abs_diff(*value));
                *value = packed;
            }
            moves.changed += usize::from(greatest(values.iter().copied()) != before);
        }
    }
}

/// Sums of the eight neighbours in three rows; the first and the last column have none.
fn sum_around(sums: &mut [f32], [before, own, after]: [&[f32]; 3]) {
    let inner = sums.len().saturating_sub(2);
    let triples = before.windows(3).zip(own.windows(3)).zip(after.windows(3));
    for (sum, ((before, own), after)) in sums[1..=inner].iter_mut().zip(triples) {
        *sum = (before[0] + before[1] + before[2]) + (own[0] + own[2]) + (after[0] + after[1] + after[2]);
    }
}
