//! Where a vehicle finds room: the opening of the free cells by a square as wide as the vehicle.

use super::frame::RegionFrame;
use crate::morphology;
use crate::watch::{Stopped, Watch};

/// Marks the drivable cells of a frame for a vehicle of `width` cells.
pub(crate) fn mark(frame: &mut RegionFrame, width: usize, watch: &Watch<'_>) -> Result<(), Stopped> {
    let size = [frame.columns, frame.rows];
    let squares = morphology::fitting_squares(size, width, |cell| frame.cells[cell].is_free(), watch)?;
    morphology::mark_covered(&squares, frame.columns, width, |cell| frame.cells[cell].mark_drivable(), watch)
}
