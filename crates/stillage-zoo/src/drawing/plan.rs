//! The plan of a drawing: everything that its seed decides, and how much of it fits into a hall.

use std::ops::Range;

use super::options::DrawingOptions;
use super::outside::Outside;
use super::style::DrawingStyle;
use crate::random::Random;

/// Length and depth of a hall, metres.
const HALL: [Range<f64>; 2] = [22.0..52.0, 11.0..34.0];
/// Cells that a hall may take: a second or two of analysis. Turned, its picture has up to twice as many.
const MOST_CELLS: f64 = 1.6e6;
/// Least number of places of a row, and of cells from place to place: what an eye needs to see that places repeat.
const LEAST_PLACES: usize = 5;
const CELLS_PER_PLACE: f64 = 10.0;
/// Least width of an aisle, in depths of a row, where faces of rows are all that is drawn.
const WIDER_THAN_ROWS: f64 = 1.4;
/// Between a rack and the wall behind it, metres.
const BEHIND: f64 = 0.03;

/// What a drawing shows, and how. Lengths are metres.
#[derive(Debug, Clone)]
pub(super) struct Plan {
    pub(super) style: DrawingStyle,
    pub(super) resolution: f64,
    /// Whether edges are grey.
    pub(super) soft: bool,
    pub(super) outside: Outside,
    /// Distance of the walls to the border of the picture.
    pub(super) margin: f64,
    /// Turn of the hall, radians.
    pub(super) turn: f64,
    pub(super) wall: f64,
    pub(super) pitch: f64,
    pub(super) depth: f64,
    /// Places from the aisle to the back of a row.
    pub(super) layers: usize,
    pub(super) aisle: f64,
    /// Between two blocks.
    pub(super) cross_aisle: f64,
    /// Floor between the racks and the walls at both ends of the hall.
    ends: f64,
    /// Between two rows back to back.
    flue: f64,
    pub(super) double: bool,
    /// Whether rows stand before the low and the high wall.
    at_walls: [bool; 2],
    /// Racks across the hall that stand at no wall.
    free_racks: usize,
    pub(super) blocks: usize,
    /// Places along a row of one block.
    pub(super) places: usize,
    /// Probability that a place is empty.
    pub(super) empty: f64,
    /// Probability that a rack is absent.
    pub(super) missing: f64,
    pub(super) columns: bool,
    pub(super) offices: usize,
}

/// What lies across the hall, from the low wall to the high one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stripe {
    pub(super) y: Range<f64>,
    pub(super) kind: StripeKind,
}

/// What a stripe of the hall is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum StripeKind {
    Aisle,
    /// Whether a row faces down, and whether one faces up.
    Rack {
        down: bool,
        up: bool,
    },
    /// Between a rack and its wall.
    Behind,
}

impl Plan {
    /// Decides everything that the options leave open; the numbers drawn are the same under all options.
    pub(super) fn new(style: DrawingStyle, options: &DrawingOptions, random: &mut Random) -> Self {
        let pitch = random.within(style.pitch());
        let resolution: f64 = random.pick([0.02, 0.025, 0.03, 0.04, 0.05, 0.05, 0.05, 0.07, 0.1]);
        // Where places are to be told apart, cells are small enough for it.
        let resolution = if style.is_whole() { resolution } else { resolution.min(pitch / CELLS_PER_PLACE) };
        let resolution = options.resolution.unwrap_or(resolution);
        let depth = random.within(0.8..1.4);
        let aisle: f64 = random.within(1.0..4.0);
        // Where nothing but the distance of two faces tells a row from an aisle, the distances differ.
        let aisle = if style.shows_sides() { aisle } else { aisle.max(WIDER_THAN_ROWS * depth) };
        let turn = match random.count(0..5) {
            0 | 1 => 0.0,
            2 => random.pick([-1.0, 1.0]) * random.within(0.5..3.0),
            _ => random.within(-90.0..90.0),
        };
        let mut plan = Self {
            style,
            resolution,
            soft: random.chance(0.35),
            outside: options.outside.unwrap_or(random.pick(Outside::ALL)),
            margin: options.margin.unwrap_or(random.pick([0.0, 0.3, 1.0, 2.0, 3.0])),
            turn: (options.rotation_deg.unwrap_or(turn) + options.turned_deg).to_radians(),
            wall: random.pick([0.05, 0.1, 0.15, 0.2, 0.3, 0.4]),
            pitch,
            depth,
            layers: if style.shows_empty_places() && random.chance(0.15) { 2 } else { 1 },
            aisle,
            // No narrower than the aisles: the same vehicles drive here.
            cross_aisle: aisle * random.within(1.05..1.6),
            ends: aisle * random.within(1.2..2.0),
            flue: random.pick([0.0, 0.0, 0.1, 0.2]),
            double: random.chance(0.5),
            at_walls: [(); 2].map(|()| random.chance(0.4)),
            free_racks: 0,
            blocks: random.pick([1, 2, 2, 3]),
            places: 0,
            empty: if style.shows_empty_places() { random.pick([0.0, 0.0, 0.1, 0.2, 0.3, 0.4]) } else { 0.0 },
            missing: random.pick([0.0, 0.0, 0.05]),
            columns: random.chance(0.25),
            offices: random.pick([0, 0, 1, 2, 3]),
        };
        let hall = HALL.map(|range| random.within(range));
        plan.lay_out(options.hall.unwrap_or(hall));
        plan.resolution *= options.scale.unwrap_or(1.0);
        // Half a cell more: a wall may cross the cells aslant.
        plan.wall = plan.wall.max(plan.visible() + 0.5 * plan.resolution);
        plan
    }

    /// Width of the finest line that shows, metres: two cells where edges are grey, for a line between two columns of cells
    /// would leave neither of them black.
    pub(super) fn visible(&self) -> f64 {
        if self.soft { 2.0 * self.resolution } else { self.resolution }
    }

    /// Chooses how many racks and places fit into a hall of a length and depth.
    fn lay_out(&mut self, hall: [f64; 2]) {
        let shrunk = (MOST_CELLS * self.resolution.powi(2) / (hall[0] * hall[1])).sqrt().min(1.0);
        let [length, depth] = hall.map(|side| side * shrunk);
        let fitting = |blocks: usize| {
            let floor = 2.0 * self.ends + (blocks - 1) as f64 * self.cross_aisle;
            ((length - floor).max(0.0) / (blocks as f64 * self.pitch)) as usize
        };
        self.blocks = (1..=self.blocks).rev().find(|&blocks| fitting(blocks) >= LEAST_PLACES).unwrap_or(1);
        self.places = fitting(self.blocks).max(LEAST_PLACES);
        let rest = depth - self.racks_at_walls() as f64 * (self.row_depth() + BEHIND) - self.aisle;
        self.free_racks = ((rest / (self.rack_depth() + self.aisle)) as usize).max(2);
    }

    fn racks_at_walls(&self) -> usize {
        self.at_walls.iter().filter(|&&stands| stands).count()
    }

    /// Racks across the hall.
    pub(super) fn racks_across(&self) -> usize {
        self.free_racks + self.racks_at_walls()
    }

    /// Depth of one row with all its layers.
    fn row_depth(&self) -> f64 {
        self.layers as f64 * self.depth
    }

    /// Depth of a rack that stands free.
    fn rack_depth(&self) -> f64 {
        if self.double { 2.0 * self.row_depth() + self.flue } else { self.row_depth() }
    }

    /// Where the blocks lie along the hall.
    pub(super) fn block_ranges(&self) -> Vec<Range<f64>> {
        let length = self.places as f64 * self.pitch;
        let start = |block: usize| self.ends + block as f64 * (length + self.cross_aisle);
        (0..self.blocks).map(|block| start(block)..start(block) + length).collect()
    }

    /// Length of the hall.
    pub(super) fn length(&self) -> f64 {
        self.block_ranges().last().map_or(0.0, |range| range.end) + self.ends
    }

    /// What lies across the hall, from the low wall to the high one.
    pub(super) fn stripes(&self) -> Vec<Stripe> {
        use StripeKind::{Aisle, Behind, Rack};
        let aisle = (self.aisle, Aisle);
        let behind = (BEHIND, Behind);
        let at_wall = |down, up| (self.row_depth(), Rack { down, up });
        let mut order = Vec::new();
        if self.at_walls[0] {
            order.extend([behind, at_wall(false, true)]);
        }
        order.push(aisle);
        for _ in 0..self.free_racks {
            // A single row faces up.
            order.extend([(self.rack_depth(), Rack { down: self.double, up: true }), aisle]);
        }
        if self.at_walls[1] {
            order.extend([at_wall(true, false), behind]);
        }
        let mut start = 0.0;
        let place = |(depth, kind): (f64, StripeKind)| {
            let y = start..start + depth;
            start = y.end;
            Stripe { y, kind }
        };
        order.into_iter().map(place).collect()
    }
}
