//! Relaxation of the measured cells of a grid, in place.
//!
//! Each task works through a block of rows with three rows unpacked (before, own, after), all as they were before the
//! iteration; the rows on either side of a block are copied first. So the result does not depend on the number of
//! threads. Cost: O(cells x (8 k + k^2)) per iteration for k categories, 2 k bytes per cell.

use std::ops::Range;

use rayon::prelude::*;

use super::compatibilities::Compatibilities;
use super::distribution::{SETTLED, entropy, greatest, soften};
use super::lattice::{Lattice, ROWS_PER_BLOCK};
use super::memberships::{Memberships, WHOLE, unpacked};
use super::report::RelaxationReport;
use crate::spec::RelaxationOptions;
use crate::watch::{Stopped, Watch};

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
    let compatibilities = co_occurrence(lattice, &before, memberships.count(), watch)?;
    let mut report = RelaxationReport {
        nodes: before.len(),
        entropy_before: mean_entropy(memberships, watch)?,
        ..RelaxationReport::default()
    };
    soften_all(memberships, watch)?;
    for _ in 0..options.iterations {
        let changes = iterate(lattice, memberships, &compatibilities, watch)?;
        report.changed_by_iteration.push(changes.categories);
        if f32::from(changes.largest) < SETTLED * WHOLE {
            break;
        }
    }
    let changed = before.iter().zip(memberships.categories()).filter(|(before, after)| **before != *after);
    report.changed = changed.count();
    report.entropy_after = mean_entropy(memberships, watch)?;
    Ok(report)
}

/// Cells that a task handles at once where rows do not matter.
const CELLS_PER_BLOCK: usize = 1 << 14;

fn mean_entropy(memberships: &Memberships, watch: &Watch<'_>) -> Result<f64, Stopped> {
    let count = memberships.count().max(1);
    let blocks: Result<Vec<f64>, Stopped> = memberships
        .values()
        .par_chunks(CELLS_PER_BLOCK * count)
        .map(|block| {
            watch.check()?;
            Ok(block.chunks_exact(count).map(|values| entropy(unpacked(values))).sum())
        })
        .collect();
    let cells = (memberships.values().len() / count).max(1);
    Ok(blocks?.iter().sum::<f64>() / cells as f64)
}

fn soften_all(memberships: &mut Memberships, watch: &Watch<'_>) -> Result<(), Stopped> {
    let count = memberships.count().max(1);
    memberships.values_mut().par_chunks_mut(CELLS_PER_BLOCK * count).try_for_each(|block| {
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
        // The cell before it in its row and the three of the row below: each pair of neighbours once.
        let categories_of_row = |row: usize| {
            let mut line = vec![u8::MAX; lattice.columns + 2];
            for cell in lattice.rows[row].clone() {
                line[lattice.of_cells[cell] as usize + 1] = categories[cell];
            }
            line
        };
        let own = categories_of_row(row);
        let below = if row > 0 { categories_of_row(row - 1) } else { vec![u8::MAX; lattice.columns + 2] };
        for cell in lattice.rows[row].clone() {
            let column = lattice.of_cells[cell] as usize + 1;
            let neighbors = [own[column - 1], below[column - 1], below[column], below[column + 1]];
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
    // Sums of whole numbers do not depend on the order.
    let pairs = (0..lattice.rows.len()).into_par_iter().map(in_row).try_reduce(|| vec![0; count * count], add)?;
    let pairs: Vec<f64> = pairs.into_iter().map(|pairs| pairs as f64).collect();
    Ok(Compatibilities::from_pairs(&pairs, count))
}

/// What one iteration changed.
#[derive(Default, Clone, Copy)]
struct Changes {
    /// Cells whose category changed.
    categories: usize,
    /// Largest change of a packed share.
    largest: u16,
}

/// One iteration over all cells.
fn iterate(
    lattice: &Lattice,
    memberships: &mut Memberships,
    compatibilities: &Compatibilities,
    watch: &Watch<'_>,
) -> Result<Changes, Stopped> {
    let count = memberships.count();
    // The rows before and after each block, as they are before this iteration.
    let aside = |row: Option<usize>| {
        let cells = row.and_then(|row| lattice.rows.get(row)).cloned().unwrap_or_default();
        memberships.values()[cells.start * count..cells.end * count].to_vec()
    };
    let starts = (0..lattice.rows.len()).step_by(ROWS_PER_BLOCK);
    let borders: Vec<[Vec<u16>; 2]> =
        starts.map(|first| [aside(first.checked_sub(1)), aside(Some(first + ROWS_PER_BLOCK))]).collect();
    let blocks = lattice.blocks(memberships.values_mut(), count);
    blocks
        .into_par_iter()
        .zip(borders)
        .map(|((rows, values), borders)| relax_block(lattice, rows, values, &borders, compatibilities, watch))
        .try_reduce(Changes::default, |one, other| {
            Ok(Changes { categories: one.categories + other.categories, largest: one.largest.max(other.largest) })
        })
}

/// One iteration over the rows of a block.
fn relax_block(
    lattice: &Lattice,
    rows: Range<usize>,
    values: &mut [u16],
    [before, after]: &[Vec<u16>; 2],
    compatibilities: &Compatibilities,
    watch: &Watch<'_>,
) -> Result<Changes, Stopped> {
    let count = compatibilities.count();
    let offset = lattice.rows[rows.start].start;
    let columns_of = |row: usize| &lattice.of_cells[lattice.rows[row].clone()];
    let place = |row: usize| {
        let cells = &lattice.rows[row];
        (cells.start - offset) * count..(cells.end - offset) * count
    };
    let mut window = [(); 3].map(|()| UnpackedRow::new(count, lattice.columns));
    let mut around = UnpackedRow::new(count, lattice.columns);
    let mut raised = Raised::new(count, lattice.columns);
    if rows.start > 0 {
        window[0].unpack(columns_of(rows.start - 1), before);
    }
    window[1].unpack(columns_of(rows.start), &values[place(rows.start)]);
    let mut changes = Changes::default();
    for row in rows.clone() {
        watch.check()?;
        match row + 1 {
            next if next < rows.end => window[2].unpack(columns_of(next), &values[place(next)]),
            next if next < lattice.rows.len() => window[2].unpack(columns_of(next), after),
            _ => window[2].clear(),
        }
        around.sum_neighbors(&window);
        window[1].raise(&around, compatibilities, &mut raised);
        raised.pack(columns_of(row), &mut values[place(row)], &mut changes);
        window.rotate_left(1);
    }
    Ok(changes)
}

/// A row of the lattice, category by category, with a column without shares at either end.
struct UnpackedRow {
    width: usize,
    /// 1 where there is a measured cell; of a sum, their number.
    cells: Vec<f32>,
    /// Shares, all of one category first.
    shares: Vec<f32>,
}

impl UnpackedRow {
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
        let [before, own, after] = [before, own, after].map(|row| row.shares.chunks_exact(self.width));
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

/// A row after one iteration, before its shares are divided by their sum.
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
    fn pack(&self, columns: &[u32], values: &mut [u16], changes: &mut Changes) {
        let count = self.shares.len() / self.width;
        for (&column, values) in columns.iter().zip(values.chunks_exact_mut(count.max(1))) {
            let at = column as usize + 1;
            if self.sums[at] <= 0.0 {
                continue;
            }
            let before = greatest(values.iter().copied());
            for (value, plane) in values.iter_mut().zip(self.shares.chunks_exact(self.width)) {
                let packed = (plane[at] / self.sums[at] * WHOLE).round() as u16;
                changes.largest = changes.largest.max(packed.abs_diff(*value));
                *value = packed;
            }
            changes.categories += usize::from(greatest(values.iter().copied()) != before);
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
