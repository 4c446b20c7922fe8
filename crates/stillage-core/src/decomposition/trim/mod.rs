//! Where rows end, and where aisles end with them.
//!
//! The comb fills a row from side to side, whatever is there. Here goes what is no row of goods ([`row_ends`]): pieces
//! outside the site, passages that several rows share ([`passages`]), and the bare pieces beyond the last sign of
//! goods. Then bands are cut where no place lies along them any more ([`aisle_bands`]), and across where there is room for more
//! than the aisles of their rows ([`aisle_width`]), and open floor where nobody saw it ([`open_floor`]). What becomes free that way
//! is open floor, a lane whatever it was found in, or a gap where it passes through a row.

mod aisle_bands;
mod aisle_width;
mod open_floor;
mod passages;
mod row_ends;

use crate::decomposition::ground::RegionFrame;
use crate::decomposition::plot::Parcel;

/// Ends rows and bands where their signs end. Layers that are reached from one side end together.
pub(crate) fn end(frame: &RegionFrame, parcels: Vec<Parcel>) -> Vec<Parcel> {
    let parcels = row_ends::end(frame, parcels).into_iter().flat_map(Parcel::into_layers).collect();
    open_floor::cut(frame, aisle_bands::end(frame, parcels))
}
