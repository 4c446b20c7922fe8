//! The decomposition of a map into places: aisles first, then rows, then the cells of each row.
//!
//! ```text
//! grid ── frame (one per region, turned into its direction) ── drivable ── blocks ── layers ── rows ── comb ── ends ── lines
//! ```
//!
//! The paper (II-B) cuts a region by infinite lines through the peaks of its radiograms. That labels areas well and cuts
//! few pallet cells right, since peaks sit on goods and racks drift. Here straight drivable bands are found first
//! ([`blocks`]); what lies between two of them is a body of one or more layers ([`depth`], [`extent`], [`layers`], [`across`]). If its
//! rows repeat themselves ([`gate`]), their cells come from the evidence for borders ([`evidence`], [`comb`]) and from the
//! goods in them, which are alike ([`goods`], [`reading`]). Rows and aisles end where their signs do ([`ends`]), and so
//! does every line ([`lines`]).
//!
//! Everything is in metres; the result does not depend on the number of threads. Cost: O(cells + row cells x pitches).

mod across;
mod blocks;
mod comb;
mod depth;
mod drivable;
mod ends;
mod evidence;
mod extent;
mod frame;
mod gate;
mod goods;
mod lanes;
mod layers;
mod lines;
mod opening;
mod pieces;
mod reading;
mod rows;
mod site;

#[cfg(test)]
mod tests;

use std::ops::Range;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::geometry::{OrientedBox, Point, direction, normal};
use crate::grid::OccupancyGrid;
use crate::radiography::Line;
use crate::segmentation::RegionMap;
use crate::spec::DecompositionOptions;
use crate::watch::{Stopped, Watch};

use frame::{Axis, Frame, Rect};
use rows::Hints;
use site::Site;

pub(crate) use site::Blocks;

/// What a parcel was cut out for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlotKind {
    /// One place for goods.
    Place,
    /// A drivable band with places along it.
    Aisle,
    /// Open floor: across the ends of rows, beside them, around them.
    Lane,
    /// A passage through a row.
    Gap,
    /// A room beside the hall, or a bay behind one of its gates.
    Room,
    /// Anything else.
    Rest,
}

/// A rectangle of a region and what it was cut out for, in the cells of the region's frame.
#[derive(Debug, Clone)]
struct Parcel {
    rect: Rect,
    kind: PlotKind,
    axis: Option<Axis>,
    /// The layers of a piece of several rows one behind the other, as ranges across them; none of any other.
    layers: Vec<Range<usize>>,
}

impl Parcel {
    fn new(rect: Rect, kind: PlotKind, axis: Option<Axis>) -> Self {
        Self { rect, kind, axis, layers: Vec::new() }
    }

    /// Each layer by itself.
    fn into_layers(self) -> Vec<Self> {
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

/// Lines, and what they enclose.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Decomposition {
    /// The borders of the plots.
    pub lines: Vec<Line>,
    /// The plots, by region.
    pub plots: Vec<Plot>,
}

/// Decomposes a grid, region by region.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn decompose(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    options: &DecompositionOptions,
    watch: &Watch<'_>,
) -> Result<Decomposition, Stopped> {
    let site = Site::of(grid, regions, watch)?;
    let of_region: Vec<Decomposition> = (0..regions.regions.len() as u8)
        .into_par_iter()
        .map(|region| decompose_region(grid, regions, region, &site, options, watch))
        .collect::<Result<_, _>>()?;
    let mut whole = Decomposition::default();
    for part in of_region {
        whole.lines.extend(part.lines);
        whole.plots.extend(part.plots);
    }
    Ok(whole)
}

fn decompose_region(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    region: u8,
    site: &Site,
    options: &DecompositionOptions,
    watch: &Watch<'_>,
) -> Result<Decomposition, Stopped> {
    let Some(&angle) = regions.regions[usize::from(region)].orientations.first() else {
        return Ok(Decomposition::default());
    };
    let mut frame = Frame::new(grid, regions, region, angle, site, watch)?;
    let vehicle = frame.cells_of(options.vehicle_width_m);
    drivable::mark(&mut frame, vehicle, watch)?;
    let blocks = blocks::cut(&frame, watch)?;
    let hints =
        Hints { pitch: options.pitch_m.unwrap_or(rows::PITCHES_M), depth: options.depth_m.unwrap_or(rows::DEPTHS_M) };
    let parcels = ends::end(&frame, rows::lay_out(&frame, &blocks, &hints, watch)?);
    let lines = lines::of_parcels(&frame, region, &parcels);
    let plots = parcels.iter().map(|parcel| plot(&frame, region, parcel)).collect();
    Ok(Decomposition { lines, plots })
}

fn plot(frame: &Frame, region: u8, parcel: &Parcel) -> Plot {
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
