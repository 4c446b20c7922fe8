//! How much area polygons have in common, exactly.
//!
//! A ring clipped by a convex window (I. Sutherland and G. Hodgman, *Reentrant polygon clipping*, 1974, doi
//! 10.1145/360767.360802) keeps its signed area, even where a ring that is not convex falls into pieces joined by
//! edges along the window; so the rings of any area may be clipped one by one and their areas added. A polygon that is
//! not convex is a signed sum of the triangles of a fan. Cost: O(points of the area) for each convex piece.

use super::point::Point;
use super::polygon::ring_area;

/// A convex window, counter-clockwise; the sign says whether its area is added or subtracted.
#[derive(Debug)]
pub(crate) struct ConvexPiece {
    pub(crate) sign: f64,
    pub(crate) window: Vec<Point>,
}

/// Area inside both of two rings as a share of the area inside either, 0 to 1. Rings turn counter-clockwise.
pub(crate) fn overlap_share(first: &[Point], second: &[Point]) -> f64 {
    shared_fraction(std::slice::from_ref(&first), std::slice::from_ref(&second))
}

/// Area inside both of two polygons as a share of the area inside either, 0 to 1. Their outlines turn counter-clockwise,
/// their holes clockwise.
pub(crate) fn shared_fraction(first: &[impl AsRef<[Point]>], second: &[impl AsRef<[Point]>]) -> f64 {
    let common = common_area(first, second);
    let area = |ring: &dyn AsRef<[Point]>| ring_area(ring.as_ref());
    let either =
        first.iter().map(|ring| area(ring)).sum::<f64>() + second.iter().map(|ring| area(ring)).sum::<f64>() - common;
    if either > 0.0 { (common / either).clamp(0.0, 1.0) } else { 0.0 }
}

/// Area inside both of two polygons, square metres.
pub(crate) fn common_area(first: &[impl AsRef<[Point]>], second: &[impl AsRef<[Point]>]) -> f64 {
    let mut clip = Clip::default();
    let mut inside = |window: &[Point]| first.iter().map(|ring| clip.area(ring.as_ref(), window)).sum::<f64>();
    pieces(second).iter().map(|piece| piece.sign * inside(&piece.window)).sum()
}

/// A polygon as a signed sum of convex windows.
pub(crate) fn pieces(rings: &[impl AsRef<[Point]>]) -> Vec<ConvexPiece> {
    if let [ring] = rings
        && is_convex(ring.as_ref())
    {
        return vec![ConvexPiece { sign: 1.0, window: ring.as_ref().to_vec() }];
    }
    let triangles = rings.iter().map(AsRef::as_ref).flat_map(|ring| {
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

/// Working memory for clipping, reused between calls.
#[derive(Debug, Default)]
pub(crate) struct Clip {
    ring: Vec<Point>,
    next: Vec<Point>,
}

impl Clip {
    /// Signed area of the part of a ring inside a convex window.
    pub(crate) fn area(&mut self, ring: &[Point], window: &[Point]) -> f64 {
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
    use crate::geometry::{direction, polygon};
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
    fn half_a_square_aside_is_a_third_in_common() {
        assert!((overlap_share(&square(0.0, 0.0, 2.0), &square(1.0, 0.0, 2.0)) - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!(overlap_share(&square(0.0, 0.0, 2.0), &square(5.0, 0.0, 2.0)), 0.0);
        assert_eq!(overlap_share(&[], &[]), 0.0);
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
