//! From a plan to a site: floor, what is drawn on it, and what is true of it.

use std::ops::Range;

use super::ink::{Pen, Rack, Row, Slot};
use super::plan::{Plan, Stripe, StripeKind};
use crate::random::Random;
use crate::shape::Convex;
use crate::site::{About, Content, Place, Site};

/// The one region of a drawing.
const REGION: char = 'A';
/// Floor narrower than this is a gap behind a rack, metres.
const NARROWEST_JUNCTION: f64 = 0.2;
/// Side of a column, metres; one stands every so many places.
const COLUMN: f64 = 0.4;
const PLACES_PER_COLUMN: usize = 6;
/// Width of the door of an office; its sides along the hall and away from it, metres.
const DOOR: f64 = 1.0;
const OFFICE: [Range<f64>; 2] = [3.0..5.0, 3.0..6.0];

/// Builds the site of a plan, in a frame along the walls of the hall.
pub(super) fn build(plan: &Plan, random: &mut Random) -> Site {
    let stripes = plan.stripes();
    let depth = stripes.last().map_or(0.0, |stripe| stripe.y.end);
    let hall = Convex::rectangle(0.0..plan.length(), 0.0..depth);
    let mut builder = Builder { plan, pen: Pen::new(plan, random), random, site: Site::default() };
    builder.site.floor.push(hall.clone());
    let stands: Vec<Vec<bool>> =
        stripes.iter().enumerate().map(|(index, stripe)| builder.racks(index, stripe)).collect();
    builder.aisles(&stripes, &stands);
    let corridors = builder.site.shapes(|about| matches!(about, About::Corridor { .. }));
    let rest = hall.minus_all(builder.site.bodies.iter().chain(corridors));
    for shape in rest.into_iter().filter(|shape| shape.narrowest() > NARROWEST_JUNCTION) {
        builder.site.state(shape, About::Junction);
    }
    builder.offices(depth);
    for wall in builder.site.walls(plan.wall) {
        builder.site.solids.push(wall.clone());
        builder.site.state(wall, About::Wall);
    }
    let &Plan { pitch, depth, .. } = plan;
    builder.site.state(hall, About::Region { name: REGION, angle: 0.0, pitch, depth });
    builder.site
}

struct Builder<'a> {
    plan: &'a Plan,
    pen: Pen,
    random: &'a mut Random,
    site: Site,
}

impl Builder<'_> {
    /// Builds the racks of a stripe, and says for each block whether one stands there.
    fn racks(&mut self, index: usize, stripe: &Stripe) -> Vec<bool> {
        let StripeKind::Rack { down, up } = stripe.kind else { return vec![false; self.plan.blocks] };
        let mut stands = Vec::new();
        for (block, x) in self.plan.block_ranges().into_iter().enumerate() {
            let is_there = !self.random.chance(self.plan.missing);
            if is_there {
                let facing = [(down, false), (up, true)].into_iter().filter(|(is_there, _)| *is_there);
                let rows = facing.flat_map(|(_, up)| self.rows(&x, &stripe.y, up)).collect();
                self.rack(&Rack { x, y: stripe.y.clone(), rows }, &format!("{REGION}{index}.{block}"));
            }
            stands.push(is_there);
        }
        stands
    }

    /// The layers of one side of a rack, front first.
    fn rows(&mut self, x: &Range<f64>, y: &Range<f64>, up: bool) -> Vec<Row> {
        let &Plan { pitch, depth, empty, .. } = self.plan;
        let mut row = |layer: usize| {
            let front = layer as f64 * depth;
            let low = if up { y.end - front - depth } else { y.start + front };
            let mut slot = |index: usize| {
                let start = x.start + index as f64 * pitch;
                Slot { x: start..start + pitch, full: !self.random.chance(empty) }
            };
            Row { y: low..low + depth, up, layer, slots: (0..self.plan.places).map(&mut slot).collect() }
        };
        (0..self.plan.layers).map(&mut row).collect()
    }

    /// Draws a rack and states its places.
    fn rack(&mut self, rack: &Rack, name: &str) {
        self.site.solids.extend(self.pen.draw(self.plan.style, rack));
        let body = Convex::rectangle(rack.x.clone(), rack.y.clone());
        if self.plan.columns {
            let middle = f64::midpoint(rack.y.start, rack.y.end);
            for index in (PLACES_PER_COLUMN / 2..self.plan.places).step_by(PLACES_PER_COLUMN) {
                let x = rack.x.start + index as f64 * self.plan.pitch;
                let column =
                    Convex::rectangle(x - COLUMN / 2.0..x + COLUMN / 2.0, middle - COLUMN / 2.0..middle + COLUMN / 2.0);
                self.site.solids.push(column.clone());
                self.site.state(column, About::Pillar { region: REGION });
            }
        }
        if self.plan.style.is_whole() {
            let up = rack.rows.iter().any(|row| row.up);
            let whole = Row { y: rack.y.clone(), up, layer: 0, slots: vec![Slot { x: rack.x.clone(), full: true }] };
            self.places(&whole, name);
        } else {
            for row in &rack.rows {
                let side = if row.up { "up" } else { "down" };
                self.places(row, &format!("{name}.{side}.{}", row.layer));
            }
        }
        self.site.bodies.push(body);
    }

    fn places(&mut self, row: &Row, name: &str) {
        for slot in &row.slots {
            let place = Place {
                region: REGION,
                row: name.to_owned(),
                content: if slot.full { Content::Box } else { Content::Nothing },
                front: row.layer,
                facing: if row.up { 1 } else { -1 },
                local: [slot.x.start, row.y.start, slot.x.end - slot.x.start, row.y.end - row.y.start],
            };
            self.site.state(Convex::rectangle(slot.x.clone(), row.y.clone()), About::Place(place));
        }
    }

    /// States the aisles beside racks.
    fn aisles(&mut self, stripes: &[Stripe], stands: &[Vec<bool>]) {
        let aisles = stripes.iter().enumerate().filter(|(_, stripe)| stripe.kind == StripeKind::Aisle);
        for (aisle, (index, stripe)) in aisles.enumerate() {
            for (segment, x) in self.plan.block_ranges().into_iter().enumerate() {
                let beside = stands[index.saturating_sub(1)..].iter().take(3);
                if beside.into_iter().any(|stands| stands[segment]) {
                    let shape = Convex::rectangle(x, stripe.y.clone());
                    self.site.state(shape, About::Corridor { region: REGION, aisle, segment });
                }
            }
        }
    }

    /// Builds offices beyond the right wall from the low corner on, each with a door to the hall.
    fn offices(&mut self, depth: f64) {
        let wall = self.plan.wall;
        let right = self.plan.length();
        let mut low = 0.0;
        for _ in 0..self.plan.offices {
            let [along, away] = OFFICE.map(|range| self.random.within(range));
            if low + along > depth {
                break;
            }
            let room = Convex::rectangle(right + wall..right + wall + away, low..low + along);
            let start = self.random.within(low + 0.3..low + along - DOOR - 0.3);
            self.site.floor.push(Convex::rectangle(right..right + wall, start..start + DOOR));
            self.site.floor.push(room.clone());
            self.site.state(room, About::Room);
            low += along + wall;
        }
    }
}
