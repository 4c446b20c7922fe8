//! The scanner, and the map that is made of its scans.
//!
//! Each beam is followed through a grid of half the map's cells, its length is blurred, and it updates the log-odds of
//! the cells that the robot believes it to have passed (H. Moravec and A. Elfes, *High resolution maps from wide angle
//! sonar*, ICRA 1985, doi 10.1109/ROBOT.1985.1087316), with the usual weights of 2D mapping. The map is trinary, as
//! `map_saver` writes it.
//!
//! Beams are cast on the caller's rayon pool, each pose with random numbers of its own; the map is updated in the order
//! of the poses, for sums that stop at a limit depend on the order. Cost: O(poses x beams x length in cells).

use rayon::prelude::*;
use stillage_core::geometry::direction;

use crate::drive::Scan;
use crate::random::Random;
use crate::raster::{Lattice, Obstacles, Walk};

/// Log-odds of a hit and of a pass, and their limit, as 2D mappers use them.
const HIT: f32 = 0.9;
const PASS: f32 = -0.35;
const LIMIT: f32 = 5.0;
/// Above this probability a cell is occupied, below the other it is free (`map_saver`'s defaults).
const OCCUPIED: f32 = 0.65;
const FREE: f32 = 0.196;
/// Beams shorter than this end in the robot itself, metres.
const SHORTEST: f64 = 0.05;

/// The grey of a cell in a trinary map.
pub(crate) mod grey {
    /// Occupied.
    pub(crate) const OCCUPIED: u8 = 0;
    /// Unknown.
    pub(crate) const UNKNOWN: u8 = 205;
    /// Free.
    pub(crate) const FREE: u8 = 254;
}

/// A lidar scanner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scanner {
    /// Field of view about the heading, degrees.
    pub(crate) field_of_view: u32,
    pub(crate) beams_per_degree: f64,
    /// Range, metres.
    pub(crate) range: f64,
    /// Standard deviation of a length, metres.
    pub(crate) noise: f64,
    /// Share of the beams that do not come back.
    pub(crate) lost: f64,
    /// Share of the beams that something passing by cuts short.
    pub(crate) cut: f64,
}

/// What came back of a beam.
#[derive(Debug, Clone, Copy)]
enum Echo {
    /// From a distance, metres.
    Hit(f64),
    /// From nowhere within the range.
    Nothing,
    /// The beam was lost.
    Lost,
}

impl Scanner {
    /// Directions of the beams from the heading, radians.
    fn angles(&self) -> Vec<f64> {
        let count = (f64::from(self.field_of_view) * self.beams_per_degree) as usize;
        let half = f64::from(self.field_of_view).to_radians() / 2.0;
        (0..count).map(|beam| -half + beam as f64 * 2.0 * half / count as f64).collect()
    }

    /// Casts the beams of one scan.
    fn cast(&self, scan: &Scan, angles: &[f64], obstacles: &Obstacles, random: &mut Random) -> Vec<Echo> {
        let mut echo = |&angle: &f64| {
            let luck = random.unit();
            if luck < self.lost {
                return Echo::Lost;
            }
            match obstacles.beam(scan.truth.position, direction(scan.truth.heading + angle), self.range) {
                None => Echo::Nothing,
                Some(length) if luck > 1.0 - self.cut => Echo::Hit(length * random.unit()),
                Some(length) => Echo::Hit(length + random.normal(self.noise)),
            }
        };
        angles.iter().map(&mut echo).collect()
    }

    /// Maps what is seen from the scans: greys of the cells, lowest row first.
    pub(crate) fn map(
        &self,
        scans: &[Scan],
        obstacles: &Obstacles,
        lattice: &Lattice,
        random: impl Fn(usize) -> Random + Sync,
    ) -> Vec<u8> {
        let angles = self.angles();
        let echoes: Vec<Vec<Echo>> = scans
            .par_iter()
            .enumerate()
            .map(|(index, scan)| self.cast(scan, &angles, obstacles, &mut random(index)))
            .collect();
        let mut map = LogOdds { lattice: *lattice, cells: vec![0.0; lattice.width * lattice.height] };
        for (scan, echoes) in scans.iter().zip(&echoes) {
            for (&angle, &echo) in angles.iter().zip(echoes) {
                map.update(scan, angle, echo, self.range);
            }
        }
        map.greys()
    }
}

/// Log-odds that a cell is occupied.
struct LogOdds {
    lattice: Lattice,
    cells: Vec<f32>,
}

impl LogOdds {
    fn update(&mut self, scan: &Scan, angle: f64, echo: Echo, range: f64) {
        let (length, hit) = match echo {
            Echo::Lost => return,
            Echo::Nothing => (range, false),
            Echo::Hit(length) => (length, true),
        };
        if length < SHORTEST {
            return;
        }
        let along = direction(scan.belief.heading + angle);
        let from = self.lattice.in_cells(scan.belief.position);
        let length = length / self.lattice.resolution;
        let end = from + along * length;
        let end = (end.x.floor() as i64, end.y.floor() as i64);
        for (column, row, distance) in Walk::new(from, along) {
            if distance >= length || (column, row) == end {
                break;
            }
            let Some(cell) = self.lattice.index(column, row) else { break };
            self.cells[cell] = (self.cells[cell] + PASS).max(-LIMIT);
        }
        if let Some(cell) = self.lattice.index(end.0, end.1).filter(|_| hit) {
            self.cells[cell] = (self.cells[cell] + HIT).min(LIMIT);
        }
    }

    fn greys(&self) -> Vec<u8> {
        let log_odds = |probability: f32| (probability / (1.0 - probability)).ln();
        let (occupied, free) = (log_odds(OCCUPIED), log_odds(FREE));
        let grey = |&value: &f32| match value {
            value if value > occupied => grey::OCCUPIED,
            value if value < free => grey::FREE,
            _ => grey::UNKNOWN,
        };
        self.cells.iter().map(grey).collect()
    }
}
