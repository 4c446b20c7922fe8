//! Opening by a square: the cells covered by the squares that fit into a set of cells (G. Matheron, *Random sets and
//! integral geometry*, 1975).
//!
//! An opening is [`fitting_squares`], then [`mark_covered`]. Squares lie along the grid, so each half is one pass over
//! the cells with running lengths. Cost: O(cells), whatever the side.

use crate::watch::{Stopped, Watch};

/// For each cell, row-major: whether a square of `side` cells with its upper right corner there fits into the cells for
/// which `is_open` holds.
pub(crate) fn fitting_squares(
    [columns, rows]: [usize; 2],
    side: usize,
    is_open: impl Fn(usize) -> bool,
    watch: &Watch<'_>,
) -> Result<Vec<bool>, Stopped> {
    let side = side.max(1);
    // `run` counts open cells along the row, `depth` the rows up to here whose run is long enough.
    let mut depth = vec![0_u32; columns];
    let mut fits = vec![false; columns * rows];
    for row in 0..rows {
        watch.check()?;
        let mut run = 0;
        for (column, depth) in depth.iter_mut().enumerate() {
            let cell = row * columns + column;
            run = if is_open(cell) { run + 1 } else { 0 };
            *depth = if run >= side { *depth + 1 } else { 0 };
            fits[cell] = *depth as usize >= side;
        }
    }
    Ok(fits)
}

/// Marks the cells that squares of `side` cells cover; `squares` tells where their upper right corners are.
pub(crate) fn mark_covered(
    squares: &[bool],
    columns: usize,
    side: usize,
    mut mark: impl FnMut(usize),
    watch: &Watch<'_>,
) -> Result<(), Stopped> {
    let side = side.max(1);
    let mut height_left = vec![0_usize; columns];
    for (row, ends) in squares.chunks_exact(columns.max(1)).enumerate().rev() {
        watch.check()?;
        let mut width_left = 0;
        for column in (0..columns).rev() {
            let left = &mut height_left[column];
            *left = if ends[column] { side } else { left.saturating_sub(1) };
            width_left = if *left > 0 { side } else { usize::saturating_sub(width_left, 1) };
            if width_left > 0 {
                mark(row * columns + column);
            }
        }
    }
    Ok(())
}
