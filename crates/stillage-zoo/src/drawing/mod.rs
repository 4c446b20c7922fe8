//! Plain drawings of warehouses: what CAD exports, simulators and cleaned-up scans look like.
//!
//! A [`Plan`] is everything that the seed decides: the hall, its racks, the places in them. [`build`] makes a site
//! of it, [`ink`] draws of a rack what its [`DrawingStyle`] shows, [`paint`] turns all that into greys. The truth is that of the plan, whatever is drawn of it:
//! a place that stands empty is a place.
//!
//! Cost: O(cells), well below a second. Limits: rows run in one direction; the hall is a rectangle with offices outside.

mod build;
mod ink;
mod options;
mod outside;
mod paint;
mod plan;
mod style;

#[cfg(test)]
mod tests;

use serde::Serialize;

use crate::random::Random;
use crate::sample::Sample;
use crate::shape::Pose;
use crate::site::Site;
use crate::truth::{Truth, rounded};
use plan::Plan;

pub use options::DrawingOptions;
pub use outside::Outside;
pub use style::DrawingStyle;

/// What a drawing was made from.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawingMeta {
    /// Seed of everything.
    pub seed: u64,
    /// What is drawn of the storage.
    pub style: String,
    /// Side of a cell, metres.
    pub resolution: f64,
    /// Distance from place to place along a row, metres.
    pub pitch: f64,
    /// Size of a place across the row, metres.
    pub depth: f64,
    /// Width of the aisles, metres.
    pub aisle: f64,
    /// Width of the cross aisles between blocks, metres.
    pub cross_aisle: f64,
    /// Whether rows stand back to back.
    pub double: bool,
    /// Places from the aisle to the back of a row.
    pub layers: usize,
    /// Rows and pairs of rows across the hall.
    pub rows: usize,
    /// Blocks along the hall.
    pub blocks: usize,
    /// Probability that a place is empty.
    pub empty: f64,
    /// Whether columns of the building are drawn.
    pub columns: bool,
    /// Rooms beside the hall.
    pub offices: usize,
    /// What lies beyond the walls.
    pub outside: Outside,
    /// Distance of the walls to the border of the picture, metres.
    pub margin: f64,
    /// Turn of the hall in the map, degrees.
    pub turn: f64,
    /// Whether edges are grey (anti-aliased).
    pub soft: bool,
    /// Thickness of the walls, metres.
    pub wall: f64,
    /// Number of places.
    pub places: usize,
    /// Columns and rows of the map.
    pub size: [usize; 2],
}

/// Draws a warehouse.
#[must_use]
pub fn draw(style: DrawingStyle, seed: u64, options: &DrawingOptions) -> Sample<DrawingMeta> {
    let mut random = Random::of_drawing(style, seed);
    let plan = Plan::new(style, options, &mut random);
    let mut site = Site::default();
    site.add(&build::build(&plan, &mut random), &Pose::new(plan.turn, 0.0, 0.0));
    let lattice = paint::lattice(&site, &plan, options.shifted_cells);
    let greys = paint::greys(&site, &plan, &lattice);
    // A drawing shows everything.
    let truth = Truth::new(&site.truth, |_| 1.0);
    let meta = DrawingMeta {
        seed,
        style: style.to_string(),
        resolution: lattice.resolution,
        pitch: rounded(plan.pitch, 3),
        depth: rounded(plan.depth, 3),
        aisle: rounded(plan.aisle, 3),
        cross_aisle: rounded(plan.cross_aisle, 3),
        double: plan.double,
        layers: plan.layers,
        rows: plan.racks_across(),
        blocks: plan.blocks,
        empty: plan.empty,
        columns: plan.columns,
        offices: plan.offices,
        outside: plan.outside,
        margin: rounded(plan.margin, 3),
        turn: rounded(plan.turn.to_degrees(), 3),
        soft: plan.soft,
        wall: plan.wall,
        places: truth.places_by_region().values().sum(),
        size: [lattice.width, lattice.height],
    };
    Sample { meta, truth, lattice, greys, facts: site.truth }
}
