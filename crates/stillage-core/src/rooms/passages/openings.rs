//! Where the sides and the ends of a strip are open.

use super::super::ground::{Jambs, RoomGround};
use super::strip::PassageStrip;
use crate::geometry::{Point, Vector, direction, normal};
use crate::runs::runs_where;

/// A side is open where there is no wall up to this far out of the strip, metres: jambs are thinner.
const BESIDE_M: f64 = 0.3;
/// What lies beside an opening is looked up this far out of the strip, metres.
const OUTSIDE_M: f64 = 0.5;
/// An opening that reaches the end of a strip goes on to a jamb within this length, metres: that of the widest front of a
/// room. No measurement is recorded for this value.
const BEYOND_M: f64 = 6.0;
/// Greatest width of an arm in widths of its passage.
const ARM_WIDTHS: f64 = 1.25;
/// Greatest area of an arm in that of a strip as wide as its opening: walls are rough.
const ARM_AREA: f64 = 1.4;
/// A hall begins where the ground before the end of a strip is free this far ahead and across, in widths of the strip.
/// No measurement is recorded for this value.
const HALL_WIDTHS: f64 = 3.0;

/// An opening of a passage.
pub(super) struct Opening {
    /// Column and row of the cells where it begins and ends.
    pub jambs: Jambs,
    /// Number of the passage.
    pub passage: usize,
    /// Whether it is on the left side of the direction of the passage.
    pub is_left: bool,
    /// Whether it is at an end of the passage instead of a side.
    pub is_end: bool,
    /// A point beside it, out of the passage, metres.
    pub outside: Point,
    /// Width of the passage there, metres.
    pub passage_width: f64,
    /// The direction out of the passage.
    pub way: Vector,
}

impl Opening {
    /// Whether the room beside it, with an area in square metres, is an arm of the passage: no wider than that, and no wider
    /// than the opening.
    pub(super) fn leads_into_arm(&self, ground: &RoomGround, area: f64, is_room: impl Fn(usize) -> bool) -> bool {
        let [from, to] = self.jambs.map(|cell| ground.middle_of(cell));
        let (width, middle) = ((to - from).norm(), nalgebra::center(&from, &to));
        let place = |step: usize| middle + self.way * (step as f64 * ground.cell);
        let beside = ground.cells_of(OUTSIDE_M);
        let is_in = |&step: &usize| ground.cell_at(place(step)).is_some_and(&is_room);
        let depth = (beside..ground.is_free.len()).find(|step| !is_in(step)).unwrap_or(beside);
        width <= ARM_WIDTHS * self.passage_width && area <= ARM_AREA * width * depth as f64 * ground.cell
    }
}

/// Adds the openings of a strip, and pairs of neighbouring cells of its walls; `number` is that of the strip.
pub(super) fn find(
    ground: &RoomGround,
    strip: &PassageStrip,
    number: usize,
    openings: &mut Vec<Opening>,
    walls: &mut Vec<Jambs>,
) {
    let frame = Frame { ground, angle: strip.angle };
    for side in [0, 1] {
        let out = if side == 0 { -ground.cell } else { ground.cell };
        let jamb = |place: f64, sides: [f64; 2], from: i64| {
            let steps = from..=ground.cells_of(BESIDE_M) as i64;
            steps
                .map(|step| frame.cell_at(place, sides[side] + out * (step as f64 - 0.5)))
                .find(|&cell| frame.is_closed(cell))
        };
        let jambs: Vec<Option<[i64; 2]>> = strip.lines.iter().map(|&(place, sides)| jamb(place, sides, 0)).collect();
        walls.extend(jambs.windows(2).filter_map(|pair| Some([pair[0]?, pair[1]?])));
        let beyond = |line: usize, way: f64| {
            let (place, sides) = strip.lines[line];
            let places = (1..=ground.cells_of(BEYOND_M)).map(|step| place + way * step as f64 * ground.cell);
            places
                .into_iter()
                .find_map(|place| jamb(place, sides, -2))
                .unwrap_or_else(|| frame.cell_at(place, sides[side]))
        };
        for run in runs_where(jambs.len(), |line| jambs[line].is_none()) {
            let before = run.start.checked_sub(1).and_then(|line| jambs[line]);
            let after = jambs.get(run.end).copied().flatten();
            let jambs =
                [before.unwrap_or_else(|| beyond(run.start, -1.0)), after.unwrap_or_else(|| beyond(run.end - 1, 1.0))];
            let [from, to] = jambs.map(|cell| ground.middle_of(cell));
            let way = normal(strip.angle) * out.signum();
            let outside = nalgebra::center(&from, &to) + way * OUTSIDE_M;
            let sides = strip.lines[run.start].1;
            let passage_width = sides[1] - sides[0];
            openings.push(Opening {
                jambs,
                passage: number,
                is_left: side == 1,
                is_end: false,
                outside,
                passage_width,
                way,
            });
        }
    }
    for (line, way) in [(0, -1.0), (strip.lines.len() - 1, 1.0)] {
        let (place, sides) = strip.lines[line];
        if frame.is_hall(place, sides, way) {
            let jambs = [(0, -1.0), (1, 1.0)].map(|(side, out)| {
                let steps = (0..=2 * ground.cells_of(BESIDE_M)).map(|step| out * (step as f64 - 0.5) * ground.cell);
                let mut cells = steps.map(|step| frame.cell_at(place, sides[side] + step));
                cells.find(|&cell| frame.is_closed(cell)).unwrap_or_else(|| frame.cell_at(place, sides[side]))
            });
            let ahead = place + way * OUTSIDE_M;
            let outside = frame.point_at(ahead, f64::midpoint(sides[0], sides[1]));
            let (passage_width, way) = (sides[1] - sides[0], direction(strip.angle) * way);
            openings.push(Opening { jambs, passage: number, is_left: true, is_end: true, outside, passage_width, way });
        }
    }
}

/// The ground along a direction, `angle` in radians, and across it.
struct Frame<'a> {
    ground: &'a RoomGround,
    angle: f64,
}

impl Frame<'_> {
    fn point_at(&self, along: f64, across: f64) -> Point {
        Point::from(direction(self.angle) * along + normal(self.angle) * across)
    }

    fn cell_at(&self, along: f64, across: f64) -> [i64; 2] {
        self.ground.place_of(self.point_at(along, across))
    }

    fn is_closed(&self, [column, row]: [i64; 2]) -> bool {
        !self.ground.holds(column, row)
    }

    /// Whether a hall begins at an end of a strip, given by its place and its sides, ahead in a `way` of 1 or -1.
    fn is_hall(&self, place: f64, sides: [f64; 2], way: f64) -> bool {
        let (middle, width) = (f64::midpoint(sides[0], sides[1]), sides[1] - sides[0]);
        let steps = |to: f64| (1..=(to / self.ground.cell) as usize).map(|step| step as f64 * self.ground.cell);
        let is_free = |ahead: f64, aside: f64| !self.is_closed(self.cell_at(place + way * ahead, middle + aside));
        let reach = HALL_WIDTHS * width;
        let across: usize = [-1.0, 1.0]
            .map(|side| steps(reach).take_while(|aside| is_free(width / 2.0, side * aside)).count())
            .iter()
            .sum();
        // A door ahead of it lets one of three lines through, a table leaves two of them.
        let goes_on = |aside: &f64| steps(reach).all(|ahead| is_free(ahead, aside * width));
        [-0.25, 0.0, 0.25].iter().filter(|aside| goes_on(aside)).count() >= 2
            && across as f64 * self.ground.cell >= reach
    }
}
