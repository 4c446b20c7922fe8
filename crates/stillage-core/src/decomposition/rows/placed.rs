//! Rows whose places are known before aisles are cut: those of equal marks.

use crate::decomposition::aisles::{self, AisleContent};
use crate::decomposition::bodies::body;
use crate::decomposition::ground::{Axis, Cell, Rect, RegionFrame, drivable};
use crate::decomposition::parcel::Parcel;
use crate::marks::MarkedRow;
use crate::plot::PlotKind;
use crate::watch::{Stopped, Watch};

use super::row_layout::RowLayout;

/// Least share of a row with room for a vehicle before it.
const REACHED_SHARE: f64 = 0.5;

/// A row and the borders of its places, cells of the frame.
pub(crate) struct PlacedRow {
    rect: Rect,
    axis: Axis,
    /// Ascending, both ends included.
    borders: Vec<usize>,
}

impl PlacedRow {
    /// A row in cells; `None` where most of its ground is in no hall, so that it is not solid there.
    pub(crate) fn of(frame: &RegionFrame, row: &MarkedRow) -> Option<Self> {
        let axis = Axis::BOTH[row.frame.axis];
        let cell = |axis: Axis, place: f64| {
            let start = frame.start[usize::from(axis == Axis::V)];
            (((place - start) / frame.cell).round().max(0.0) as usize).min(frame.whole().range(axis).end)
        };
        let borders: Vec<usize> = row.borders.iter().map(|&border| cell(axis, border)).collect();
        let along = *borders.first()?..*borders.last()?;
        let [low, high] = row.across.map(|place| cell(axis.other(), place));
        let rect = Rect { u: 0..0, v: 0..0 }.with(axis, along).with(axis.other(), low..high);
        let is_in = !rect.u.is_empty() && !rect.v.is_empty() && 2.0 * frame.share(&rect, Cell::is_occupied) > 1.0;
        is_in.then_some(Self { rect, axis, borders })
    }

    fn count(&self) -> usize {
        self.borders.len() - 1
    }

    /// Whether vehicles find room before most of it.
    fn is_reached(&self, frame: &RegionFrame) -> bool {
        body::front_shares(frame, &self.rect, self.axis).into_iter().any(|share| share >= REACHED_SHARE)
    }

    fn parcels(&self) -> impl Iterator<Item = Parcel> {
        let layers = vec![self.rect.range(self.axis.other()).clone()];
        self.borders.windows(2).map(move |pair| Parcel {
            layers: layers.clone(),
            ..Parcel::new(self.rect.with(self.axis, pair[0]..pair[1]), PlotKind::Place, Some(self.axis))
        })
    }
}

/// Lays a region out around rows, for the vehicles that most places can be reached by; of equals the widest.
pub(crate) fn layout(
    frame: &mut RegionFrame,
    rows: &[PlacedRow],
    widths_m: &[f64],
    watch: &Watch<'_>,
) -> Result<RowLayout, Stopped> {
    for row in rows {
        frame.fill(&row.rect);
    }
    let mut best = (0, widths_m[0]);
    for &width_m in widths_m {
        drivable::mark(frame, width_m, watch)?;
        let lanes: usize = rows.iter().filter(|row| row.is_reached(frame)).map(PlacedRow::count).sum();
        if lanes > best.0 {
            best = (lanes, width_m);
        }
    }
    drivable::mark(frame, best.1, watch)?;
    let cut = aisles::cut(frame, AisleContent::NoRows, watch)?;
    let bodies = cut.bodies.into_iter().map(|body| Parcel::new(body.rect, PlotKind::Other, body.axis));
    let mut parcels: Vec<Parcel> = cut.bands.into_iter().chain(bodies).collect();
    for row in rows {
        watch.check()?;
        let parts = |parcel: Parcel| {
            let rects = parcel.rect.without(&row.rect, row.axis);
            rects.into_iter().map(move |rect| Parcel { rect, ..parcel.clone() })
        };
        parcels = parcels.into_iter().flat_map(parts).collect();
    }
    parcels.extend(rows.iter().flat_map(PlacedRow::parcels));
    Ok(RowLayout { lanes: best.0, is_periodic: false, parcels })
}
