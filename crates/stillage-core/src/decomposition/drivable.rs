//! Where a vehicle finds room: the opening of the free cells by a square as wide as the vehicle.
//!
//! An opening keeps what can be covered by squares that fit (G. Matheron 1975). The square lies along the frame, so it is
//! done in four passes of running lengths. Cost: O(cells).

use super::frame::Frame;
use crate::watch::{Stopped, Watch};

/// Marks the drivable cells of a frame for a vehicle of `width` cells.
pub(super) fn mark(frame: &mut Frame, width: usize, watch: &Watch<'_>) -> Result<(), Stopped> {
    let (columns, rows) = (frame.columns, frame.rows);
    let width = width.max(1);
    // First along the rows: cells that end a free run of the width. Then along the columns: squares that fit.
    let mut depth = vec![0_u32; columns];
    let mut fits = vec![false; columns * rows];
    for row in 0..rows {
        watch.check()?;
        let mut run = 0;
        for (column, cell) in frame.row(row).iter().enumerate() {
            run = if cell.is_free() { run + 1 } else { 0 };
            depth[column] = if run >= width { depth[column] + 1 } else { 0 };
            fits[row * columns + column] = depth[column] as usize >= width;
        }
    }
    // A square ends at its upper right cell: it covers the width to the left and below.
    let mut height_left = vec![0_usize; columns];
    for row in (0..rows).rev() {
        watch.check()?;
        let mut width_left = 0;
        for column in (0..columns).rev() {
            height_left[column] =
                if fits[row * columns + column] { width } else { height_left[column].saturating_sub(1) };
            width_left = if height_left[column] > 0 { width } else { usize::saturating_sub(width_left, 1) };
            if width_left > 0 {
                frame.cells[row * columns + column].mark_drivable();
            }
        }
    }
    Ok(())
}
