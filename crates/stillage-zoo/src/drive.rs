//! The robot's drive: poses along the routes, and where the robot believes them to be.

use stillage_core::geometry::{Point, direction};

use crate::random::Random;
use crate::raster::Obstacles;
use crate::shape::Convex;

/// Distance between two scans, metres.
pub(crate) const STEP: f64 = 0.4;
/// Room that a robot needs around its middle, metres.
const CLEARANCE: f64 = 0.3;
/// Length over which the errors of poses stay alike, metres: between two corrections by a map matcher.
const CORRELATION: f64 = 15.0;
/// How far a robot leaves its line, metres, and its heading, radians (standard deviations).
const WOBBLE: [f64; 2] = [0.05, 0.02];

/// A position and a heading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Station {
    pub(crate) position: Point,
    pub(crate) heading: f64,
}

/// Where a scan is taken, and where the robot believes to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scan {
    pub(crate) truth: Station,
    pub(crate) belief: Station,
}

/// Standard deviations of the believed position (metres) and heading (radians).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Drift {
    pub(crate) position: f64,
    pub(crate) heading: f64,
}

impl Drift {
    /// The robot knows where it is.
    pub(crate) const NONE: Self = Self { position: 0.0, heading: 0.0 };
}

/// Drives the routes, leaving out what is blocked or shut.
pub(crate) fn drive(
    routes: &[[Point; 2]],
    obstacles: &Obstacles,
    shut: Option<&Convex>,
    drift: Drift,
    random: &mut Random,
) -> Vec<Scan> {
    // Ornstein and Uhlenbeck's process, sampled: an error that wanders and comes back.
    let keep = (-STEP / CORRELATION).exp();
    let fresh = (1.0 - keep * keep).sqrt();
    let mut error = [(); 3].map(|()| random.normal(1.0));
    let mut scans = Vec::new();
    for &[from, to] in routes {
        let way = to - from;
        let heading = way.y.atan2(way.x);
        let steps = (way.norm() / STEP).floor().max(1.0) as usize;
        for step in 0..=steps {
            let on_line = from + way * (step as f64 / steps as f64);
            let [x, y] = [(); 2].map(|()| random.normal(WOBBLE[0]));
            let position = Point::new(on_line.x + x, on_line.y + y);
            let truth = Station { position, heading: heading + random.normal(WOBBLE[1]) };
            error = error.map(|error| keep * error + fresh * random.normal(1.0));
            if !is_free(position, obstacles) || shut.is_some_and(|shut| shut.contains(position)) {
                continue;
            }
            let [x, y, turn] = error;
            let position = Point::new(position.x + x * drift.position, position.y + y * drift.position);
            scans.push(Scan { truth, belief: Station { position, heading: truth.heading + turn * drift.heading } });
        }
    }
    scans
}

/// Whether a robot fits here.
fn is_free(position: Point, obstacles: &Obstacles) -> bool {
    let around = (0..8).map(|eighth| position + direction(f64::from(eighth) * std::f64::consts::FRAC_PI_4) * CLEARANCE);
    std::iter::once(position).chain(around).all(|point| !obstacles.at(point))
}
