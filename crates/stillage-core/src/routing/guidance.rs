//! What to do along a route, and how long it takes.
//!
//! Turns of a path within a short way are one turn for a person. Time is that of a vehicle that stops wherever it turns
//! sharply, turns on the spot, and otherwise drives as fast as it may after speeding up. Cost: O(points of the path).

use std::f64::consts::PI;

use super::route::Route;
use crate::geometry::{Point, Vector};

/// Turns that are nearer to each other than this are one, metres: about the length of a vehicle.
const ONE_TURN_M: f64 = 1.5;
/// Turns by less than this are straight on, radians: 30 degrees.
const STRAIGHT_ON: f64 = PI / 6.0;
/// Turns by more than this lead back, radians: 150 degrees.
const BACK: f64 = 5.0 * PI / 6.0;
/// A vehicle stops to turn by more than this, radians: 20 degrees. Our choice.
const STOPS: f64 = PI / 9.0;

/// What to do at a point of a route.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// Begin to drive.
    Depart,
    /// Turn to the left.
    Left,
    /// Turn to the right.
    Right,
    /// Turn around.
    TurnAround,
    /// The goal.
    Arrive,
}

/// One step of turn-by-turn instructions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instruction {
    /// What to do.
    pub action: Action,
    /// Where, grid frame, metres.
    pub at: Point,
    /// Where to look afterwards, radians, grid frame.
    pub heading: f64,
    /// Way to the next instruction, metres; 0 at the goal.
    pub length: f64,
    /// Half way to the next instruction, grid frame, metres: the ground of this step is here.
    pub middle: Point,
}

/// How a vehicle drives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedProfile {
    /// Greatest speed, metres per second.
    pub speed: f64,
    /// Speeding up and braking, metres per second squared.
    pub acceleration: f64,
    /// Turning on the spot, radians per second.
    pub turn_rate: f64,
}

impl Default for SpeedProfile {
    /// A laden automated pallet truck: 1.5 m/s, 0.5 m/s2, 45 degrees per second. Typical figures of data sheets; not a
    /// measurement.
    fn default() -> Self {
        Self { speed: 1.5, acceleration: 0.5, turn_rate: PI / 4.0 }
    }
}

impl SpeedProfile {
    /// Time for a route, seconds.
    #[must_use]
    pub fn time(&self, route: &Route) -> f64 {
        let legs = legs(&route.path);
        let (mut time, mut run) = (0.0, 0.0);
        for (index, &(length, heading)) in legs.iter().enumerate() {
            run += length;
            let next = legs.get(index + 1).map(|next| next.1).or(route.goal_heading);
            let turn = next.map_or(0.0, |next| turn_between(heading, next).abs());
            if turn > STOPS || index + 1 == legs.len() {
                time +=
                    self.time_of_run(std::mem::take(&mut run)) + if turn > STOPS { turn / self.turn_rate } else { 0.0 };
            }
        }
        time
    }

    /// From standing to standing.
    fn time_of_run(&self, length: f64) -> f64 {
        let speeding_up = self.speed * self.speed / self.acceleration;
        if length < speeding_up {
            2.0 * (length / self.acceleration).sqrt()
        } else {
            length / self.speed + self.speed / self.acceleration
        }
    }
}

/// Length and heading of each leg that has a length.
fn legs(path: &[Point]) -> Vec<(f64, f64)> {
    let ways = path.windows(2).map(|pair| pair[1] - pair[0]).filter(|way| way.norm() > 0.0);
    ways.map(|way: Vector| (way.norm(), way.y.atan2(way.x))).collect()
}

/// The turn from a heading to another, to the left, radians in `[-pi, pi)`.
fn turn_between(from: f64, to: f64) -> f64 {
    (to - from + PI).rem_euclid(2.0 * PI) - PI
}

/// Turn-by-turn instructions for a route.
#[must_use]
pub fn instructions(route: &Route) -> Vec<Instruction> {
    let legs = legs(&route.path);
    let start = route.path[0];
    let heading = legs.first().map(|leg| leg.1).or(route.goal_heading).unwrap_or(0.0);
    let mut steps = vec![Instruction { action: Action::Depart, at: start, heading, length: 0.0, middle: start }];
    let mut at = start;
    // A turn that goes on: where it began, and by how much it has turned.
    let mut turn: Option<(Point, f64)> = None;
    for (index, &(length, heading)) in legs.iter().enumerate() {
        at += Vector::new(heading.cos(), heading.sin()) * length;
        if turn.is_some() && length > ONE_TURN_M {
            finish(&mut steps, turn.take(), heading);
        }
        if let Some(step) = steps.last_mut() {
            step.length += length;
        }
        if let Some(&(_, next)) = legs.get(index + 1) {
            let by = turn_between(heading, next);
            let (began, so_far) = turn.unwrap_or((at, 0.0));
            turn = Some((began, so_far + by));
        }
    }
    let heading = route.goal_heading.or(legs.last().map(|leg| leg.1)).unwrap_or(heading);
    steps.push(Instruction { action: Action::Arrive, at, heading, length: 0.0, middle: at });
    let mut passed = 0.0;
    for step in &mut steps {
        step.middle = point_at(&route.path, passed + step.length / 2.0);
        passed += step.length;
    }
    steps
}

/// The point of a path that is reached after a length, metres; its end beyond it.
fn point_at(path: &[Point], length: f64) -> Point {
    let mut left = length;
    for pair in path.windows(2) {
        let way = pair[1] - pair[0];
        let here = way.norm();
        if left < here {
            return pair[0] + way * (left / here);
        }
        left -= here;
    }
    path[path.len() - 1]
}

/// Adds a turn, where it is one.
fn finish(steps: &mut Vec<Instruction>, turn: Option<(Point, f64)>, heading: f64) {
    let Some((at, by)) = turn.filter(|(_, by)| by.abs() > STRAIGHT_ON) else { return };
    let action = match by {
        by if by.abs() > BACK => Action::TurnAround,
        by if by > 0.0 => Action::Left,
        _ => Action::Right,
    };
    // The way through the turn was counted to the step before it.
    steps.push(Instruction { action, at, heading, length: 0.0, middle: at });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn route(path: &[(f64, f64)]) -> Route {
        let path: Vec<Point> = path.iter().map(|&(x, y)| Point::new(x, y)).collect();
        let length = path.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        Route { path, length, faces: Vec::new(), edges: Vec::new(), clearance: 1.0, goal_heading: None }
    }

    #[test]
    fn a_rounded_corner_is_one_turn() {
        let route = route(&[(0.0, 0.0), (8.0, 0.0), (8.7, 0.3), (9.0, 1.0), (9.0, 6.0), (2.0, 6.0)]);
        let steps: Vec<(Action, f64)> =
            instructions(&route).iter().map(|step| (step.action, (step.length * 10.0).round() / 10.0)).collect();
        let expected = [(Action::Depart, 9.5), (Action::Left, 5.0), (Action::Left, 7.0), (Action::Arrive, 0.0)];
        assert_eq!(steps, expected);
    }

    #[test]
    fn the_middle_of_a_step_lies_on_the_path() {
        let steps = instructions(&route(&[(0.0, 0.0), (8.0, 0.0), (8.7, 0.3), (9.0, 1.0), (9.0, 7.0)]));
        let middles: Vec<Point> = steps.iter().map(|step| step.middle).collect();
        assert!((middles[0] - Point::new(4.76, 0.0)).norm() < 0.01, "{middles:?}");
        assert!((middles[1] - Point::new(9.0, 4.0)).norm() < 1e-9, "{middles:?}");
        assert!((middles[2] - Point::new(9.0, 7.0)).norm() < 1e-9, "{middles:?}");
    }

    #[test]
    fn a_way_back_is_told() {
        let steps = instructions(&route(&[(0.0, 0.0), (5.0, 0.0), (2.0, 0.0)]));
        assert_eq!(steps[1].action, Action::TurnAround);
        assert_eq!(steps[2].action, Action::Arrive);
        assert!((steps[2].at - Point::new(2.0, 0.0)).norm() < 1e-12);
    }

    #[test]
    fn time_counts_speeding_up_and_turning() {
        let profile = SpeedProfile { speed: 2.0, acceleration: 1.0, turn_rate: PI / 2.0 };
        assert_eq!(profile.time(&route(&[(0.0, 0.0), (10.0, 0.0)])), 10.0 / 2.0 + 2.0);
        assert_eq!(profile.time(&route(&[(0.0, 0.0), (1.0, 0.0)])), 2.0);
        let around_a_corner = profile.time(&route(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)]));
        assert!((around_a_corner - 15.0).abs() < 1e-12, "{around_a_corner}");
    }
}
