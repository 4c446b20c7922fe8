//! A zoo of sites: generated warehouses of many kinds, as a robot would map them, with their truth.
//!
//! A method tuned on one generator reads that generator, so this one is written for variety: each [`Kind`] stands for
//! a trait of real sites, and everything that its name leaves open (sizes, pallets, loads, aisles, scanner, drive, turn
//! of the hall in the map) is drawn from plausible ranges by the seed. The same kind, seed and options give the same
//! bytes, on any number of threads.
//!
//! ```text
//! kind ── compose ── style ── storage ─┐
//!                      pallet ─────────┴─ hall ── Site ── drive ── scanner ── Sample
//!                                                   └─────────────── truth ────┘
//! ```
//!
//! [`draw`] makes a second zoo, of plain drawings: what CAD exports, simulators and cleaned-up scans look like. Nothing is
//! simulated there; a [`DrawingStyle`] says what is drawn of the storage.
//!
//! ```text
//! style, seed ── plan ── Site ──┬── ink ── paint ── Sample
//!                               └──────── truth ─────┘
//! ```
//!
//! Cost: the scanner's, a second or so for a map of 50 m x 35 m. Limits: walls and columns are straight and square;
//! nothing moves; no aisle is curved.

mod compose;
mod drawing;
mod drive;
mod hall;
mod kind;
mod pallet;
mod picture;
mod random;
mod raster;
mod sample;
mod scanner;
mod shape;
mod site;
mod storage;
mod style;
mod truth;

#[cfg(test)]
mod tests;

use std::f64::consts::{FRAC_PI_4, PI};

pub use drawing::{DrawingMeta, DrawingOptions, DrawingStyle, Outside, draw};
pub use kind::Kind;
pub use sample::Sample;
pub use truth::{Feature, Geometry, Meta, Properties, Truth};

use drive::{Drift, STEP};
use random::{Purpose, Random};
use raster::{Lattice, Obstacles};
use scanner::{Scanner, grey};
use shape::Pose;
use site::Site;

/// Unknown room around a hall, metres.
const MARGIN: f64 = 1.5;

/// What to make of a kind and a seed; what is absent is drawn by the seed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Side of a cell, metres.
    pub resolution: f64,
    /// Share of the cells turned to salt or pepper, 0 to 1.
    pub speckle: f64,
    /// Turn of the hall in the map, degrees.
    pub rotation_deg: Option<f64>,
    /// Field of view of the scanner, degrees.
    pub field_of_view: Option<u32>,
    /// Share of the pallets that show a load instead of legs, 0 to 1.
    pub boxes: Option<f64>,
    /// The robot knows exactly where it is: the map is not bent.
    pub exact_poses: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            resolution: 0.05,
            speckle: 0.0,
            rotation_deg: None,
            field_of_view: None,
            boxes: None,
            exact_poses: false,
        }
    }
}

/// Generates a map.
#[must_use]
pub fn generate(kind: Kind, seed: u64, options: &Options) -> Sample {
    let mut random = Random::new(kind, seed, Purpose::Site);
    let composition = compose::compose(kind, options.boxes, &mut random);
    let turn = random.within(-FRAC_PI_4..FRAC_PI_4);
    let turn = options.rotation_deg.map_or(turn, f64::to_radians);
    let pose = Pose::new(turn, random.within(-20.0..20.0), random.within(-20.0..20.0));
    let mut site = Site::default();
    site.add(&composition.site, &pose);
    let shut = composition.shut.map(|shut| shut.placed(&pose));

    let mut random = Random::new(kind, seed, Purpose::Drive);
    let scanner = Scanner {
        field_of_view: random.pick([270, 360]),
        beams_per_degree: 2.0,
        range: composition.sight,
        noise: random.within(0.008..0.025),
        lost: random.within(0.0..0.04),
        cut: random.within(0.0..0.003),
    };
    let scanner = Scanner { field_of_view: options.field_of_view.unwrap_or(scanner.field_of_view), ..scanner };
    let drift = Drift { position: random.within(0.005..0.035), heading: random.within(0.02..0.08_f64).to_radians() };
    let drift = if options.exact_poses { Drift::NONE } else { drift };
    let lattice = Lattice::around(&site.floor, MARGIN, options.resolution);
    let obstacles = Obstacles::new(lattice.halved(), &site.floor, &site.solids);
    let scans = drive::drive(&site.routes, &obstacles, shut.as_ref(), drift, &mut random);
    let mut greys = scanner.map(&scans, &obstacles, &lattice, |pose| Random::new(kind, seed, Purpose::Beams(pose)));

    let truth = Truth::new(&site.truth, |place| truth::known_rim(place, &lattice, &greys));
    let known = greys.iter().filter(|&&cell| cell != grey::UNKNOWN).count() as f64 / greys.len().max(1) as f64;
    let per_region = truth.places_by_region();
    speckle(&mut greys, options.speckle, &mut Random::new(kind, seed, Purpose::Speckle));
    let meta = Meta {
        kind: kind.to_string(),
        seed,
        size: "zoo",
        sensor: sensor(&truth),
        difficulty: kind.to_string(),
        resolution: options.resolution,
        fov: scanner.field_of_view,
        beams_per_degree: scanner.beams_per_degree,
        step: STEP,
        max_range: truth::rounded(scanner.range, 3),
        rotation_deg: truth::rounded(turn * 180.0 / PI, 4),
        speckle: options.speckle,
        width: lattice.width,
        height: lattice.height,
        pallets: per_region.values().sum(),
        known: truth::rounded(known, 4),
        per_region,
        poses: scans.len(),
    };
    Sample { meta, truth, lattice, greys, facts: site.truth }
}

/// Turns a share of the cells to occupied or free, one as often as the other.
fn speckle(greys: &mut [u8], share: f64, random: &mut Random) {
    if share > 0.0 {
        for cell in greys {
            if random.chance(share) {
                *cell = random.pick([grey::OCCUPIED, grey::FREE]);
            }
        }
    }
}

/// What the pallets of a site show, in one word.
fn sensor(truth: &Truth) -> &'static str {
    let shows = |wanted: &str| {
        truth
            .features
            .iter()
            .any(|feature| matches!(&feature.properties, Properties::Pallet { kind, .. } if *kind == wanted))
    };
    match (shows("box"), shows("pallet")) {
        (true, true) => "both",
        (true, false) => "articles",
        _ => "footprints",
    }
}
