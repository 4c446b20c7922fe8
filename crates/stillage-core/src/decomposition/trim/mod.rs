//! Rows, passages and aisles end where their evidence ends.
//!
//! The comb divides a row from end to end, whatever stands there. The steps that correct this:
//!
//! | step | module |
//! | --- | --- |
//! | pieces outside the site, and bare pieces beyond the last goods, are no places | [`row_ends`] |
//! | a way that leads through several rows is a passage | [`passages`] |
//! | an aisle ends with the places along it | [`aisle_bands`] |
//! | an aisle is as wide as others, the rest of its band is open floor | [`aisle_width`], [`aisle_need`] |
//! | open floor ends where the robot saw none | [`open_floor`] |
//!
//! Cost: O(cells), and near O(p log p) for p parcels; [`passages`] has its own worst case.

mod aisle_bands;
mod aisle_need;
mod aisle_width;
mod band_section;
mod open_floor;
mod passages;
mod piece_row;
mod place_index;
mod row_ends;

use crate::decomposition::ground::RegionFrame;
use crate::decomposition::parcel::Parcel;
use crate::watch::{Stopped, Watch};

/// The parcels of a region, trimmed. Layers that are reached from one side end together.
pub(crate) fn trimmed(frame: &RegionFrame, parcels: Vec<Parcel>, watch: &Watch<'_>) -> Result<Vec<Parcel>, Stopped> {
    let parcels = row_ends::trimmed(frame, parcels, watch)?;
    let parcels = parcels.into_iter().flat_map(Parcel::into_layers).collect();
    open_floor::trimmed(frame, aisle_bands::trimmed(frame, parcels, watch)?, watch)
}
