//! The truth of a site, surveyed or generated.

use crate::geometry::{Point, Vector, polygon, ring_area};
use crate::grid::GridFrame;

/// An area of the map frame: one or more polygons, with or without holes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TrueArea {
    /// Outer rings counter-clockwise, holes clockwise, first points not repeated; metres.
    rings: Vec<Vec<Point>>,
}

impl TrueArea {
    /// An area from polygons that do not overlap; of each, the first ring is the outline and the others are holes.
    /// Rings may turn either way.
    #[must_use]
    pub fn new(polygons: Vec<Vec<Vec<Point>>>) -> Self {
        let turned = |(index, mut ring): (usize, Vec<Point>)| {
            let is_outline = index == 0;
            if (ring_area(&ring) > 0.0) != is_outline {
                ring.reverse();
            }
            ring
        };
        Self { rings: polygons.into_iter().flat_map(|polygon| polygon.into_iter().enumerate().map(turned)).collect() }
    }

    /// Square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        polygon::area(&self.rings)
    }

    /// Centre of mass; the mean of the points where there is no area.
    #[must_use]
    pub fn centroid(&self) -> Option<Point> {
        let mean = || {
            let points: Vec<&Point> = self.rings.iter().flatten().collect();
            let sum: Vector = points.iter().map(|point| point.coords).sum();
            (!points.is_empty()).then(|| Point::from(sum / points.len() as f64))
        };
        polygon::centroid(&self.rings).or_else(mean)
    }

    /// The rings in the grid frame of a map.
    pub(super) fn in_grid(&self, frame: &GridFrame) -> Vec<Vec<Point>> {
        self.rings.iter().map(|ring| ring.iter().map(|&point| frame.to_grid(point)).collect()).collect()
    }
}

/// A place for one pallet.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TruePlace {
    /// Where it is.
    pub area: TrueArea,
    /// Its part of the site, by name.
    pub region: String,
    /// Whether something stood there when the map was made.
    pub occupied: bool,
    /// Share of its surroundings that the robot saw, 0 to 1.
    pub observed: f64,
}

/// A part of the site whose rows share a direction.
#[derive(Debug, Clone, PartialEq)]
pub struct TrueRegion {
    /// Its name.
    pub name: String,
    /// Direction of its rows in the map frame, radians.
    pub angle: f64,
}

/// The truth of a site, in the map frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GroundTruth {
    /// Places for pallets.
    pub places: Vec<TruePlace>,
    /// Aisles that serve places.
    pub corridors: Vec<TrueArea>,
    /// Other floor to drive on.
    pub junctions: Vec<TrueArea>,
    /// Parts of the site with their directions.
    pub regions: Vec<TrueRegion>,
}
