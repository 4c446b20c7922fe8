//! Where a pose is: the ground under it, its face and place, the aisle with the bays beside it, the nearest location.
//!
//! Method: the face of the cell; the aisle whose strip holds the point, nearest to its middle line; the location whose border
//! is nearest. Cost: O(aisles + corners of the locations). Limits: beside a pose is what lies within the width of a location
//! along the aisle.

use crate::arrangement::FaceId;
use crate::geometry::{Point, direction, polygon, segment};
use crate::grid::Occupancy;
use crate::layout::{Aisle, Layout};
use crate::site_map::SiteMap;

/// What there is to say of a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Whereabouts {
    /// What the cell under it shows.
    pub ground: Occupancy,
    /// The face that holds it; `None` outside the decomposed part of the map.
    pub face: Option<FaceId>,
    /// The place of that face.
    pub place: Option<u32>,
    /// The aisle it is in.
    pub aisle: Option<AislePosition>,
    /// The nearest location; `None` in a map without locations.
    pub location: Option<NearestLocation>,
}

/// Where along an aisle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AislePosition {
    /// Index of the aisle.
    pub aisle: usize,
    /// Distance from its start along its middle line, metres.
    pub from_start: f64,
    /// Whether the pose looks along its direction rather than against it; `None` without a heading.
    pub is_along: Option<bool>,
    /// Index of the location to the left of the heading; `None` without a heading, and where there is none.
    pub left: Option<usize>,
    /// Index of the location to the right of the heading.
    pub right: Option<usize>,
}

/// The nearest location.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestLocation {
    /// Its index.
    pub location: usize,
    /// Distance from its border, metres; 0 inside.
    pub distance: f64,
}

/// Where a point is, and what lies beside a vehicle there that looks along `heading` (radians). Grid frame. `None` outside
/// the grid.
#[must_use]
pub fn whereabouts(map: &SiteMap<'_>, layout: &Layout, point: Point, heading: Option<f64>) -> Option<Whereabouts> {
    let (column, row) = map.grid.cell_at(point)?;
    let face = Some(map.cells.at(column, row)).filter(|&face| face != FaceId::OUTER);
    let location = nearest_location(layout, point);
    let inside =
        location.filter(|nearest| nearest.distance == 0.0).map(|nearest| layout.locations[nearest.location].aisle);
    let aisle = aisle_at(layout, point).or_else(|| layout.aisles.iter().position(|aisle| Some(aisle.number) == inside));
    Some(Whereabouts {
        ground: map.grid.row(row)[column],
        face,
        place: face.and_then(|face| map.semantic.face_places.get(face.index()).copied().flatten()),
        aisle: aisle.map(|aisle| along_aisle(layout, aisle, point, heading)),
        location,
    })
}

/// The location whose border is nearest to a point; the first of equals.
#[must_use]
pub fn nearest_location(layout: &Layout, point: Point) -> Option<NearestLocation> {
    let distance = |outline: &Vec<Point>| {
        let rings = std::slice::from_ref(outline);
        if polygon::contains(rings, point) {
            return 0.0;
        }
        polygon::sides(rings).map(|side| segment::distance(point, side)).fold(f64::INFINITY, f64::min)
    };
    let locations = layout.locations.iter().enumerate();
    let all = locations.map(|(location, place)| NearestLocation { location, distance: distance(&place.outline) });
    all.min_by(|one, other| one.distance.total_cmp(&other.distance))
}

/// The aisle whose strip holds a point: of several, that with the nearest middle line.
fn aisle_at(layout: &Layout, point: Point) -> Option<usize> {
    let holds = |(_, aisle): &(usize, &Aisle)| polygon::contains(&[aisle.outline()], point);
    let near = |aisle: &Aisle| segment::distance(point, aisle.center_line);
    let inside = layout.aisles.iter().enumerate().filter(holds);
    inside.min_by(|one, other| near(one.1).total_cmp(&near(other.1))).map(|(index, _)| index)
}

fn along_aisle(layout: &Layout, index: usize, point: Point, heading: Option<f64>) -> AislePosition {
    let aisle = &layout.aisles[index];
    let along = direction(aisle.heading());
    let abscissa = |at: Point| along.dot(&(at - aisle.center_line[0]));
    let at = abscissa(point);
    let beside = |locations: &[usize]| {
        let offset = |&location: &usize| {
            let place = &layout.locations[location];
            let offset = (abscissa(place.front.unwrap_or(place.center)) - at).abs();
            (place.depth_in_row == 1 && offset <= place.width).then_some((location, offset))
        };
        locations.iter().filter_map(offset).min_by(|one, other| one.1.total_cmp(&other.1)).map(|(location, _)| location)
    };
    let is_along = heading.map(|heading| along.dot(&direction(heading)) >= 0.0);
    let (left, right) = match is_along {
        None => (None, None),
        Some(true) => (beside(&aisle.left), beside(&aisle.right)),
        Some(false) => (beside(&aisle.right), beside(&aisle.left)),
    };
    AislePosition { aisle: index, from_start: at.clamp(0.0, aisle.length()), is_along, left, right }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::semantics::RuleSet;
    use crate::semantics::pictures::DrawnMap;

    #[test]
    fn a_pose_in_an_aisle_sees_the_bays_beside_it() {
        let map = DrawnMap::new(
            "
            ########
            ########
            ........
            ........
            ........
            ########
            ########
            ",
            "
            ppqqppqq
            ppqqppqq
            cccccccc
            cccccccc
            cccccccc
            ppqqppqq
            ppqqppqq
            ",
        );
        let semantic = map.semantic(&RuleSet::warehouse());
        let (site, layout) = (map.site(&semantic), map.layout(&semantic));
        let at = |x: f64, y: f64, heading| whereabouts(&site, &layout, Point::new(x, y), heading);
        let code = |location: Option<usize>| location.map(|index| layout.locations[index].code.as_str());

        let here = at(1.6, 1.75, Some(0.1)).expect("it is in the map");
        let aisle = here.aisle.expect("it is in the aisle");
        assert_eq!((here.ground, aisle.is_along), (Occupancy::Free, Some(true)));
        assert_eq!((code(aisle.left), code(aisle.right)), (Some("01-003"), Some("01-004")));
        assert!((aisle.from_start - 1.6).abs() < 1e-9);
        let back = at(1.6, 1.75, Some(PI)).and_then(|here| here.aisle).expect("it is in the aisle");
        assert_eq!((code(back.left), code(back.right)), (Some("01-004"), Some("01-003")));
        let silent = at(1.6, 1.75, None).and_then(|here| here.aisle).expect("it is in the aisle");
        assert_eq!((silent.is_along, silent.left, silent.right), (None, None, None));

        let inside = at(3.5, 3.0, None).expect("it is in the map");
        let nearest = inside.location.expect("there are locations");
        assert_eq!((inside.ground, nearest.distance), (Occupancy::Occupied, 0.0));
        assert_eq!((code(Some(nearest.location)), inside.aisle.is_some()), (Some("01-007"), true));
        assert_eq!(at(-1.0, 0.0, None), None);
    }
}
