//! How the bodies between aisles are divided into rows, one behind the other.
//!
//! Every place of a rack must be reached, so a thin body between two aisles is one row, or two back to back. A deeper one
//! (double-deep racks, block storage, marked floors) and one before a wall may have any number of layers.
//! [`super::layer_count`] finds how many there are and how deep; where goods show too little for that, the thickness of the
//! body decides. Layers that are reached from one side form a group: their storage lanes run through all of them, so they
//! are cut together and end together.
//!
//! Cost: O(cells of the bodies), and that of [`super::layer_count`]. Limits: where goods hide what is behind them, the
//! usual depth of a pallet decides.

use std::ops::Range;

use super::body::Body;
use super::depth::{THIN_SHARE, WHOLE_SHARE};
use super::extent::{DEEP_ROOM, extents, is_deep};
use super::layer_count::{self, Strips};
use crate::decomposition::ground::RegionFrame;
use crate::watch::{Stopped, Watch};

/// The layers of a body that are reached from one side, as ranges across its rows.
pub(crate) type LayerGroup = Vec<Range<usize>>;

/// The layers of a body, and what is left beside them, as ranges across its rows.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct BodyLayers {
    pub groups: Vec<LayerGroup>,
    /// What is left on the side of an aisle: floor.
    pub floors: Vec<Range<usize>>,
    /// What is left on the side of a wall.
    pub others: Vec<Range<usize>>,
}

impl BodyLayers {
    fn none(body: &Body) -> Self {
        Self { others: vec![body.across()], ..Self::default() }
    }

    /// From layers in the order of lines, one at least; between two aisles each is reached from the nearer one.
    fn of(body: &Body, mut layers: LayerGroup) -> Self {
        let (across, count) = (body.across(), layers.len());
        let (start, end) = (layers[0].start, layers[count - 1].end);
        let mut found = Self::default();
        for (is_front, side) in body.fronts.into_iter().zip([across.start..start, end..across.end]) {
            if !side.is_empty() {
                if is_front { &mut found.floors } else { &mut found.others }.push(side);
            }
        }
        let is_divided = body.fronts[0] == body.fronts[1] && count % 2 == 0;
        let far = if is_divided { layers.split_off(count / 2) } else { Vec::new() };
        found.groups = [layers, far].into_iter().filter(|group| !group.is_empty()).collect();
        found
    }
}

/// Divides the bodies of one direction into layers of about a depth, metres, within a range.
pub(crate) fn cut(
    frame: &RegionFrame,
    bodies: &[&Body],
    depth: f64,
    range: [f64; 2],
    watch: &Watch<'_>,
) -> Result<Vec<BodyLayers>, Stopped> {
    let (mut all_extents, mut strips) = (Vec::with_capacity(bodies.len()), Vec::with_capacity(bodies.len()));
    for body in bodies {
        watch.check()?;
        let extents = extents(frame, body, depth, range);
        strips.push(Strips::of(frame, body, &extents));
        all_extents.push(extents);
    }
    let found = layer_count::layers(&strips, range, watch)?;
    let mut layers = Vec::with_capacity(bodies.len());
    for ((body, extents), found) in bodies.iter().zip(all_extents).zip(found) {
        let room = &extents[0];
        layers.push(if !found.is_empty() {
            BodyLayers::of(body, found)
        } else if is_deep(frame, body, room, depth, range) && body.fronts[0] == body.fronts[1] {
            BodyLayers::none(body)
        } else {
            by_thickness(frame, body, room, depth)
        });
    }
    Ok(layers)
}

/// One row or two back to back; before a wall, the row along the aisle.
fn by_thickness(frame: &RegionFrame, body: &Body, room: &Range<usize>, depth: f64) -> BodyLayers {
    let rows = room.len() as f64 * frame.cell / depth;
    let least = if body.fronts[0] == body.fronts[1] { THIN_SHARE } else { WHOLE_SHARE };
    if rows < least {
        return BodyLayers::none(body);
    }
    if rows < DEEP_ROOM {
        return BodyLayers::of(body, vec![room.clone()]);
    }
    let row = frame.cells_of(depth).max(1);
    let middle = room.start + room.len().div_ceil(2);
    let [near, far] = match body.fronts {
        [true, false] => [room.start..room.start + row, 0..0],
        [false, true] => [room.end - row..room.end, 0..0],
        _ => [room.start..middle, middle..room.end],
    };
    BodyLayers::of(body, [near, far].into_iter().filter(|row| !row.is_empty()).collect())
}
