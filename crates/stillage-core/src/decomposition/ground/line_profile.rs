//! Cells along every line of a rectangle, counted.

use super::cell::Cell;
use super::frame::RegionFrame;
use super::rect::{Axis, Rect};
use crate::watch::{Stopped, Watch};

/// Counts along every line of a rectangle.
pub(crate) struct LineProfile {
    /// Cells of the site.
    pub ground: Vec<u32>,
    /// Drivable ones among them.
    pub drivable: Vec<u32>,
    /// Occupied cells, smoothed over three lines.
    pub occupied: Vec<f64>,
}

impl LineProfile {
    /// Lines along `axis`.
    pub fn of(frame: &RegionFrame, rect: &Rect, axis: Axis, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let count = |is: fn(Cell) -> bool| watch.check().map(|()| frame.counts(rect, axis, is));
        let ground = count(Cell::is_inside)?;
        let drivable = count(|cell| cell.is_inside() && cell.is_drivable())?;
        let occupied = count(|cell| cell.is_inside() && cell.is_occupied())?;
        let at = |line: Option<usize>| line.and_then(|line| occupied.get(line)).copied().map_or(0.0, f64::from);
        let smooth = |line: usize| (at(line.checked_sub(1)) + 2.0 * at(Some(line)) + at(Some(line + 1))) / 4.0;
        Ok(Self { ground, drivable, occupied: (0..occupied.len()).map(smooth).collect() })
    }
}
