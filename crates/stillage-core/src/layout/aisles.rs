//! Numbers of aisles and bays.
//!
//! Method: the fronts (best access edges) of all locations are grouped by direction, and within a direction by the
//! drivable place before them. Sorted across that direction, the fronts of one aisle are first those on its right side,
//! then those on its left; the next aisle begins after a left side that is followed by a right one, or where two fronts
//! of the same side are too far apart. So one drivable place that joins many corridors is still cut into its aisles.
//!
//! Aisles are numbered by direction, then from the bottom (or the left) of the map; bays by their position along the
//! aisle's direction, which points to the right (or up). Source: warehouse practice (odd left, even right); the
//! grouping is our own. Cost: O(n log n) for n locations. Limits: directions closer than [`SAME_DIRECTION`] are one; a
//! curved aisle is cut into several.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use super::access::{Access, BestAccess};
use super::location::Side;
use crate::arrangement::FaceId;
use crate::geometry::{Point, direction, fold_half_turn, normal};
use crate::semantics::SemanticMap;

/// Largest step between neighbouring directions of one group, radians: half the smallest angle between two dominant
/// orientations (6 degrees by default).
const SAME_DIRECTION: f64 = PI / 60.0;
/// Greatest distance across an aisle between two fronts on the same side of it, metres: between those of two aisles lie
/// a place (at least 0.8 m deep) and the narrowest aisle (1.2 m).
const NEXT_AISLE_M: f64 = 2.0;
/// Greatest offset between aisles in one line, metres: less than half the narrowest aisle (1.2 m).
const SAME_LINE_M: f64 = 0.5;

/// The number of one location.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Slot {
    /// From 1; 0 without access.
    pub aisle: u32,
    /// From 1: odd on the left, even on the right; consecutive in aisle 0.
    pub bay: u32,
    /// `None` without access.
    pub side: Option<Side>,
}

/// One location at its aisle.
#[derive(Debug, Clone, Copy)]
struct Front {
    /// Index of the location.
    location: usize,
    face: FaceId,
    middle: Point,
    /// Into the location, radians.
    heading: f64,
    /// The drivable place before it.
    place: u32,
}

/// Fronts along one aisle.
struct Aisle {
    /// Where the aisle points, radians.
    angle: f64,
    fronts: Vec<Front>,
}

/// Gives every location its number.
pub(super) fn number(semantic: &SemanticMap, accesses: &[Access]) -> Vec<Slot> {
    let front = |(location, access): (usize, &Access)| {
        let BestAccess { from, middle, .. } = access.best?;
        let place = semantic.face_places[from.index()]?;
        Some(Front { location, face: access.face, middle, heading: access.heading, place })
    };
    let fronts: Vec<Front> = accesses.iter().enumerate().filter_map(front).collect();
    let aisles: Vec<Aisle> = by_direction(fronts).into_iter().flat_map(aisles_along).collect();

    let mut slots = vec![Slot { aisle: 0, bay: 0, side: None }; accesses.len()];
    for (index, aisle) in aisles.iter().enumerate() {
        for (location, side, bay) in aisle.bays() {
            slots[location] = Slot { aisle: index as u32 + 1, bay, side: Some(side) };
        }
    }
    number_the_rest(accesses, &mut slots);
    slots
}

/// Counts the locations without an aisle from the bottom of the map, then from the left.
fn number_the_rest(accesses: &[Access], slots: &mut [Slot]) {
    let mut rest: Vec<usize> = (0..slots.len()).filter(|&location| slots[location].side.is_none()).collect();
    let center = |location: usize| accesses[location].center;
    rest.sort_by(|&first, &second| {
        let (first_center, second_center) = (center(first), center(second));
        let upwards = first_center.y.total_cmp(&second_center.y);
        upwards.then(first_center.x.total_cmp(&second_center.x)).then(first.cmp(&second))
    });
    for (index, location) in rest.into_iter().enumerate() {
        slots[location].bay = index as u32 + 1;
    }
}

/// Turns an undirected angle so that it points to the right, or else up: into `[-pi/4, 3 pi/4)`.
fn right_or_up(angle: f64) -> f64 {
    fold_half_turn(angle - FRAC_PI_4) + FRAC_PI_4
}

/// Groups fronts by the direction they run along, ascending from right to up.
fn by_direction(mut fronts: Vec<Front>) -> Vec<(f64, Vec<Front>)> {
    // Angles are measured from the middle of the widest gap between them, so that no group is cut in two.
    let mut angles: Vec<f64> = fronts.iter().map(Front::line_angle).collect();
    angles.sort_by(f64::total_cmp);
    let gaps = (0..angles.len()).map(|index| match angles.get(index + 1) {
        Some(next) => (next - angles[index], angles[index]),
        None => (angles[0] + PI - angles[index], angles[index]),
    });
    let widest = gaps.max_by(|first, second| first.0.total_cmp(&second.0));
    let Some((gap, before)) = widest else { return Vec::new() };
    let seam = before + gap / 2.0;
    let from_seam = |front: &Front| (front.line_angle() - seam).rem_euclid(PI);

    fronts.sort_by(|first, second| from_seam(first).total_cmp(&from_seam(second)));
    let groups = fronts.chunk_by(|first, second| from_seam(second) - from_seam(first) <= SAME_DIRECTION);
    let mut directions: Vec<(f64, Vec<Front>)> = groups
        .map(|group| {
            let mean = group.iter().map(from_seam).sum::<f64>() / group.len() as f64;
            (right_or_up(seam + mean), group.to_vec())
        })
        .collect();
    directions.sort_by(|first, second| first.0.total_cmp(&second.0));
    directions
}

/// Cuts fronts of one direction into aisles, ascending from the bottom or the left of the map; aisles in one line
/// follow each other in their direction.
fn aisles_along((angle, fronts): (f64, Vec<Front>)) -> Vec<Aisle> {
    let mut by_place: BTreeMap<u32, Vec<Front>> = BTreeMap::new();
    for front in fronts {
        by_place.entry(front.place).or_default().push(front);
    }
    let mut aisles: Vec<Aisle> = by_place.into_values().flat_map(|fronts| aisles_of_place(angle, fronts)).collect();
    let across = right_or_up(angle + FRAC_PI_2);
    sort_along(&mut aisles, across);
    let across = direction(across);
    for line in aisles.chunk_by_mut(|first, second| across.dot(&(second.center() - first.center())) <= SAME_LINE_M) {
        sort_along(line, angle);
    }
    aisles
}

fn sort_along(aisles: &mut [Aisle], angle: f64) {
    let position = |aisle: &Aisle| direction(angle).dot(&aisle.center().coords);
    aisles.sort_by(|first, second| {
        position(first).total_cmp(&position(second)).then(first.first_face().cmp(&second.first_face()))
    });
}

/// Cuts the fronts of one place where, going across, the next aisle begins.
fn aisles_of_place(angle: f64, fronts: Vec<Front>) -> Vec<Aisle> {
    let mut place = Aisle { angle, fronts };
    // The mean direction of the place: over 100 m, an error of one degree would mix neighbouring aisles.
    place.angle += place.mean(|front| fold_half_turn(front.line_angle() - angle));
    let Aisle { angle, mut fronts } = place;
    let offset = |front: &Front| normal(angle).dot(&front.middle.coords);
    fronts.sort_by(|first, second| offset(first).total_cmp(&offset(second)).then(first.face.cmp(&second.face)));

    let mut aisles: Vec<Aisle> = Vec::new();
    // Offsets of the last right and the last left front of the current aisle.
    let mut last: [Option<f64>; 2] = [None; 2];
    for front in fronts {
        let (is_left, at) = (front.side(angle) == Side::Left, offset(&front));
        let same_side = usize::from(is_left);
        let follows_the_left = !is_left && last[1].is_some();
        let is_far = last[same_side].is_some_and(|last| at - last > NEXT_AISLE_M);
        if aisles.is_empty() || follows_the_left || is_far {
            aisles.push(Aisle { angle, fronts: Vec::new() });
            last = [None; 2];
        }
        last[same_side] = Some(at);
        aisles.last_mut().expect("an aisle was begun for the first front").fronts.push(front);
    }
    aisles
}

impl Front {
    /// Direction of the access edge, undirected, radians in `[-pi/2, pi/2)`.
    fn line_angle(&self) -> f64 {
        fold_half_turn(self.heading + FRAC_PI_2)
    }

    fn side(&self, aisle_angle: f64) -> Side {
        if direction(self.heading).dot(&normal(aisle_angle)) > 0.0 { Side::Left } else { Side::Right }
    }
}

impl Aisle {
    fn mean(&self, value: impl Fn(&Front) -> f64) -> f64 {
        self.fronts.iter().map(value).sum::<f64>() / self.fronts.len() as f64
    }

    /// Mean of the middles of its fronts.
    fn center(&self) -> Point {
        Point::new(self.mean(|front| front.middle.x), self.mean(|front| front.middle.y))
    }

    fn first_face(&self) -> Option<FaceId> {
        self.fronts.iter().map(|front| front.face).min()
    }

    /// (location, side, bay) of every front: odd numbers on the left, even ones on the right, along the aisle.
    fn bays(&self) -> Vec<(usize, Side, u32)> {
        let along = direction(self.angle);
        let mut fronts: Vec<&Front> = self.fronts.iter().collect();
        fronts.sort_by(|first, second| {
            let abscissa = |front: &Front| along.dot(&front.middle.coords);
            abscissa(first).total_cmp(&abscissa(second)).then(first.face.cmp(&second.face))
        });
        let (mut next_left, mut next_right) = (1, 2);
        let mut number = |front: &Front| {
            let side = front.side(self.angle);
            let next = if side == Side::Left { &mut next_left } else { &mut next_right };
            let bay = *next;
            *next += 2;
            (front.location, side, bay)
        };
        fronts.into_iter().map(&mut number).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::line_angle_between;

    fn front(heading_degrees: f64, place: u32, x: f64, y: f64) -> Front {
        Front { location: 0, face: FaceId(1), middle: Point::new(x, y), heading: heading_degrees.to_radians(), place }
    }

    #[test]
    fn directions_that_differ_by_noise_are_one_also_where_angles_wrap() {
        for middle in [-135.0_f64, -90.0, -45.0, 0.0, 45.0, 90.0, 135.0, 180.0] {
            let fronts = [-1.0, 0.0, 1.0].map(|noise| front(middle + noise, 0, 0.0, 0.0)).to_vec();
            let groups = by_direction(fronts);
            assert_eq!(groups.len(), 1, "around {middle} degrees");
            assert!(line_angle_between(groups[0].0, (middle + 90.0).to_radians()) < 1e-9);
        }
    }

    #[test]
    fn aisles_point_to_the_right_or_up() {
        let angle = |heading| by_direction(vec![front(heading, 0, 0.0, 0.0)])[0].0.to_degrees().round() as i32;
        assert_eq!([0.0, 90.0, 180.0, -90.0, 120.0, 60.0].map(angle), [90, 0, 90, 0, 30, -30]);
    }

    #[test]
    fn slanted_aisles_of_one_place_stay_apart() {
        // At 30 degrees, with fronts 3 m apart across each aisle and 6 m from aisle to aisle.
        let (along, across) = (direction(PI / 6.0), normal(PI / 6.0));
        let at = |heading, offset: f64, abscissa: f64| {
            let middle = across * offset + along * abscissa;
            front(heading, 0, middle.x, middle.y)
        };
        let fronts = (0..3)
            .flat_map(|aisle| {
                [(-60.0, 0.0), (120.0, 3.0)].map(|(heading, side)| (heading, f64::from(aisle) * 6.0 + side))
            })
            .flat_map(|(heading, offset)| (0..4).map(move |bay| at(heading, offset, f64::from(bay))))
            .collect();
        let groups = by_direction(fronts);
        assert_eq!(groups.len(), 1);
        let aisles = aisles_along(groups[0].clone());
        assert_eq!(aisles.len(), 3);
        for aisle in aisles {
            let mut bays: Vec<u32> = aisle.bays().into_iter().map(|(_, _, bay)| bay).collect();
            bays.sort_unstable();
            assert_eq!(bays, (1..=8).collect::<Vec<_>>());
        }
    }

    #[test]
    fn no_fronts_have_no_direction() {
        assert!(by_direction(Vec::new()).is_empty());
    }
}
