//! The exact Euclidean distance transform: for every cell the nearest of some target cells, and how far it is.
//!
//! Method: A. Meijster, J. Roerdink and W. Hesselink, *A general algorithm for computing distance transforms in linear
//! time* (2000): the nearest target in each column by two sweeps, then the lower envelope of the parabolas of each row.
//! All in whole numbers. Cost: O(cells), rows in parallel. Limits: sides below 32,768 cells.

use std::ops::Range;

use rayon::prelude::*;

use crate::watch::{Stopped, Watch};

/// The index of no cell.
pub(crate) const NONE: u32 = u32::MAX;

/// The nearest target of every cell, row-major.
pub(crate) struct DistanceTransform {
    /// Squared distance to it between cell centres, cells; `u32::MAX` without any target.
    pub squared: Vec<u32>,
    /// Its index; [`NONE`] without any target.
    pub nearest: Vec<u32>,
}

impl DistanceTransform {
    /// Measures the distance to the cells for which `is_target` holds, on a grid of `width` columns.
    pub(crate) fn of(
        width: usize,
        cells: usize,
        is_target: impl Fn(usize) -> bool,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let height = cells.checked_div(width).unwrap_or(0);
        // Holds the row of the nearest target in the same column, and after the second step its index.
        let mut rows = vec![NONE; cells];
        for row in 0..height {
            watch.check()?;
            for column in 0..width {
                let cell = row * width + column;
                rows[cell] = match row {
                    _ if is_target(cell) => row as u32,
                    0 => NONE,
                    _ => rows[cell - width],
                };
            }
        }
        for row in (0..height.saturating_sub(1)).rev() {
            for cell in row * width..(row + 1) * width {
                let (below, above) = (rows[cell], rows[cell + width]);
                if above != NONE && (below == NONE || above.abs_diff(row as u32) < below.abs_diff(row as u32)) {
                    rows[cell] = above;
                }
            }
        }
        let mut found = Self { squared: vec![u32::MAX; cells], nearest: rows };
        let lines = found.squared.par_chunks_mut(width.max(1)).zip(found.nearest.par_chunks_mut(width.max(1)));
        lines.enumerate().try_for_each_init(
            || (Vec::new(), Vec::new()),
            |(envelope, targets), (row, (squared, nearest))| {
                watch.check()?;
                targets.clear();
                targets.extend_from_slice(nearest);
                lower_envelope(row as i64, targets, envelope);
                for (source, columns) in envelope.iter() {
                    for column in columns.clone() {
                        squared[column] = height_at(row as i64, targets, *source, column as i64) as u32;
                        nearest[column] = targets[*source] * width as u32 + *source as u32;
                    }
                }
                Ok(())
            },
        )?;
        Ok(found)
    }
}

/// Squared distance from a cell of a row to the nearest target of another column: a parabola over the columns.
fn height_at(row: i64, targets: &[u32], source: usize, column: i64) -> i64 {
    let (across, along) = (row - i64::from(targets[source]), column - source as i64);
    across * across + along * along
}

/// The columns with a target, each with the range of columns in which its parabola is the lowest.
fn lower_envelope(row: i64, targets: &[u32], envelope: &mut Vec<(usize, Range<usize>)>) {
    envelope.clear();
    let end = targets.len();
    for (column, _) in targets.iter().enumerate().filter(|&(_, &target)| target != NONE) {
        let mut start = 0;
        while let Some((last, range)) = envelope.last_mut() {
            // From here on the new parabola is lower than the last one.
            let (own, other) = (height_at(row, targets, column, 0), height_at(row, targets, *last, 0));
            let crossing = (own - other).div_euclid(2 * (column - *last) as i64) + 1;
            let crossing = usize::try_from(crossing).unwrap_or(0);
            if crossing > range.start {
                range.end = crossing.min(end);
                start = crossing;
                break;
            }
            envelope.pop();
        }
        if start < end {
            envelope.push((column, start..end));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn no_target_is_nearer(width in 1_usize..12, targets in proptest::collection::vec(any::<bool>(), 0..120)) {
            let cells = targets.len() / width * width;
            let found =
                DistanceTransform::of(width, cells, |cell| targets[cell], &Watch::unwatched()).expect("nobody stops it");
            for cell in 0..cells {
                let squared = |other: usize| {
                    let across = (cell / width).abs_diff(other / width);
                    let along = (cell % width).abs_diff(other % width);
                    (across * across + along * along) as u32
                };
                let least = (0..cells).filter(|&other| targets[other]).map(squared).min();
                prop_assert_eq!(found.squared[cell], least.unwrap_or(u32::MAX));
                if least.is_some() {
                    prop_assert_eq!(squared(found.nearest[cell] as usize), found.squared[cell]);
                    prop_assert!(targets[found.nearest[cell] as usize]);
                }
            }
        }
    }
}
