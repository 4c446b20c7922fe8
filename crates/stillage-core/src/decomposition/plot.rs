//! Rectangles of a region and what each is: a parcel in the cells of its region's frame, a plot in metres of the grid.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::ground::{Axis, Rect, RegionFrame};
use crate::geometry::{OrientedBox, Point, direction, normal};

/// What a parcel was cut out for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlotKind {
    /// One place for goods.
    Place,
    /// A drivable band with places along it.
    Aisle,
    /// Open floor: cross aisles, and floor beside and around rows.
    OpenFloor,
    /// A passage through a row.
    Passage,
    /// A room beside the hall, or a bay behind one of its gates.
    Room,
    /// Anything else.
    Other,
}

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

/// A rectangle of the decomposition and what it was cut out for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plot {
    /// Where it lies; its first side runs along the rows.
    pub bounds: OrientedBox,
    /// What it was cut out for.
    pub kind: PlotKind,
    /// Region it belongs to.
    pub region: u8,
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
