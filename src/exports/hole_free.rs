//! A polygon with holes -> simple polygons without holes that cover the same ground.
//!
//! Method: level cuts, at least one through each hole, as few as stabbing their extents takes; each cut lies on no
//! corner. Between two cuts the borders of the polygon are chains of points that begin and end on cuts. Along a cut the
//! crossings, sorted, pair up: between the two of a pair lies the inside. A piece is chains joined by such pairs.
//!
//! Cost: O(corners * cuts + crossings log crossings). Limits: none on valid polygons; a cut through a corner moves to
//! the middle between the corners next to it.

use stillage_core::Point;
use stillage_core::geometry::polygon::simple_rings;
use stillage_core::geometry::ring_area;

/// Part of a border between two cuts: from a crossing, over corners, to a crossing.
struct Chain {
    points: Vec<Point>,
}

/// Cuts a polygon into simple rings, counter-clockwise; its outer rings are counter-clockwise, its holes clockwise.
pub(super) fn hole_free(rings: &[Vec<Point>]) -> Vec<Vec<Point>> {
    let cuts = cuts(rings);
    if cuts.is_empty() {
        return rings.to_vec();
    }
    let levels: Vec<f64> = [f64::NEG_INFINITY].into_iter().chain(cuts).chain([f64::INFINITY]).collect();
    levels.windows(2).flat_map(|pair| pieces(rings, pair[0], pair[1])).collect()
}

/// Levels that cross every hole, ascending: each as high as the lowest top of the holes not crossed yet allows.
fn cuts(rings: &[Vec<Point>]) -> Vec<f64> {
    let mut corners: Vec<f64> = rings.iter().flatten().map(|point| point.y).collect();
    corners.sort_by(f64::total_cmp);
    corners.dedup();
    let extent = |ring: &Vec<Point>| {
        let levels = ring.iter().map(|point| point.y);
        (levels.clone().fold(f64::INFINITY, f64::min), levels.fold(f64::NEG_INFINITY, f64::max))
    };
    let mut holes: Vec<(f64, f64)> = rings.iter().filter(|ring| ring_area(ring) < 0.0).map(extent).collect();
    holes.sort_by(|first, second| first.1.total_cmp(&second.1));
    let mut cuts: Vec<f64> = Vec::new();
    for (bottom, top) in holes {
        if cuts.last().is_none_or(|&cut| cut <= bottom) {
            // Between the top of the hole and the next corner below it.
            let below = corners.partition_point(|&corner| corner < top).saturating_sub(1);
            cuts.push(f64::midpoint(corners[below], top));
        }
    }
    cuts
}

/// The pieces between two levels.
fn pieces(rings: &[Vec<Point>], low: f64, high: f64) -> Vec<Vec<Point>> {
    let inside = |point: &Point| low < point.y && point.y < high;
    let mut done = Vec::new();
    let mut chains = Vec::new();
    for ring in rings {
        if ring.iter().all(inside) {
            done.push(ring.clone());
        } else {
            chains.extend(chains_of(ring, low, high));
        }
    }
    let next = successors(&chains, low, high);
    let mut is_used = vec![false; chains.len()];
    for start in 0..chains.len() {
        let mut walk: Vec<Point> = Vec::new();
        let mut at = start;
        while !std::mem::replace(&mut is_used[at], true) {
            walk.extend(&chains[at].points);
            at = next[at];
        }
        done.extend(simple(walk));
    }
    done
}

/// The parts of a ring between two levels, each from the side that leads in to the one that leads out.
fn chains_of(ring: &[Point], low: f64, high: f64) -> Vec<Chain> {
    let mut chains: Vec<Chain> = Vec::new();
    // Starts where the ring is outside, so that no chain is cut in two by the ends of the list.
    let start = ring.iter().position(|point| !(low < point.y && point.y < high)).unwrap_or(0);
    for step in 0..ring.len() {
        let from = ring[(start + step) % ring.len()];
        let to = ring[(start + step + 1) % ring.len()];
        let mut crossings: Vec<f64> =
            [low, high].into_iter().filter(|&level| (from.y < level) != (to.y < level)).collect();
        if from.y > to.y {
            crossings.reverse();
        }
        let mut is_in = low < from.y && from.y < high;
        for level in crossings {
            let at = crossing(from, to, level);
            if is_in {
                chains.last_mut().into_iter().for_each(|chain| chain.points.push(at));
            } else {
                chains.push(Chain { points: vec![at] });
            }
            is_in = !is_in;
        }
        if is_in {
            chains.last_mut().into_iter().for_each(|chain| chain.points.push(to));
        }
    }
    chains
}

/// Where a side crosses a level.
fn crossing(from: Point, to: Point, level: f64) -> Point {
    // The same order of the ends for both pieces beside a cut, so that they share the point to the bit.
    let (from, to) = if from.y < to.y { (from, to) } else { (to, from) };
    Point::new(from.x + (to.x - from.x) * (level - from.y) / (to.y - from.y), level)
}

/// The chain that follows each chain around its piece.
fn successors(chains: &[Chain], low: f64, high: f64) -> Vec<usize> {
    let mut next = vec![0; chains.len()];
    for level in [low, high].into_iter().filter(|level| level.is_finite()) {
        // Crossings of this level: where, which chain, and whether it ends there.
        let mut crossings: Vec<(f64, usize, bool)> = Vec::new();
        for (index, chain) in chains.iter().enumerate() {
            let (first, last) = (chain.points[0], chain.points[chain.points.len() - 1]);
            crossings.extend((first.y == level).then_some((first.x, index, false)));
            crossings.extend((last.y == level).then_some((last.x, index, true)));
        }
        crossings.sort_by(|first, second| first.0.total_cmp(&second.0));
        for pair in crossings.chunks_exact(2) {
            let (ends, begins) = if pair[0].2 { (pair[0].1, pair[1].1) } else { (pair[1].1, pair[0].1) };
            next[ends] = begins;
        }
    }
    next
}

/// A ring that may touch itself in corners -> simple rings with an area.
fn simple(walk: Vec<Point>) -> impl Iterator<Item = Vec<Point>> {
    let bits = walk.into_iter().map(|point| (point.x.to_bits(), point.y.to_bits()));
    let points = |ring: Vec<(u64, u64)>| -> Vec<Point> {
        ring.into_iter().map(|(x, y)| Point::new(f64::from_bits(x), f64::from_bits(y))).collect()
    };
    simple_rings(bits).into_iter().map(points).filter(|ring: &Vec<Point>| ring.len() > 2 && ring_area(ring) > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use stillage_core::geometry::polygon::area;

    fn block(x: f64, y: f64, size: f64) -> Vec<Point> {
        vec![Point::new(x, y), Point::new(x + size, y), Point::new(x + size, y + size), Point::new(x, y + size)]
    }

    fn hole(x: f64, y: f64, size: f64) -> Vec<Point> {
        block(x, y, size).into_iter().rev().collect()
    }

    fn check(rings: &[Vec<Point>], count: usize) {
        let pieces = hole_free(rings);
        assert_eq!(pieces.len(), count);
        assert!(pieces.iter().all(|piece| ring_area(piece) > 0.0), "all are counter-clockwise");
        let whole: f64 = pieces.iter().map(|piece| ring_area(piece)).sum();
        assert!((whole - area(rings)).abs() < 1e-9, "{whole}");
    }

    #[test]
    fn a_polygon_without_holes_stays_whole() {
        check(&[block(0.0, 0.0, 4.0)], 1);
    }

    #[test]
    fn one_cut_opens_holes_side_by_side() {
        check(&[block(0.0, 0.0, 10.0), hole(1.0, 1.0, 2.0), hole(4.0, 2.0, 3.0), hole(8.0, 1.5, 1.0)], 2);
    }

    #[test]
    fn holes_one_above_another_take_a_cut_each() {
        check(&[block(0.0, 0.0, 10.0), hole(1.0, 1.0, 2.0), hole(4.0, 6.0, 3.0)], 3);
    }

    #[test]
    fn a_hole_that_touches_the_border_is_opened() {
        let touching = vec![Point::new(0.0, 5.0), Point::new(2.0, 6.0), Point::new(2.0, 4.0)];
        check(&[block(0.0, 0.0, 10.0), touching], 2);
    }

    #[test]
    fn separate_parts_stay_separate() {
        check(&[block(0.0, 0.0, 4.0), hole(1.0, 1.0, 1.0), block(6.0, 0.0, 1.0)], 3);
    }
}
