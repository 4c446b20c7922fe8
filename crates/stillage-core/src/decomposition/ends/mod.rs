//! Where rows end, and where aisles end with them.
//!
//! The comb fills a row from side to side, whatever is there. Here goes what is no row of goods ([`rows`]): pieces
//! outside the site, passages that several rows share ([`passages`]), and the bare pieces beyond the last sign of
//! goods. Then bands are cut where no place lies along them any more ([`bands`]), and open floor where nobody saw it
//! ([`floor`]). What becomes free that way is open floor, a lane whatever it was found in, or a gap where it passes
//! through a row.

mod bands;
mod floor;
mod passages;
mod rows;

use super::Parcel;
use super::frame::Frame;

/// Ends rows and bands where their signs end.
pub(super) fn end(frame: &Frame, parcels: Vec<Parcel>) -> Vec<Parcel> {
    floor::cut(frame, bands::end(frame, rows::end(frame, parcels)))
}
