//! How far locations lie from the places that they stand for.

use std::f64::consts::{FRAC_PI_2, PI};

use stillage_core::geometry::{OrientedBox, Point, Vector, line_angle_between, ring_area};
use stillage_core::layout::Location;
use stillage_core::{Analysis, OccupancyGrid};
use stillage_zoo::{Properties, Truth};

use crate::sites;

/// A location stands for a place whose area is at most so many times smaller or larger.
const ALIKE: f64 = 2.0;
/// Angle above which one sees that a heading is wrong, radians.
const ASLANT: f64 = 5.0 * PI / 180.0;

/// One location beside its place.
#[derive(Debug, Clone, Copy)]
pub struct LocationError {
    /// Distance of the centres, metres.
    pub center: f64,
    /// Angle between the direction into the location and that across the row, radians. Which of the two sides is the front
    /// is not asked: a row may have an aisle on both.
    pub heading: f64,
}

/// How many locations of a map head aslant to their own oriented box, by more than [`ASLANT`], and how many there are.
pub fn aslant(grid: &OccupancyGrid, analysis: &Analysis) -> [usize; 2] {
    let locations = sites::locations(grid, analysis);
    let is_aslant = |location: &&Location| {
        let corners: Vec<Point> = analysis.subdivision.rings(location.face).concat();
        let along = OrientedBox::smallest_around(&corners).angle;
        let error = line_angle_between(location.heading, along);
        error.min(FRAC_PI_2 - error) > ASLANT
    };
    [locations.iter().filter(is_aslant).count(), locations.len()]
}

/// The errors of all locations that stand for a place.
pub fn of(grid: &OccupancyGrid, analysis: &Analysis, truth: &Truth) -> Vec<LocationError> {
    let angle = truth.features.iter().find_map(|feature| match feature.properties {
        Properties::Region { angle_deg, .. } => Some(angle_deg.to_radians()),
        _ => None,
    });
    let across = angle.unwrap_or(0.0) + FRAC_PI_2;
    let places: Vec<(Point, f64)> = truth
        .features
        .iter()
        .filter(|feature| matches!(feature.properties, Properties::Pallet { .. }))
        .map(|feature| {
            let ring: Vec<Point> = feature.geometry.coordinates[0].iter().map(|&[x, y]| Point::new(x, y)).collect();
            let corners = &ring[1..];
            let middle = corners.iter().map(|point| point.coords).sum::<Vector>() / corners.len() as f64;
            (Point::from(middle), ring_area(corners))
        })
        .collect();
    let error = |location: &Location| {
        let center = analysis.frame.to_map(location.center);
        let distance = |place: &(Point, f64)| (place.0 - center).norm();
        let place = places.iter().min_by(|one, other| distance(one).total_cmp(&distance(other)))?;
        let ratio = location.width * location.depth / place.1;
        let is_alike = (1.0 / ALIKE..ALIKE).contains(&ratio) && distance(place) < place.1.sqrt() / 2.0;
        let heading = line_angle_between(analysis.frame.angle_to_map(location.heading), across);
        is_alike.then(|| LocationError { center: distance(place), heading })
    };
    sites::locations(grid, analysis).iter().filter_map(error).collect()
}
