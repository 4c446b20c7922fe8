//! The ground of a region in cells along its first direction, and where a vehicle finds room on it.

pub(crate) mod drivable;
mod frame;

pub(crate) use frame::{Axis, Cell, Frame, Patch, Rect};
