//! Rings and polygons. A ring does not repeat its first point; a polygon is its outlines (counter-clockwise) and holes
//! (clockwise), in any order.

use std::collections::BTreeMap;

use super::point::{Point, Vector};

use super::segment::x_at_level;

/// Signed area of a ring, square metres; positive when counter-clockwise.
#[must_use]
pub fn ring_area(ring: &[Point]) -> f64 {
    let Some(anchor) = ring.first() else { return 0.0 };
    ring.windows(2).map(|pair| (pair[0] - anchor).perp(&(pair[1] - anchor))).sum::<f64>() / 2.0
}

/// Area of a polygon, square metres; 0 without rings.
#[must_use]
pub fn area(rings: &[Vec<Point>]) -> f64 {
    // Not `sum`, which gives -0 for no rings.
    rings.iter().fold(0.0, |area, ring| area + ring_area(ring))
}

/// The sides of all rings, in order.
pub fn sides(rings: &[Vec<Point>]) -> impl Iterator<Item = [Point; 2]> + '_ {
    rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&start, &end)| [start, end]))
}

/// Whether a point lies in a polygon: a ray to the right crosses its sides an odd number of times. Rings may turn
/// either way. O(corners).
#[must_use]
pub fn contains(rings: &[Vec<Point>], point: Point) -> bool {
    is_on_the_left_of_an_odd_number(sides(rings), point)
}

/// Whether a point lies in the polygon that some sides enclose, in any order. O(sides).
#[must_use]
pub fn is_within(sides: &[[Point; 2]], point: Point) -> bool {
    is_on_the_left_of_an_odd_number(sides.iter().copied(), point)
}

fn is_on_the_left_of_an_odd_number(sides: impl Iterator<Item = [Point; 2]>, point: Point) -> bool {
    sides.filter(|&side| x_at_level(side, point.y).is_some_and(|x| point.x < x)).count() % 2 == 1
}

/// Centroid of a polygon; `None` where it has no area.
#[must_use]
pub fn centroid(rings: &[Vec<Point>]) -> Option<Point> {
    let anchor = *rings.iter().flatten().next()?;
    let moment = |[start, end]: [Point; 2]| {
        let (from, to) = (start - anchor, end - anchor);
        (from + to) * from.perp(&to)
    };
    let area = area(rings);
    (area != 0.0).then(|| anchor + sides(rings).map(moment).sum::<Vector>() / (6.0 * area))
}

/// Two sides of a ring, by the numbers of their first corners, that have more in common than the corner between them;
/// `None` for a simple ring. A sweep over the sides by their least x: O(n log n), and the pairs that overlap along x.
#[must_use]
pub fn crossing_sides(ring: &[Point]) -> Option<[usize; 2]> {
    let side = |number: usize| [ring[number], ring[(number + 1) % ring.len()]];
    let range = |number: usize| {
        let [start, end] = side(number);
        (start.x.min(end.x), start.x.max(end.x))
    };
    let mut order: Vec<usize> = (0..ring.len()).collect();
    order.sort_by(|&one, &other| range(one).0.total_cmp(&range(other).0));
    let mut current: Vec<usize> = Vec::new();
    for number in order {
        current.retain(|&other| range(other).1 >= range(number).0);
        let is_crossed = |&other: &usize| {
            let (one, next) = (side(number), side(other));
            if (number + 1) % ring.len() != other && (other + 1) % ring.len() != number {
                return meet(one, next);
            }
            // Neighbours share a corner; they cross where one turns back along the other.
            let [first, second] = if one[1] == next[0] { [one, next] } else { [next, one] };
            let (way, on) = (first[1] - first[0], second[1] - second[0]);
            way.perp(&on) == 0.0 && way.dot(&on) <= 0.0
        };
        if let Some(&other) = current.iter().find(|other| is_crossed(other)) {
            return Some([number.min(other), number.max(other)]);
        }
        current.push(number);
    }
    None
}

/// Whether two segments have a point in common.
fn meet([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let turn = |from: Point, to: Point, point: Point| (to - from).perp(&(point - from));
    let (at_c, at_d, at_a, at_b) = (turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b));
    let is_between = |low: Point, high: Point, point: Point| (low - point).dot(&(high - point)) <= 0.0;
    (at_c * at_d < 0.0 && at_a * at_b < 0.0)
        || (at_c == 0.0 && is_between(a, b, c))
        || (at_d == 0.0 && is_between(a, b, d))
        || (at_a == 0.0 && is_between(c, d, a))
        || (at_b == 0.0 && is_between(c, d, b))
}

/// Cuts a closed walk into rings wherever it comes back to a place: a ring that touches itself in a corner becomes two.
/// What has fewer than three places (a dangling edge, walked there and back) bounds nothing and is dropped.
/// O(n log n) for n places.
pub fn simple_rings<K: Copy + Ord>(walk: impl IntoIterator<Item = K>) -> Vec<Vec<K>> {
    let walk: Vec<K> = walk.into_iter().collect();
    let mut sorted = walk.clone();
    sorted.sort_unstable();
    if walk.len() >= 3 && sorted.windows(2).all(|pair| pair[0] != pair[1]) {
        return vec![walk];
    }
    let mut rings = Vec::new();
    let mut path: Vec<K> = Vec::new();
    let mut index_in_path: BTreeMap<K, usize> = BTreeMap::new();
    for place in walk {
        if let Some(&index) = index_in_path.get(&place) {
            let ring = path.split_off(index);
            for passed in &ring {
                index_in_path.remove(passed);
            }
            rings.push(ring);
        }
        index_in_path.insert(place, path.len());
        path.push(place);
    }
    rings.push(path);
    rings.retain(|ring| ring.len() >= 3);
    rings
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f64, high: f64) -> Vec<Point> {
        [(low, low), (high, low), (high, high), (low, high)].map(|(x, y)| Point::new(x, y)).to_vec()
    }

    fn with_a_hole() -> Vec<Vec<Point>> {
        let mut hole = square(1.0, 2.0);
        hole.reverse();
        vec![square(0.0, 4.0), hole]
    }

    #[test]
    fn a_hole_is_not_inside_and_takes_its_area() {
        let polygon = with_a_hole();
        assert_eq!(area(&polygon), 15.0);
        let is_inside = |place: f64| contains(&polygon, Point::new(place, place));
        assert_eq!([0.5, 1.5, 3.0, 5.0].map(is_inside), [true, false, true, false]);
        assert_eq!(area(&[]).to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn the_centroid_is_the_mean_of_the_area() {
        // 16 square metres around (2, 2) without one around (1.5, 1.5).
        let expected = (16.0 * 2.0 - 1.5) / 15.0;
        let found = centroid(&with_a_hole()).expect("it has an area");
        assert!((found - Point::new(expected, expected)).norm() < 1e-12);
        assert_eq!(centroid(&[square(1.0, 1.0)]), None);
    }

    #[test]
    fn a_ring_is_simple_unless_its_sides_meet() {
        let ring = |corners: &[(f64, f64)]| corners.iter().map(|&(x, y)| Point::new(x, y)).collect::<Vec<_>>();
        assert_eq!(crossing_sides(&square(0.0, 4.0)), None);
        let bow = ring(&[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 4.0)]);
        assert_eq!(crossing_sides(&bow), Some([0, 2]));
        let touching = ring(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 0.0), (0.0, 4.0)]);
        assert!(crossing_sides(&touching).is_some());
        let turning_back = ring(&[(0.0, 0.0), (4.0, 0.0), (2.0, 0.0), (2.0, 3.0)]);
        assert!(crossing_sides(&turning_back).is_some());
        let with_a_corner_twice = ring(&[(0.0, 0.0), (0.0, 0.0), (4.0, 0.0), (4.0, 4.0)]);
        assert!(crossing_sides(&with_a_corner_twice).is_some());
    }

    #[test]
    fn a_walk_is_cut_where_it_comes_back() {
        assert_eq!(simple_rings([1, 2, 3, 1, 4, 5]), [vec![1, 2, 3], vec![1, 4, 5]]);
        assert_eq!(simple_rings([1, 2, 3, 9, 3, 4]), [[1, 2, 3, 4]]);
        assert_eq!(simple_rings([1, 2]), [[0; 0]; 0]);
    }
}
