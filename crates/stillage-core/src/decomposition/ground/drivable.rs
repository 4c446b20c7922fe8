//! Where a vehicle finds room: the opening of the free cells by a square as wide as the vehicle.

use super::frame::Frame;
use super::opening;
use crate::watch::{Stopped, Watch};

/// Marks the drivable cells of a frame for a vehicle of `width` cells.
pub(super) fn mark(frame: &mut Frame, width: usize, watch: &Watch<'_>) -> Result<(), Stopped> {
    let size = [frame.columns, frame.rows];
    let squares = opening::squares(size, width, |cell| frame.cells[cell].is_free(), watch)?;
    opening::cover(&squares, frame.columns, width, |cell| frame.cells[cell].mark_drivable(), watch)
}
