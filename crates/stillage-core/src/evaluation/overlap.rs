//! How much area faces and true areas have in common, exactly.
//!
//! A ring clipped by a convex window (I. Sutherland and G. Hodgman, *Reentrant polygon clipping*, 1974, doi
//! 10.1145/360767.360802) keeps its signed area, even where a ring that is not convex falls into pieces joined by
//! edges along the window; so the rings of any area may be clipped one by one and their areas added. A face that is not
//! convex is a signed sum of the triangles of a fan.
//!
//! Cost: O(points of the area) for each convex piece of a face whose box meets the area's.

use crate::arrangement::{FaceId, Subdivision};
use crate::geometry::{Bounds, Point, polygon, ring_area};

/// Intersection over union above which a face is a place: at one half it can be at most one.
const SAME: f64 = 0.5;

/// Side of a bucket, metres: a few pallets.
const BUCKET: f64 = 2.0;
/// Most buckets along one side: maps of any size in memory of a fixed size.
const MOST_BUCKETS: usize = 1024;

/// Which of many boxes meet a box: a uniform grid of buckets.
///
/// Cost: O(buckets that a box covers) to enter it, O(boxes in the buckets it covers) to ask.
#[derive(Debug)]
pub(super) struct BoxIndex {
    boxes: Vec<Bounds>,
    low: Point,
    /// Side of a bucket by axis, metres.
    side: [f64; 2],
    count: [usize; 2],
    buckets: Vec<Vec<u32>>,
}

impl BoxIndex {
    pub(super) fn new(boxes: Vec<Bounds>) -> Self {
        let corners = boxes.iter().filter(|bounds| !bounds.is_empty());
        let Bounds { low, high } = Bounds::around(corners.flat_map(|bounds| [&bounds.low, &bounds.high]));
        let extent = [high.x - low.x, high.y - low.y].map(|extent| if extent.is_finite() { extent } else { 0.0 });
        let count = extent.map(|extent| ((extent / BUCKET) as usize + 1).min(MOST_BUCKETS));
        let side = [0, 1].map(|axis| (extent[axis] / count[axis] as f64).max(BUCKET));
        let mut index = Self { boxes: Vec::new(), low, side, count, buckets: vec![Vec::new(); count[0] * count[1]] };
        for (number, bounds) in boxes.iter().enumerate() {
            for bucket in index.covered(bounds) {
                index.buckets[bucket].push(number as u32);
            }
        }
        index.boxes = boxes;
        index
    }

    /// The buckets that a box covers.
    fn covered(&self, bounds: &Bounds) -> impl Iterator<Item = usize> + use<> {
        let columns = self.count[0];
        let bucket = |value: f64, low: f64, axis: usize| {
            ((((value - low) / self.side[axis]).max(0.0)) as usize).min(self.count[axis] - 1)
        };
        let range = |from: f64, to: f64, low: f64, axis: usize| {
            // A box without points covers nothing.
            if from <= to { bucket(from, low, axis)..bucket(to, low, axis) + 1 } else { 0..0 }
        };
        let x = range(bounds.low.x, bounds.high.x, self.low.x, 0);
        let y = range(bounds.low.y, bounds.high.y, self.low.y, 1);
        y.flat_map(move |row| x.clone().map(move |column| row * columns + column))
    }

    /// The boxes that meet a box, ascending.
    pub(super) fn meeting(&self, bounds: &Bounds) -> Vec<u32> {
        let mut found: Vec<u32> = self
            .covered(bounds)
            .flat_map(|bucket| self.buckets[bucket].iter().copied())
            .filter(|&number| self.boxes[number as usize].meets(bounds))
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

/// A convex window, counter-clockwise, and whether its area counts or is taken away.
#[derive(Debug)]
struct ConvexPiece {
    sign: f64,
    window: Vec<Point>,
}

/// The faces of a subdivision, ready to be measured against areas.
#[derive(Debug)]
pub(super) struct FaceAreas {
    /// By face; entry 0, the unbounded face, is empty.
    pieces: Vec<Vec<ConvexPiece>>,
    rings: Vec<Vec<Vec<Point>>>,
    pub(super) areas: Vec<f64>,
    index: BoxIndex,
}

impl FaceAreas {
    pub(super) fn new(subdivision: &Subdivision) -> Self {
        let rings: Vec<Vec<Vec<Point>>> = (0..subdivision.face_count() as u32)
            .map(|face| if face == FaceId::OUTER.0 { Vec::new() } else { subdivision.rings(FaceId(face)) })
            .collect();
        let areas = rings.iter().map(|rings| polygon::area(rings)).collect();
        let index = BoxIndex::new(rings.iter().map(|rings| Bounds::around(rings.iter().flatten())).collect());
        Self { pieces: rings.iter().map(|rings| pieces(rings)).collect(), rings, areas, index }
    }

    /// The faces that an area lies in, ascending, with the area in common.
    pub(super) fn overlaps(&self, rings: &[Vec<Point>]) -> Vec<(u32, f64)> {
        let mut clip = Clip::default();
        let overlap = |face: u32| {
            let piece =
                |piece: &ConvexPiece| piece.sign * rings.iter().map(|ring| clip.area(ring, &piece.window)).sum::<f64>();
            (face, self.pieces[face as usize].iter().map(piece).sum::<f64>())
        };
        let candidates = self.index.meeting(&Bounds::around(rings.iter().flatten()));
        candidates.into_iter().map(overlap).filter(|&(_, area)| area > 0.0).collect()
    }

    /// Whether a face holds a point (even-odd rule over its rings).
    pub(super) fn holds(&self, face: u32, point: Point) -> bool {
        polygon::contains(&self.rings[face as usize], point)
    }
}

/// One true place and the faces it lies in.
#[derive(Debug)]
pub(super) struct Match {
    pub area: f64,
    /// The face that holds its centre.
    pub holder: Option<u32>,
    /// Faces with the area in common, ascending.
    pub overlaps: Vec<(u32, f64)>,
}

impl Match {
    /// Whether a face with so much area in common is the place.
    pub(super) fn fits(&self, (face, common): (u32, f64), face_areas: &[f64]) -> bool {
        common / (face_areas[face as usize] + self.area - common) > SAME
    }

    /// The face that is the place.
    pub(super) fn fitting(&self, face_areas: &[f64]) -> Option<u32> {
        let found = self.overlaps.iter().find(|&&overlap| self.fits(overlap, face_areas));
        found.map(|&(face, _)| face)
    }
}

/// A face as a signed sum of convex windows.
fn pieces(rings: &[Vec<Point>]) -> Vec<ConvexPiece> {
    if let [ring] = rings
        && is_convex(ring)
    {
        return vec![ConvexPiece { sign: 1.0, window: ring.clone() }];
    }
    let triangles = rings.iter().flat_map(|ring| {
        let apex = ring.first().copied();
        ring.windows(2).skip(1).filter_map(move |pair| {
            let window = [apex?, pair[0], pair[1]];
            let area = ring_area(&window);
            let ordered = if area > 0.0 { window } else { [window[0], window[2], window[1]] };
            (area != 0.0).then(|| ConvexPiece { sign: area.signum(), window: ordered.to_vec() })
        })
    });
    triangles.collect()
}

/// Whether a counter-clockwise ring turns left (or not at all) everywhere; simple rings that do are convex.
fn is_convex(ring: &[Point]) -> bool {
    let count = ring.len();
    (0..count).all(|index| {
        let [before, here, after] = [0, 1, 2].map(|step| ring[(index + step) % count]);
        (here - before).perp(&(after - here)) >= 0.0
    })
}

/// Room for clipping, kept between calls.
#[derive(Debug, Default)]
struct Clip {
    ring: Vec<Point>,
    next: Vec<Point>,
}

impl Clip {
    /// Signed area of the part of a ring inside a convex window.
    fn area(&mut self, ring: &[Point], window: &[Point]) -> f64 {
        self.ring.clear();
        self.ring.extend_from_slice(ring);
        for (index, &from) in window.iter().enumerate() {
            let along = window[(index + 1) % window.len()] - from;
            let side = |point: &Point| along.perp(&(point - from));
            self.next.clear();
            let Some(mut before) = self.ring.last().copied() else { return 0.0 };
            let mut side_before = side(&before);
            for &here in &self.ring {
                let side_here = side(&here);
                if (side_before > 0.0 && side_here < 0.0) || (side_before < 0.0 && side_here > 0.0) {
                    self.next.push(before + (here - before) * (side_before / (side_before - side_here)));
                }
                if side_here >= 0.0 {
                    self.next.push(here);
                }
                (before, side_before) = (here, side_here);
            }
            std::mem::swap(&mut self.ring, &mut self.next);
        }
        ring_area(&self.ring)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::geometry::direction;
    use proptest::prelude::*;

    fn ring(points: &[(f64, f64)]) -> Vec<Point> {
        points.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    fn common(face: &[Vec<Point>], area: &[Vec<Point>]) -> f64 {
        let mut clip = Clip::default();
        let piece =
            |piece: &ConvexPiece| piece.sign * area.iter().map(|ring| clip.area(ring, &piece.window)).sum::<f64>();
        pieces(face).iter().map(piece).sum()
    }

    fn square(x: f64, y: f64, side: f64) -> Vec<Point> {
        ring(&[(x, y), (x + side, y), (x + side, y + side), (x, y + side)])
    }

    #[test]
    fn a_hook_and_a_square_have_two_corners_in_common() {
        let hook =
            ring(&[(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 3.0), (4.0, 3.0), (4.0, 4.0), (0.0, 4.0)]);
        let square = square(3.0, 0.5, 3.0);
        assert!((common(std::slice::from_ref(&hook), std::slice::from_ref(&square)) - 1.0).abs() < 1e-12);
        assert!((common(&[square], &[hook]) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn holes_are_taken_away_on_both_sides() {
        let mut hole = square(1.0, 1.0, 2.0);
        hole.reverse();
        let frame = [square(0.0, 0.0, 4.0), hole];
        assert!((common(&frame, &frame) - 12.0).abs() < 1e-12);
        assert!((common(&frame, &[square(0.0, 0.0, 2.0)]) - 3.0).abs() < 1e-12);
        assert!(polygon::contains(&frame, Point::new(0.5, 2.0)) && !polygon::contains(&frame, Point::new(2.0, 2.0)));
    }

    proptest! {
        #[test]
        fn boxes_are_found_as_by_comparing_all(
            boxes in prop::collection::vec((-20.0..20.0, -20.0..20.0, 0.0..9.0, 0.0..9.0), 0..40),
            (x, y, size) in (-25.0..25.0, -25.0..25.0, 0.0..8.0)
        ) {
            let bounds = |&(x, y, width, height): &(f64, f64, f64, f64)| {
                Bounds { low: Point::new(x, y), high: Point::new(x + width, y + height) }
            };
            let boxes: Vec<Bounds> = boxes.iter().map(bounds).collect();
            let asked = bounds(&(x, y, size, size));
            let expected: Vec<u32> = (0..boxes.len() as u32).filter(|&number| boxes[number as usize].meets(&asked)).collect();
            prop_assert_eq!(BoxIndex::new(boxes).meeting(&asked), expected);
        }

        #[test]
        fn common_area_is_that_of_a_count(
            radii in prop::collection::vec(0.5..4.0, 3..9), (x, y, side) in (0.0..6.0, 0.0..6.0, 1.0..5.0)
        ) {
            // A star around the middle is simple, and mostly not convex.
            let spoke = |(index, &radius): (usize, &f64)| {
                Point::new(4.0, 4.0) + direction(TAU * index as f64 / radii.len() as f64) * radius
            };
            let star = [radii.iter().enumerate().map(spoke).collect::<Vec<_>>()];
            let window = [square(x, y, side)];
            let steps = 200;
            let at = |index: usize| (index as f64 + 0.5) / steps as f64 * 8.0;
            let cells = (0..steps).flat_map(|i| (0..steps).map(move |j| Point::new(at(i), at(j))));
            let both = |point: &Point| polygon::contains(&star, *point) && polygon::contains(&window, *point);
            let counted = cells.filter(both).count() as f64 * (8.0 / steps as f64).powi(2);
            for exact in [common(&window, &star), common(&star, &window)] {
                prop_assert!((exact - counted).abs() < 0.3, "{exact} {counted}");
            }
        }
    }
}
