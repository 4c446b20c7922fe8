//! The places of one direction, found by where they lie.

use crate::decomposition::ground::{Axis, Rect, RectIndex, RegionFrame};
use crate::decomposition::parcel::Parcel;
use crate::plot::PlotKind;
use crate::watch::{Stopped, Watch};

/// A place lies along a band if their borders are no further apart than this, metres.
const CONTACT_M: f64 = 0.8;

/// The places whose rows run along one axis.
pub(super) struct PlaceIndex {
    pub axis: Axis,
    /// The same distance as [`CONTACT_M`], cells.
    pub contact: usize,
    pub places: RectIndex,
}

impl PlaceIndex {
    pub fn of(frame: &RegionFrame, parcels: &[Parcel], axis: Axis, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let is_place = |parcel: &&Parcel| parcel.kind == PlotKind::Place && parcel.axis == Some(axis);
        let rects = parcels.iter().filter(is_place).map(|place| place.rect.clone()).collect();
        Ok(Self { axis, contact: frame.cells_of(CONTACT_M), places: RectIndex::of(rects, watch)? })
    }

    /// Numbers of the places along the low and the high side of a band, ascending.
    pub fn along(&self, band: &Rect) -> [Vec<usize>; 2] {
        let (across, contact) = (band.range(self.axis.other()), self.contact);
        let near = |place: usize, side: usize| {
            let depth = self.places.rects()[place].range(self.axis.other());
            [depth.end.abs_diff(across.start), depth.start.abs_diff(across.end)][side] <= contact
        };
        // Strips that hold the last line of every such place at the low side, and the first one at the high side.
        let low = (across.start.saturating_sub(contact + 1))..across.start + contact;
        let high = across.end.saturating_sub(contact)..across.end + contact + 1;
        let strips = [low, high].map(|strip| band.with(self.axis.other(), strip));
        let mut along = strips.map(|strip| self.places.overlapping(&strip));
        for (side, places) in along.iter_mut().enumerate() {
            places.retain(|&place| near(place, side));
        }
        along
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn rect() -> impl Strategy<Value = Rect> {
        let range = || (0_usize..120, 1_usize..40).prop_map(|(start, length)| start..start + length);
        (range(), range()).prop_map(|(u, v)| Rect { u, v })
    }

    proptest! {
        #[test]
        fn those_whose_border_is_near_are_found(rects in proptest::collection::vec(rect(), 0..60), band in rect()) {
            let contact = 16;
            for axis in Axis::BOTH {
                let (along, across) = (band.range(axis), band.range(axis.other()));
                let is_along = |place: &Rect, side: usize| {
                    let (beside, depth) = (place.range(axis), place.range(axis.other()));
                    let distance = [depth.end.abs_diff(across.start), depth.start.abs_diff(across.end)][side];
                    beside.start < along.end && along.start < beside.end && distance <= contact
                };
                let wanted = [0, 1].map(|side| {
                    (0..rects.len()).filter(|&place| is_along(&rects[place], side)).collect::<Vec<_>>()
                });
                let places = RectIndex::of(rects.clone(), &Watch::unwatched()).expect("nobody stops it");
                prop_assert_eq!(PlaceIndex { axis, contact, places }.along(&band), wanted);
            }
        }
    }
}
