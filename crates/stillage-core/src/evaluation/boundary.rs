//! Whether the borders of true places are borders of faces, and the other way round.
//!
//! Recall: share of the length of the borders of true places that has a border of a face nearby. Precision: share of
//! the length of the borders of faces in and around true places that has the border of a place nearby; what faces do
//! elsewhere does not count. Borders are sampled.
//!
//! Cost: O(length of the borders / step x borders nearby).

use rayon::prelude::*;

use super::box_index::BoxIndex;
use crate::arrangement::Subdivision;
use crate::geometry::{Bounds, Point, polygon, segment};
use crate::watch::{Stopped, Watch};

/// Distance at which borders agree, metres: three cells of a common map, as in the accuracy study.
const NEARBY: f64 = 0.15;
/// Distance from a true place within which borders of faces count, metres: more than half a flue.
const AROUND: f64 = 0.3;
/// Distance of the samples, metres: a cell of a common map.
const STEP: f64 = 0.05;

/// Segments with an index, for queries by distance.
struct Segments {
    segments: Vec<[Point; 2]>,
    index: BoxIndex,
}

impl Segments {
    fn new(segments: Vec<[Point; 2]>) -> Self {
        let index = BoxIndex::new(segments.iter().map(Bounds::around).collect());
        Self { segments, index }
    }

    /// Whether one lies within a distance of a point.
    fn near(&self, point: Point, distance: f64) -> bool {
        let bounds = Bounds { low: point, high: point }.grown(distance);
        let within = |&number: &u32| segment::distance(point, self.segments[number as usize]) <= distance;
        self.index.meeting(&bounds).iter().any(within)
    }
}

/// The middles of the equal steps of a segment, and their length.
fn samples([from, to]: [Point; 2]) -> (impl Iterator<Item = Point>, f64) {
    let length = (to - from).norm();
    let count = (length / STEP).ceil().max(1.0) as usize;
    let at = move |index: usize| from + (to - from) * ((index as f64 + 0.5) / count as f64);
    ((0..count).map(at), length / count as f64)
}

/// Length of borders that counts, and the part of it that agrees.
#[derive(Debug, Clone, Copy, Default)]
struct BorderLength {
    all: f64,
    right: f64,
}

impl BorderLength {
    fn share(of: &[Self]) -> Option<f64> {
        let all: f64 = of.iter().map(|length| length.all).sum();
        let right: f64 = of.iter().map(|length| length.right).sum();
        (all > 0.0).then(|| right / all)
    }
}

/// Recall and precision of borders; `None` where there is nothing to compare.
pub(super) fn compare(
    subdivision: &Subdivision,
    places: &[Vec<Vec<Point>>],
    watch: &Watch<'_>,
) -> Result<[Option<f64>; 2], Stopped> {
    let sides = |ring: &Vec<Point>| {
        (0..ring.len()).map(|index| [ring[index], ring[(index + 1) % ring.len()]]).collect::<Vec<_>>()
    };
    let of_places = Segments::new(places.iter().flatten().flat_map(sides).collect());
    let of_faces = Segments::new(subdivision.edges().map(|edge| subdivision.segment(edge)).collect());
    let whole = BoxIndex::new(places.iter().map(|rings| Bounds::around(rings.iter().flatten())).collect());
    let in_place = |point: Point| {
        let here = Bounds { low: point, high: point };
        whole.meeting(&here).iter().any(|&place| polygon::contains(&places[place as usize], point))
    };
    let measure = |segment: &[Point; 2], counts: &(dyn Fn(Point) -> bool + Sync), other: &Segments| {
        watch.check()?;
        let (points, step) = samples(*segment);
        let mut length = BorderLength::default();
        for point in points.filter(|&point| counts(point)) {
            length.all += step;
            length.right += if other.near(point, NEARBY) { step } else { 0.0 };
        }
        Ok(length)
    };
    let around = |point: Point| of_places.near(point, AROUND) || in_place(point);
    let recall: Result<Vec<BorderLength>, Stopped> =
        of_places.segments.par_iter().map(|segment| measure(segment, &|_| true, &of_faces)).collect();
    let precision: Result<Vec<BorderLength>, Stopped> =
        of_faces.segments.par_iter().map(|segment| measure(segment, &around, &of_places)).collect();
    Ok([BorderLength::share(&recall?), BorderLength::share(&precision?)])
}
