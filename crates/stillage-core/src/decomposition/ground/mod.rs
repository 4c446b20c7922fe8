//! The ground of a region in cells along its first direction, and where a vehicle finds room on it.

mod cell;
mod content;
pub(crate) mod drivable;
mod frame;
mod line_profile;
mod patch;
mod rect;
mod rect_index;

pub(crate) use cell::Cell;
pub(crate) use content::{UNKNOWN_CONTENT, content};
pub(crate) use frame::RegionFrame;
pub(crate) use line_profile::LineProfile;
pub(crate) use patch::Patch;
pub(crate) use rect::{Axis, Rect};
pub(crate) use rect_index::RectIndex;
