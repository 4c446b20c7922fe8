//! Where a vehicle finds room: the opening of the free cells by a square as wide as the vehicle.

use super::cell::Cell;
use super::frame::RegionFrame;
use crate::morphology;
use crate::watch::{Stopped, Watch};

/// Marks the drivable cells of a frame for a vehicle of some width, metres.
pub(crate) fn mark(frame: &mut RegionFrame, vehicle_m: f64, watch: &Watch<'_>) -> Result<(), Stopped> {
    frame.vehicle_m = vehicle_m;
    frame.cells.iter_mut().for_each(Cell::clear_drivable);
    let (size, width) = ([frame.columns, frame.rows], frame.cells_of(vehicle_m));
    let squares = morphology::fitting_squares(size, width, |cell| frame.cells[cell].is_free(), watch)?;
    morphology::mark_covered(&squares, frame.columns, width, |cell| frame.cells[cell].mark_drivable(), watch)
}
