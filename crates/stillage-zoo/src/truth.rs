//! The truth as GeoJSON, and what is told about a map beside it.
//!
//! Metres of the map frame; `properties.label` is `pallet`, `corridor`, `junction`, `wall`, `pillar`, `room` or
//! `region`. A place tells which share of a rim around it was seen: the paper leaves margins out that are explored in
//! part (section III).

use std::collections::BTreeMap;

use serde::Serialize;

use crate::raster::Lattice;
use crate::scanner::grey;
use crate::shape::Convex;
use crate::site::{About, Content, Fact};

/// Width of the rim around a place whose explored share is told, metres.
const RIM: f64 = 0.35;

/// A GeoJSON feature collection.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Truth {
    #[serde(rename = "type")]
    kind: &'static str,
    /// One for each place, corridor and so on.
    pub features: Vec<Feature>,
}

/// A GeoJSON feature.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Feature {
    #[serde(rename = "type")]
    kind: &'static str,
    /// What is true.
    pub properties: Properties,
    /// Where.
    pub geometry: Geometry,
}

/// A GeoJSON polygon without holes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Geometry {
    #[serde(rename = "type")]
    kind: &'static str,
    /// Its ring, counter-clockwise, first point repeated; metres of the map frame.
    pub coordinates: [Vec<[f64; 2]>; 1],
}

/// What is true of a polygon.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "label", rename_all = "lowercase")]
pub enum Properties {
    /// A place for one pallet.
    Pallet {
        /// Number of the place within the site.
        id: usize,
        /// Name of its region.
        region: String,
        /// Its row, in words.
        row: String,
        /// Whether something stands on it.
        occupied: bool,
        /// What stands there: `none`, `box` or `pallet` (legs).
        kind: &'static str,
        /// Places between it and its aisle.
        front: usize,
        /// Side of the row on which its aisle lies: 1 or -1.
        facing: i8,
        /// Lower corner, width and depth in the frame of the region, metres.
        local: [f64; 4],
        /// Explored share of a rim around it.
        observed: f64,
    },
    /// An aisle between two cross aisles.
    Corridor {
        /// Name of its region.
        region: String,
        /// Number of the aisle within the region.
        aisle: usize,
        /// Number of the stretch of the aisle.
        seg: usize,
    },
    /// Floor to drive on that serves no place.
    Junction {},
    /// A wall.
    Wall {},
    /// A column of the building.
    Pillar {
        /// Name of a region.
        region: String,
    },
    /// The floor of an office.
    Room {},
    /// Storage of one direction and pitch.
    Region {
        /// Its name.
        region: String,
        /// Direction of its rows in the map frame, degrees in (-90, 90].
        angle_deg: f64,
        /// Width of a place, metres.
        pitch: f64,
        /// Depth of a place, metres.
        depth: f64,
    },
}

/// What a map was made from.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Meta {
    /// Kind of the site.
    pub kind: String,
    /// Seed of everything.
    pub seed: u64,
    /// Size group, for tools that sort by it: all sites of the zoo are one.
    pub size: &'static str,
    /// What pallets show: `articles`, `footprints` or `both`.
    pub sensor: &'static str,
    /// Difficulty group, for tools that sort by it: the kind.
    pub difficulty: String,
    /// Side of a cell, metres.
    pub resolution: f64,
    /// Field of view of the scanner, degrees.
    pub fov: u32,
    /// Beams of the scanner.
    pub beams_per_degree: f64,
    /// Distance between two scans, metres.
    pub step: f64,
    /// Range of the scanner, metres.
    pub max_range: f64,
    /// Turn of the hall in the map, degrees.
    pub rotation_deg: f64,
    /// Share of the cells turned to salt or pepper.
    pub speckle: f64,
    /// Columns of the map.
    pub width: usize,
    /// Rows of the map.
    pub height: usize,
    /// Number of places.
    pub pallets: usize,
    /// Share of the cells that are known, before any speckle.
    pub known: f64,
    /// Places by region.
    pub per_region: BTreeMap<String, usize>,
    /// Scans taken.
    pub poses: usize,
}

impl Truth {
    /// The facts of a site; `observed` says which share of the surroundings of a place the map shows.
    pub(crate) fn new(facts: &[Fact], observed: impl Fn(&Convex) -> f64) -> Self {
        let mut places = 0;
        let feature = |fact: &Fact| {
            let properties = properties(fact, &mut places, &observed);
            Feature { kind: "Feature", properties, geometry: geometry(&fact.shape) }
        };
        Self { kind: "FeatureCollection", features: facts.iter().map(feature).collect() }
    }

    /// Places by region; the usual three are always named.
    #[must_use]
    pub fn places_by_region(&self) -> BTreeMap<String, usize> {
        let mut counts: BTreeMap<String, usize> = ["A", "B", "C"].map(|name| (name.to_owned(), 0)).into();
        for feature in &self.features {
            if let Properties::Pallet { region, .. } = &feature.properties {
                *counts.entry(region.clone()).or_default() += 1;
            }
        }
        counts
    }
}

fn properties(fact: &Fact, places: &mut usize, observed: impl Fn(&Convex) -> f64) -> Properties {
    match &fact.about {
        About::Place(place) => {
            let id = *places;
            *places += 1;
            Properties::Pallet {
                id,
                region: place.region.to_string(),
                row: place.row.clone(),
                occupied: place.content != Content::Nothing,
                kind: match place.content {
                    Content::Nothing => "none",
                    Content::Box => "box",
                    Content::Pallet => "pallet",
                },
                front: place.front,
                facing: place.facing,
                local: place.local.map(|value| rounded(value, 3)),
                observed: rounded(observed(&fact.shape), 3),
            }
        }
        &About::Corridor { region, aisle, segment } => {
            Properties::Corridor { region: region.to_string(), aisle, seg: segment }
        }
        About::Junction => Properties::Junction {},
        About::Wall => Properties::Wall {},
        About::Pillar { region } => Properties::Pillar { region: region.to_string() },
        About::Room => Properties::Room {},
        &About::Region { name, angle, pitch, depth } => Properties::Region {
            region: name.to_string(),
            angle_deg: rounded(stillage_core::geometry::fold_half_turn(angle).to_degrees(), 4),
            pitch: rounded(pitch, 4),
            depth: rounded(depth, 4),
        },
    }
}

fn geometry(shape: &Convex) -> Geometry {
    let points = shape.points();
    let ring = points.iter().chain(points.first()).map(|point| [rounded(point.x, 4), rounded(point.y, 4)]).collect();
    Geometry { kind: "Polygon", coordinates: [ring] }
}

/// The known share of a rim around a place.
pub(crate) fn known_rim(place: &Convex, lattice: &Lattice, greys: &[u8]) -> f64 {
    let (mut known, mut all) = (0_usize, 0_usize);
    let around = place.grown(RIM);
    lattice.for_each_cell(&around, |cell| {
        let (column, row) = (cell % lattice.width, cell / lattice.width);
        let offset = stillage_core::Vector::new(column as f64 + 0.5, row as f64 + 0.5) * lattice.resolution;
        if !place.contains(lattice.origin + offset) {
            all += 1;
            known += usize::from(greys[cell] != grey::UNKNOWN);
        }
    });
    known as f64 / all.max(1) as f64
}

/// A number with so many decimals; no minus zero.
pub(crate) fn rounded(value: f64, decimals: i32) -> f64 {
    let scale = 10_f64.powi(decimals);
    (value * scale).round() / scale + 0.0
}
