//! Where rows end, and where aisles end with them.
//!
//! The comb fills a row from side to side, whatever is there. Here goes what is no row of goods ([`rows`]): pieces
//! outside the site, passages that several rows share ([`passages`]), and the bare pieces beyond the last sign of
//! goods. Then bands are cut where no place lies along them any more ([`bands`]), and across where there is room for more
//! than the aisles of their rows ([`aisles`]), and open floor where nobody saw it ([`floor`]). What becomes free that way
//! is open floor, a lane whatever it was found in, or a gap where it passes through a row.

mod aisles;
mod bands;
mod floor;
mod passages;
mod rows;

use super::Parcel;
use super::frame::Frame;

/// Ends rows and bands where their signs end. Layers that are reached from one side end together.
pub(super) fn end(frame: &Frame, parcels: Vec<Parcel>) -> Vec<Parcel> {
    let parcels = rows::end(frame, parcels).into_iter().flat_map(Parcel::into_layers).collect();
    floor::cut(frame, bands::end(frame, parcels))
}
