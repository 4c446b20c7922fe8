//! The building: floor, walls, doors, columns, offices, and what lies about.

use std::ops::Range;

use stillage_core::geometry::Point;

use crate::random::Random;
use crate::shape::{Convex, Pose};
use crate::site::{About, Site};
use crate::storage::{Limits, StoragePlan};

/// Thickness of an outer wall, metres.
const WALL: f64 = 0.25;
/// Thickness of a wall between rooms, metres.
const PARTITION: f64 = 0.12;
/// Distance of the robot from the outer walls on its rounds, there and back, metres.
const ROUNDS: [f64; 2] = [1.4, 1.9];
/// Junctions narrower than this are rounding or gaps behind rows, metres.
const NARROWEST_JUNCTION: f64 = 0.2;
/// Side of a column, metres.
const COLUMN: Range<f64> = 0.3..0.5;

/// A rectangle of floor: ranges along x and y, metres.
#[derive(Debug, Clone)]
pub(crate) struct Floor {
    pub(crate) x: Range<f64>,
    pub(crate) y: Range<f64>,
}

impl Floor {
    fn shape(&self) -> Convex {
        Convex::rectangle(self.x.clone(), self.y.clone())
    }
}

/// Which wall of a rectangle of floor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Left,
    Right,
    Low,
}

/// A hall under construction, in a frame along its walls.
#[derive(Debug)]
pub(crate) struct Hall {
    site: Site,
    floors: Vec<Floor>,
    columns: Vec<Convex>,
    offices: Vec<Convex>,
}

impl Hall {
    /// A hall of rectangles that touch and do not overlap.
    pub(crate) fn new(floors: Vec<Floor>) -> Self {
        let site = Site { floor: floors.iter().map(Floor::shape).collect(), ..Site::default() };
        Self { site, floors, columns: Vec::new(), offices: Vec::new() }
    }

    /// Sets columns on a grid over the whole hall; before the storage, which gives way to them.
    pub(crate) fn add_columns(&mut self, random: &mut Random) {
        let side = random.within(COLUMN);
        let pitch = [random.within(5.5..9.0), random.within(5.0..9.0)];
        let first = pitch.map(|pitch| random.within(0.3..0.9) * pitch);
        for floor in &self.floors {
            let [along, across] = [(&floor.x, 0), (&floor.y, 1)].map(|(range, axis)| {
                let count = ((range.end - range.start - first[axis]) / pitch[axis]) as usize;
                let at = |index: usize| range.start + first[axis] + index as f64 * pitch[axis];
                (0..=count).map(at).collect::<Vec<_>>()
            });
            let centers = along.iter().flat_map(|&x| across.iter().map(move |&y| Point::new(x, y)));
            self.columns.extend(centers.map(|center| Convex::turned_box(center, [side, side], 0.0)));
        }
        for column in &self.columns {
            self.site.solids.push(column.clone());
            self.site.state(column.clone(), About::Pillar { region: 'A' });
        }
    }

    /// Builds storage at a pose, within an outline where there is one.
    pub(crate) fn store(&mut self, plan: &StoragePlan, pose: &Pose, outline: Option<&Convex>, random: &mut Random) {
        let limits = Limits {
            columns: self.columns.iter().map(|column| column.seen_from(pose)).collect(),
            outline: outline.map(|outline| outline.seen_from(pose)),
        };
        self.site.add(&plan.build(&limits, random), pose);
    }

    /// Puts doors into a wall of a rectangle of floor, where no rows stand before it.
    pub(crate) fn add_doors(&mut self, floor: usize, side: Side, count: usize, random: &mut Random) {
        let floor = self.floors[floor].clone();
        let wall = if side == Side::Low { floor.x.clone() } else { floor.y.clone() };
        let share = (wall.end - wall.start) / count as f64;
        for index in 0..count {
            let width = random.within(2.5..3.5).min(share - 0.5);
            let start = wall.start + index as f64 * share + random.within(0.2..share - width - 0.2);
            // A closed door lies a little back in its wall; behind an open one stands a trailer.
            let deep = if random.chance(0.3) { random.within(2.5..8.0) } else { random.within(0.08..0.2) };
            let opening = |from: f64, to: f64| match side {
                Side::Left => Convex::rectangle(floor.x.start - to..floor.x.start - from, start..start + width),
                Side::Right => Convex::rectangle(floor.x.end + from..floor.x.end + to, start..start + width),
                Side::Low => Convex::rectangle(start..start + width, floor.y.start - to..floor.y.start - from),
            };
            let before = opening(-1.0, 0.0);
            if self.site.bodies.iter().all(|body| body.overlap(&before) == 0.0) {
                self.site.floor.push(opening(0.0, deep));
            }
        }
    }

    /// Builds offices along the right wall from its lower corner on, with doors to the hall.
    pub(crate) fn add_offices(&mut self, depth: f64, rooms: usize, random: &mut Random) {
        let floor = self.floors[0].clone();
        let (left, right) = (floor.x.end - depth, floor.x.end);
        let mut low = floor.y.start;
        for _ in 0..rooms {
            let high = low + random.within(3.0..4.5);
            let door = random.within(low + 0.5..high - 1.8);
            let door = door..door + random.within(0.9..1.1);
            let front = left..left + PARTITION;
            for wall in [
                Convex::rectangle(front.clone(), low..door.start),
                Convex::rectangle(front, door.end..high),
                Convex::rectangle(left..right, high - PARTITION..high),
            ] {
                self.site.solids.push(wall.clone());
                self.site.state(wall, About::Wall);
            }
            let inside = Floor { x: left + PARTITION..right, y: low..high - PARTITION };
            self.site.state(inside.shape(), About::Room);
            self.furnish(&inside, random);
            let middle = f64::midpoint(door.start, door.end);
            let [outside, within] = [left - 1.5, f64::midpoint(left, right)].map(|x| Point::new(x, middle));
            let end = Point::new(within.x, f64::midpoint(low, high));
            self.site.routes.extend([[outside, within], [within, end], [end, within], [within, outside]]);
            self.offices.push(Convex::rectangle(left..right, low..high));
            low = high;
        }
    }

    /// Desks on legs with a drawer unit, along the wall that faces the door.
    fn furnish(&mut self, room: &Floor, random: &mut Random) {
        for _ in 0..random.count(1..3) {
            let center =
                Point::new(room.x.end - random.within(0.5..0.7), random.within(room.y.start + 0.9..room.y.end - 0.9));
            let pose = Pose { angle: 0.0, offset: center.coords };
            let legs = [(-0.35, -0.75), (0.35, -0.75), (-0.35, 0.75), (0.35, 0.75)];
            let leg = |(x, y): (f64, f64)| Convex::turned_box(pose.apply(Point::new(x, y)), [0.06, 0.06], 0.0);
            self.site.solids.extend(legs.map(leg));
            self.site.solids.push(Convex::turned_box(pose.apply(Point::new(0.1, 0.5)), [0.6, 0.4], 0.0));
        }
    }

    /// Leaves boxes and trucks about on open floor, so many per 100 square metres of the hall.
    pub(crate) fn add_clutter(&mut self, density: f64, random: &mut Random) {
        let taken: Vec<Convex> = self.taken().map(|shape| shape.grown(0.1)).collect();
        for floor in self.floors.clone() {
            let shape = floor.shape();
            for _ in 0..(density * shape.area() / 100.0).round() as usize {
                let center = Point::new(random.within(floor.x.clone()), random.within(floor.y.clone()));
                let size = [random.within(0.3..1.2), random.within(0.3..1.2)];
                let item = Convex::turned_box(center, size, random.within(0.0..1.5));
                if shape.covers(&item) && taken.iter().all(|taken| taken.overlap(&item) == 0.0) {
                    self.site.solids.push(item);
                }
            }
        }
    }

    /// Floor that is no junction.
    fn taken(&self) -> impl Iterator<Item = &Convex> {
        let corridors = self.site.shapes(|about| matches!(about, About::Corridor { .. }));
        self.site.bodies.iter().chain(corridors).chain(&self.offices)
    }

    /// Adds the rounds of the robot, and the truth of walls and junctions.
    pub(crate) fn finish(mut self) -> Site {
        let junctions: Vec<Convex> = self
            .floors
            .iter()
            .flat_map(|floor| floor.shape().minus_all(self.taken()))
            .filter(|piece| piece.narrowest() > NARROWEST_JUNCTION)
            .collect();
        let walls = self.site.walls(WALL);
        for shape in junctions {
            self.site.state(shape, About::Junction);
        }
        for shape in walls {
            self.site.state(shape, About::Wall);
        }
        for floor in &self.floors {
            let shape = floor.shape();
            let [there, back] = ROUNDS.map(|inset| shape.grown(-inset));
            let around = |ring: &Convex| {
                let points = ring.points();
                (0..points.len()).map(|index| [points[index], points[(index + 1) % points.len()]]).collect::<Vec<_>>()
            };
            self.site.routes.extend(around(&there));
            self.site.routes.extend(around(&back).iter().rev().map(|&[from, to]| [to, from]));
        }
        self.site
    }
}
