//! Which fronts lie along one aisle, and in which order the aisles are counted.
//!
//! Method: the fronts of all locations are grouped by direction, and within a direction by the drivable place before
//! them. Sorted across that direction, the fronts of one aisle are first those on its right side, then those on its left;
//! the next aisle begins after a left side that is followed by a right one, or where two fronts of the same side are too
//! far apart. So one drivable place that joins many corridors is still cut into its aisles. Aisles are numbered by
//! direction, then from the bottom (or the left) of the map, or from the entrance where one is given; they point right or
//! up, or away from the entrance. Source: warehouse practice; the grouping is our own. Cost: O(n log n) for n locations.
//! Limits: directions closer than [`SAME_DIRECTION`] are one; a curved aisle is cut into several.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use super::location::Side;
use crate::geometry::{Point, direction, fold_half_turn, normal};

/// Largest step between neighbouring directions of one group, radians: half the smallest angle between two dominant
/// orientations (6 degrees by default).
const SAME_DIRECTION: f64 = PI / 60.0;
/// Greatest distance across an aisle between two fronts on the same side of it, metres: between those of two aisles lie
/// a place (at least 0.8 m deep) and the narrowest aisle (1.2 m).
const NEXT_AISLE_M: f64 = 2.0;
/// Greatest offset between aisles in one line, metres: less than half the narrowest aisle (1.2 m).
const SAME_LINE_M: f64 = 0.5;

/// The front of one location at its aisle.
#[derive(Debug, Clone, Copy)]
pub(super) struct AisleFront {
    /// Index of the location.
    pub location: usize,
    pub middle: Point,
    /// Into the location, radians.
    pub heading: f64,
    /// The drivable place before it.
    pub place: u32,
}

/// Fronts along one aisle.
pub(super) struct FrontLine {
    /// Where the aisle points, radians.
    pub angle: f64,
    /// The drivable place it runs through.
    pub place: u32,
    pub fronts: Vec<AisleFront>,
}

/// Groups fronts into aisles, in the order of their numbers.
pub(super) fn aisles_of(fronts: Vec<AisleFront>, entrance: Option<Point>) -> Vec<FrontLine> {
    by_direction(fronts).into_iter().flat_map(|group| aisles_along(group, entrance)).collect()
}

/// Turns an undirected angle so that it points to the right, or else up: into `[-pi/4, 3 pi/4)`.
fn right_or_up(angle: f64) -> f64 {
    fold_half_turn(angle - FRAC_PI_4) + FRAC_PI_4
}

/// Groups fronts by the direction they run along, ascending from right to up.
fn by_direction(mut fronts: Vec<AisleFront>) -> Vec<(f64, Vec<AisleFront>)> {
    // Angles are measured from the middle of the widest gap between them, so that no group is cut in two.
    let mut angles: Vec<f64> = fronts.iter().map(AisleFront::line_angle).collect();
    angles.sort_by(f64::total_cmp);
    let gaps = (0..angles.len()).map(|index| match angles.get(index + 1) {
        Some(next) => (next - angles[index], angles[index]),
        None => (angles[0] + PI - angles[index], angles[index]),
    });
    let widest = gaps.max_by(|first, second| first.0.total_cmp(&second.0));
    let Some((gap, before)) = widest else { return Vec::new() };
    let seam = before + gap / 2.0;
    let from_seam = |front: &AisleFront| (front.line_angle() - seam).rem_euclid(PI);

    fronts.sort_by(|first, second| from_seam(first).total_cmp(&from_seam(second)));
    let groups = fronts.chunk_by(|first, second| from_seam(second) - from_seam(first) <= SAME_DIRECTION);
    let mut directions: Vec<(f64, Vec<AisleFront>)> = groups
        .map(|group| {
            let mean = group.iter().map(from_seam).sum::<f64>() / group.len() as f64;
            (right_or_up(seam + mean), group.to_vec())
        })
        .collect();
    directions.sort_by(|first, second| first.0.total_cmp(&second.0));
    directions
}

/// Cuts fronts of one direction into aisles, ascending from the bottom or the left of the map, or from the side that is
/// nearer to the entrance; aisles in one line follow each other in their direction.
fn aisles_along((angle, fronts): (f64, Vec<AisleFront>), entrance: Option<Point>) -> Vec<FrontLine> {
    let mut by_place: BTreeMap<u32, Vec<AisleFront>> = BTreeMap::new();
    for front in fronts {
        by_place.entry(front.place).or_default().push(front);
    }
    let cut = |(place, fronts): (u32, Vec<AisleFront>)| aisles_of_place(angle, place, fronts);
    let mut aisles: Vec<FrontLine> = by_place.into_iter().flat_map(cut).collect();
    let (across, along) = (right_or_up(angle + FRAC_PI_2), right_or_up(angle));
    sort_along(&mut aisles, across);
    let axis = direction(across);
    for line in aisles.chunk_by_mut(|first, second| axis.dot(&(second.center() - first.center())) <= SAME_LINE_M) {
        sort_along(line, along);
    }
    if let Some(entrance) = entrance {
        begin_at(&mut aisles, entrance, [along, across]);
    }
    aisles
}

/// Turns the order of aisles, and each aisle, so that they begin at the side of the entrance.
fn begin_at(aisles: &mut [FrontLine], entrance: Point, [along, across]: [f64; 2]) {
    let is_past_the_middle = |angle: f64, points: &mut dyn Iterator<Item = Point>| {
        let places: Vec<f64> = points.map(|point| direction(angle).dot(&point.coords)).collect();
        let low = places.iter().copied().fold(f64::INFINITY, f64::min);
        let high = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        direction(angle).dot(&entrance.coords) > f64::midpoint(low, high)
    };
    if is_past_the_middle(across, &mut aisles.iter().map(FrontLine::center)) {
        aisles.reverse();
    } else if is_past_the_middle(along, &mut aisles.iter().map(FrontLine::center)) {
        // Aisles in one line are counted from the entrance, too.
        let axis = direction(across);
        for line in aisles.chunk_by_mut(|first, second| axis.dot(&(second.center() - first.center())) <= SAME_LINE_M) {
            line.reverse();
        }
    }
    for aisle in aisles {
        if is_past_the_middle(aisle.angle, &mut aisle.fronts.iter().map(|front| front.middle)) {
            aisle.angle += PI;
        }
    }
}

fn sort_along(aisles: &mut [FrontLine], angle: f64) {
    let position = |aisle: &FrontLine| direction(angle).dot(&aisle.center().coords);
    aisles.sort_by(|first, second| {
        position(first).total_cmp(&position(second)).then(first.first_location().cmp(&second.first_location()))
    });
}

/// Cuts the fronts of one place where, going across, the next aisle begins.
fn aisles_of_place(angle: f64, place: u32, fronts: Vec<AisleFront>) -> Vec<FrontLine> {
    let mut whole = FrontLine { angle, place, fronts };
    // The mean direction of the place: over 100 m, an error of one degree would mix neighbouring aisles.
    whole.angle += whole.mean(|front| fold_half_turn(front.line_angle() - angle));
    let FrontLine { angle, mut fronts, .. } = whole;
    let offset = |front: &AisleFront| normal(angle).dot(&front.middle.coords);
    fronts.sort_by(|first, second| offset(first).total_cmp(&offset(second)).then(first.location.cmp(&second.location)));

    let mut aisles: Vec<FrontLine> = Vec::new();
    // Offsets of the last right and the last left front of the current aisle.
    let mut last: [Option<f64>; 2] = [None; 2];
    for front in fronts {
        let (is_left, at) = (front.side(angle) == Side::Left, offset(&front));
        let same_side = usize::from(is_left);
        let follows_the_left = !is_left && last[1].is_some();
        let is_far = last[same_side].is_some_and(|last| at - last > NEXT_AISLE_M);
        if aisles.is_empty() || follows_the_left || is_far {
            aisles.push(FrontLine { angle, place, fronts: Vec::new() });
            last = [None; 2];
        }
        last[same_side] = Some(at);
        aisles.last_mut().expect("an aisle was begun for the first front").fronts.push(front);
    }
    aisles
}

impl AisleFront {
    /// Direction of the access edge, undirected, radians in `[-pi/2, pi/2)`.
    fn line_angle(&self) -> f64 {
        fold_half_turn(self.heading + FRAC_PI_2)
    }

    /// Its side of an aisle that points somewhere.
    pub fn side(&self, aisle_angle: f64) -> Side {
        if direction(self.heading).dot(&normal(aisle_angle)) > 0.0 { Side::Left } else { Side::Right }
    }
}

impl FrontLine {
    /// Mean of a value of its fronts.
    pub fn mean(&self, value: impl Fn(&AisleFront) -> f64) -> f64 {
        self.fronts.iter().map(value).sum::<f64>() / self.fronts.len() as f64
    }

    /// Mean of the middles of its fronts.
    fn center(&self) -> Point {
        Point::new(self.mean(|front| front.middle.x), self.mean(|front| front.middle.y))
    }

    fn first_location(&self) -> Option<usize> {
        self.fronts.iter().map(|front| front.location).min()
    }

    /// How far along the aisle a front lies, metres.
    pub fn abscissa(&self, front: &AisleFront) -> f64 {
        direction(self.angle).dot(&front.middle.coords)
    }

    /// The fronts on one side, along the aisle.
    pub fn side(&self, side: Side) -> Vec<AisleFront> {
        let mut fronts: Vec<AisleFront> =
            self.fronts.iter().copied().filter(|front| front.side(self.angle) == side).collect();
        fronts.sort_by(|first, second| {
            self.abscissa(first).total_cmp(&self.abscissa(second)).then(first.location.cmp(&second.location))
        });
        fronts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::line_angle_between;

    fn front(heading_degrees: f64, x: f64, y: f64) -> AisleFront {
        AisleFront { location: 0, middle: Point::new(x, y), heading: heading_degrees.to_radians(), place: 0 }
    }

    #[test]
    fn directions_that_differ_by_noise_are_one_also_where_angles_wrap() {
        for middle in [-135.0_f64, -90.0, -45.0, 0.0, 45.0, 90.0, 135.0, 180.0] {
            let fronts = [-1.0, 0.0, 1.0].map(|noise| front(middle + noise, 0.0, 0.0)).to_vec();
            let groups = by_direction(fronts);
            assert_eq!(groups.len(), 1, "around {middle} degrees");
            assert!(line_angle_between(groups[0].0, (middle + 90.0).to_radians()) < 1e-9);
        }
    }

    #[test]
    fn aisles_point_to_the_right_or_up() {
        let angle = |heading| by_direction(vec![front(heading, 0.0, 0.0)])[0].0.to_degrees().round() as i32;
        assert_eq!([0.0, 90.0, 180.0, -90.0, 120.0, 60.0].map(angle), [90, 0, 90, 0, 30, -30]);
    }

    /// Aisles with fronts 3 m apart across each and 6 m from aisle to aisle, four places long.
    fn slanted(degrees: f64) -> Vec<AisleFront> {
        let (along, across) = (direction(degrees.to_radians()), normal(degrees.to_radians()));
        (0..3)
            .flat_map(|aisle| [(-90.0, 0.0), (90.0, 3.0)].map(|(side, at)| (side, f64::from(aisle) * 6.0 + at)))
            .flat_map(|(side, offset)| {
                (0..4).map(move |bay| {
                    let middle = across * offset + along * f64::from(bay);
                    front(degrees + side, middle.x, middle.y)
                })
            })
            .collect()
    }

    #[test]
    fn slanted_aisles_of_one_place_stay_apart() {
        let aisles = aisles_of(slanted(30.0), None);
        assert_eq!(aisles.len(), 3);
        for aisle in aisles {
            assert_eq!([Side::Left, Side::Right].map(|side| aisle.side(side).len()), [4, 4]);
        }
    }

    #[test]
    fn aisles_begin_at_the_entrance() {
        let first = |entrance: Option<Point>| {
            let aisles = aisles_of(slanted(0.0), entrance);
            let front = aisles[0].side(Side::Left)[0];
            (front.middle.x.round() as i32, front.middle.y.round() as i32)
        };
        assert_eq!(first(None), (0, 3));
        assert_eq!(first(Some(Point::new(-9.0, 0.0))), (0, 3));
        assert_eq!(first(Some(Point::new(9.0, 0.0))), (3, 0), "the left side is the lower one on the way back");
        assert_eq!(first(Some(Point::new(-9.0, 30.0))), (0, 15));
    }

    #[test]
    fn no_fronts_have_no_aisles() {
        assert!(aisles_of(Vec::new(), None).is_empty());
    }
}
