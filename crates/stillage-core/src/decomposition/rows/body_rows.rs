//! The rows that stand in the bodies of one direction, and what is left of the bodies beside them.
//!
//! Cost: O(cells of the bodies).

use std::ops::Range;

use super::rack_row::{RackRow, span};
use crate::decomposition::bodies::body::{self, Body};
use crate::decomposition::bodies::layers::BodyLayers;
use crate::decomposition::ground::{Axis, Rect, RegionFrame};
use crate::decomposition::parcel::Parcel;
use crate::plot::PlotKind;
use crate::watch::{Stopped, Watch};

/// What the bodies of one direction hold.
#[derive(Default)]
pub(super) struct BodyRows {
    pub rows: Vec<RackRow>,
    /// What is left beside the rows.
    pub others: Vec<Parcel>,
    /// Rectangles of the rows that reach into the aisles before their body.
    pub reaching: Vec<Rect>,
}

impl BodyRows {
    pub fn of(
        frame: &RegionFrame,
        bodies: &[&Body],
        layers: Vec<BodyLayers>,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let mut found = Self::default();
        for (body, layers) in bodies.iter().zip(layers) {
            watch.check()?;
            let axis = body.axis;
            let part = |range, kind| Parcel::new(body.rect.with(axis.other(), range), kind, Some(axis));
            found.others.extend(layers.floors.into_iter().map(|floor| part(floor, PlotKind::Aisle)));
            found.others.extend(layers.others.into_iter().map(|other| part(other, PlotKind::Other)));
            for group in layers.groups {
                found.add(frame, body, group);
            }
        }
        Ok(found)
    }

    /// Adds the layers of a body that are reached from one side.
    fn add(&mut self, frame: &RegionFrame, body: &Body, layers: Vec<Range<usize>>) {
        let (axis, across, own) = (body.axis, body.across(), span(&layers));
        let rect = body.rect.with(axis.other(), own.clone());
        if own.start < across.start || own.end > across.end {
            self.reaching.push(rect.clone());
        }
        let [before, within, after] = in_region(frame, &rect, axis).map(|part| rect.with(axis, part));
        let beside = [before, after].into_iter().filter(|rest| !rest.range(axis).is_empty());
        self.others.extend(beside.map(|rest| Parcel::new(rest, PlotKind::Other, Some(axis))));
        if !within.range(axis).is_empty() {
            let open = body::front_shares(frame, &within, axis).into_iter().fold(0.0, f64::max);
            self.rows.push(RackRow { rect: within, axis, layers, open });
        }
    }
}

/// The parts of a row before, within and behind its region. A region is bounded by tiles and its bodies are rectangles,
/// so a row may begin or end in the next region, whose rows have another direction.
fn in_region(frame: &RegionFrame, row: &Rect, axis: Axis) -> [Range<usize>; 3] {
    let patch = frame.patch(row, axis);
    let along = row.range(axis);
    let is_within = |&column: &usize| {
        2 * (0..patch.height).filter(|&row| patch.row(row)[column].is_inside()).count() >= patch.height
    };
    let first = (0..patch.width).find(is_within).unwrap_or(patch.width);
    let end = (first..patch.width).rfind(is_within).map_or(first, |last| last + 1);
    [along.start..along.start + first, along.start + first..along.start + end, along.start + end..along.end]
}
