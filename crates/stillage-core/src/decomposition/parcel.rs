//! Parcels: rectangles of a region and what each was cut out for, in the cells of the region's frame.

use std::ops::Range;

use super::ground::{Axis, Rect, RegionFrame};
use crate::geometry::{OrientedBox, Point, direction, normal};
use crate::plot::{Plot, PlotKind};

/// A rectangle of a region and what it was cut out for, in the cells of the region's frame.
#[derive(Debug, Clone)]
pub(crate) struct Parcel {
    pub rect: Rect,
    pub kind: PlotKind,
    pub axis: Option<Axis>,
    /// The layers of a piece that is cut through several of them, as ranges across the rows; empty for any other parcel.
    pub layers: Vec<Range<usize>>,
}

impl Parcel {
    pub(crate) fn new(rect: Rect, kind: PlotKind, axis: Option<Axis>) -> Self {
        Self { rect, kind, axis, layers: Vec::new() }
    }

    /// Each of its layers as a parcel of its own.
    pub(crate) fn into_layers(self) -> Vec<Self> {
        match self.axis {
            Some(axis) if self.layers.len() > 1 => {
                let of_layer =
                    |layer: &Range<usize>| Self::new(self.rect.with(axis.other(), layer.clone()), self.kind, self.axis);
                self.layers.iter().map(of_layer).collect()
            }
            _ => vec![self],
        }
    }
}

/// A parcel in metres of the grid.
pub(super) fn plot(frame: &RegionFrame, region: u8, parcel: &Parcel) -> Plot {
    let axis = parcel.axis.unwrap_or(Axis::U);
    let middle = |range: &Range<usize>| (range.start + range.end) as f64 / 2.0 * frame.cell;
    let (u, v) = (frame.start[0] + middle(&parcel.rect.u), frame.start[1] + middle(&parcel.rect.v));
    let half = |axis: Axis| parcel.rect.range(axis).len() as f64 * frame.cell / 2.0;
    let bounds = OrientedBox {
        center: Point::from(direction(frame.angle) * u + normal(frame.angle) * v),
        half_extents: [half(axis), half(axis.other())],
        angle: frame.angle + if axis == Axis::V { std::f64::consts::FRAC_PI_2 } else { 0.0 },
    };
    Plot { bounds, kind: parcel.kind, region }
}
