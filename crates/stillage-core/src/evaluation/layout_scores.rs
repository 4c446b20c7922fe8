//! How well the storage layout of a map fits the truth of its site.
//!
//! | figure | meaning |
//! | --- | --- |
//! | found | share of the places that one location fits (intersection over union above one half), and in which no other location has its centre |
//! | false | locations that fit no true place |
//! | order | agreement of the codes along an aisle with the true places along it: Kendall's tau (M. Kendall 1938, doi 10.1093/biomet/30.1-2.81), 1 where they agree |
//! | standing | share of the locations with an approach pose that is drivable: on a drivable face, clear of obstacles by the radius |
//! | reachable | share of the locations in the largest set of which each can be reached from each |
//!
//! Places count that the robot saw by half or more. Codes are compared as text, among the locations of one side of an aisle
//! that lie at the aisle and fit a true place; the aisle may count from either end, on both sides alike. Cost: that of routes
//! from one location to all. Limits: which true places lie along one aisle is taken from the layout.

use super::evaluator::OBSERVED;
use super::overlap::{Match, ShapeAreas};
use super::truth::GroundTruth;
use crate::geometry::{Point, Vector, direction, line_angle_between, polygon};
use crate::layout::{Aisle, Layout, Location, Side};
use crate::routing::{Router, Waypoint};
use crate::site_map::SiteMap;
use crate::watch::{Stopped, Watch};

/// How the codes of one aisle follow its true places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AisleOrder {
    /// Number of the aisle.
    pub aisle: u32,
    /// Pairs of codes that were compared.
    pub pairs: usize,
    /// Kendall's tau over them, -1 to 1.
    pub tau: f64,
}

/// How well a layout fits the truth. See the table of [`LayoutScores::of`]'s module.
#[derive(Debug, Clone, PartialEq)]
pub struct LayoutScores {
    /// True places that count.
    pub places: usize,
    /// How many of them exactly one location fits.
    pub found: usize,
    /// Locations.
    pub locations: usize,
    /// Locations that fit no true place.
    pub false_locations: usize,
    /// Aisles along which two or more codes can be compared.
    pub orders: Vec<AisleOrder>,
    /// Locations with an approach pose.
    pub approaches: usize,
    /// Locations with an approach pose that is drivable.
    pub standing: usize,
    /// Locations in the largest set of which each can be reached from each.
    pub reachable: usize,
}

impl LayoutScores {
    /// Compares a layout with the truth, for the vehicles of a router.
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    pub fn of(
        map: &SiteMap<'_>,
        layout: &Layout,
        router: &Router,
        truth: &GroundTruth,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let fits = fits(map, layout, truth, watch)?;
        let is_drivable = |location: &&Location| {
            location.approach.is_some_and(|pose| {
                map.is_drivable(map.face_at(pose.position)) && map.clearance.at(pose.position) >= router.radius()
            })
        };
        Ok(Self {
            places: fits.counted,
            found: fits.found,
            locations: layout.locations.len(),
            false_locations: fits.place_of.iter().filter(|place| place.is_none()).count(),
            orders: layout.aisles.iter().filter_map(|aisle| order(map, layout, aisle, truth, &fits.place_of)).collect(),
            approaches: layout.locations.iter().filter(|location| location.approach.is_some()).count(),
            standing: layout.locations.iter().filter(is_drivable).count(),
            reachable: reachable(map, layout, router, watch)?,
        })
    }
}

/// Which locations fit which places.
struct Fits {
    counted: usize,
    found: usize,
    /// By location: the true place that it fits.
    place_of: Vec<Option<usize>>,
}

fn fits(map: &SiteMap<'_>, layout: &Layout, truth: &GroundTruth, watch: &Watch<'_>) -> Result<Fits, Stopped> {
    let shapes = ShapeAreas::of(layout.locations.iter().map(|location| vec![location.outline.clone()]).collect());
    let mut fits = Fits { counted: 0, found: 0, place_of: vec![None; layout.locations.len()] };
    for (index, place) in truth.places.iter().enumerate() {
        watch.check()?;
        let rings = place.area.in_grid(&map.analysis.frame);
        let overlaps = shapes.overlaps(&rings);
        let inside =
            |&&(location, _): &&(u32, f64)| polygon::contains(&rings, layout.locations[location as usize].center);
        let centres = overlaps.iter().filter(inside).count();
        let fitting = Match { area: place.area.area(), holder: None, overlaps }.fitting(&shapes.areas);
        if let Some(location) = fitting {
            fits.place_of[location as usize] = Some(index);
        }
        if place.observed >= OBSERVED {
            fits.counted += 1;
            fits.found += usize::from(fitting.is_some() && centres <= 1);
        }
    }
    Ok(fits)
}

/// The order of the codes along an aisle; `None` without a pair to compare.
fn order(
    map: &SiteMap<'_>,
    layout: &Layout,
    aisle: &Aisle,
    truth: &GroundTruth,
    place_of: &[Option<usize>],
) -> Option<AisleOrder> {
    let (mut pairs, mut sum) = (0_usize, 0_i64);
    for side in [Side::Left, Side::Right] {
        let listed = if side == Side::Left { &aisle.left } else { &aisle.right };
        let at_aisle = listed.iter().filter(|&&location| layout.locations[location].depth_in_row == 1);
        let mut places: Vec<(&str, f64)> = at_aisle
            .filter_map(|&location| {
                let along = true_direction(map, aisle, truth, place_of[location]?);
                let center = map.analysis.frame.to_grid(truth.places[place_of[location]?].area.centroid()?);
                Some((layout.locations[location].code.as_str(), along.dot(&(center - Point::origin()))))
            })
            .collect();
        places.sort_by(|one, other| one.0.cmp(other.0));
        for (index, (_, before)) in places.iter().enumerate() {
            for (_, behind) in &places[index + 1..] {
                pairs += 1;
                sum += if behind > before { 1 } else { -1 };
            }
        }
    }
    // An aisle may be counted from either end.
    (pairs > 0).then(|| AisleOrder { aisle: aisle.number, pairs, tau: sum.unsigned_abs() as f64 / pairs as f64 })
}

/// The true direction of a place's row, turned to point with the aisle; that of the aisle where the truth tells none.
fn true_direction(map: &SiteMap<'_>, aisle: &Aisle, truth: &GroundTruth, place: usize) -> Vector {
    let region = truth.regions.iter().find(|region| region.name == truth.places[place].region);
    let heading = aisle.heading();
    let angle = region.map(|region| region.angle - map.analysis.frame.yaw);
    // A row is named by either of its two directions.
    let angle = angle.filter(|&angle| line_angle_between(angle, heading) < std::f64::consts::FRAC_PI_4);
    let along = direction(angle.unwrap_or(heading));
    if along.dot(&direction(heading)) < 0.0 { -along } else { along }
}

/// The size of the largest set of locations of which each can be reached from each.
fn reachable(map: &SiteMap<'_>, layout: &Layout, router: &Router, watch: &Watch<'_>) -> Result<usize, Stopped> {
    let mut open: Vec<&Location> = layout.locations.iter().collect();
    let mut largest = 0;
    while open.len() > largest {
        watch.check()?;
        let ends: Vec<Waypoint<'_>> = open.iter().map(|&location| Waypoint::Location(location)).collect();
        let lengths = router.matrix(map, &ends[..1], &ends).swap_remove(0);
        let set = lengths.iter().filter(|length| length.is_some()).count();
        largest = largest.max(set);
        // The first one is done even where nothing stands before it.
        let missed = open.iter().zip(&lengths).skip(1).filter(|(_, length)| length.is_none());
        open = missed.map(|(&location, _)| location).collect();
    }
    Ok(largest)
}
