//! Rings -> valid polygons, and the outlines of raster cells.
//!
//! [`polygons`] gives each hole to the ring around it (OGC 06-103r4, 6.1.11). O(holes * corners of the outer rings).

use std::collections::BTreeMap;

use stillage_core::Point;
use stillage_core::geometry::polygon::{contains, simple_rings};
use stillage_core::geometry::ring_area;

use super::geometry::Ring;

/// Groups rings into polygons: counter-clockwise ones are outer rings, clockwise ones holes of the smallest around
/// them.
pub(super) fn polygons(rings: Vec<Ring>) -> Vec<Vec<Ring>> {
    let (outer, others): (Vec<Ring>, Vec<Ring>) = rings.into_iter().partition(|ring| ring_area(ring) > 0.0);
    let mut polygons: Vec<Vec<Ring>> = outer.into_iter().map(|ring| vec![ring]).collect();
    for hole in others.into_iter().filter(|ring| ring_area(ring) < 0.0) {
        // Rings may touch in points, but not along edges: the middle of an edge decides.
        let inside = Point::from((hole[0].coords + hole[1].coords) / 2.0);
        let around = polygons
            .iter_mut()
            .filter(|polygon| contains(&polygon[..1], inside))
            .min_by(|first, second| ring_area(&first[0]).total_cmp(&ring_area(&second[0])));
        if let Some(polygon) = around {
            polygon.push(hole);
        }
    }
    polygons
}

/// A corner of a raster: column and row.
pub(super) type Corner = (usize, usize);

/// The outlines of the raster cells that `is_inside`, as simple rings of the corners where they turn.
pub(super) fn raster_outlines(
    columns: usize,
    rows: usize,
    is_inside: impl Fn(usize, usize) -> bool,
) -> Vec<Vec<Corner>> {
    let inside = |column: usize, row: usize| column < columns && row < rows && is_inside(column, row);
    // Each corner's outgoing boundary edges, the area on their left.
    let mut outgoing: BTreeMap<Corner, Vec<Corner>> = BTreeMap::new();
    for row in 0..rows {
        for column in (0..columns).filter(|&column| inside(column, row)) {
            let (right, top) = (column + 1, row + 1);
            let mut side = |open: bool, from: Corner, to: Corner| {
                if open {
                    outgoing.entry(from).or_default().push(to);
                }
            };
            side(row == 0 || !inside(column, row - 1), (column, row), (right, row));
            side(!inside(right, row), (right, row), (right, top));
            side(!inside(column, top), (right, top), (column, top));
            side(column == 0 || !inside(column - 1, row), (column, top), (column, row));
        }
    }
    let mut rings = Vec::new();
    while let Some((&start, _)) = outgoing.first_key_value() {
        let mut walk = vec![start];
        let mut at = start;
        let mut before = start;
        while let Some(next) = leave(&mut outgoing, before, at) {
            (before, at) = (at, next);
            walk.push(at);
        }
        walk.pop();
        rings.extend(simple_rings(walk).into_iter().map(|ring| turning_points(&ring)));
    }
    rings
}

/// Takes the edge that leads on from a corner. Where two do, the one to the left stays on the same cell, so that areas
/// that only touch in the corner stay apart.
fn leave(outgoing: &mut BTreeMap<Corner, Vec<Corner>>, before: Corner, at: Corner) -> Option<Corner> {
    let ends = outgoing.get_mut(&at)?;
    let step = |from: Corner, to: Corner| (to.0 as i64 - from.0 as i64, to.1 as i64 - from.1 as i64);
    let along = step(before, at);
    let turns_left = |end: &Corner| {
        let onward = step(at, *end);
        along.0 * onward.1 - along.1 * onward.0 > 0
    };
    let chosen = ends.iter().position(turns_left).unwrap_or(0);
    let next = ends.swap_remove(chosen);
    if ends.is_empty() {
        outgoing.remove(&at);
    }
    Some(next)
}

/// The corners of an axis-parallel ring where its direction changes.
fn turning_points(ring: &[Corner]) -> Vec<Corner> {
    let count = ring.len();
    let turns = |index: &usize| {
        let (before, at, after) = (ring[(index + count - 1) % count], ring[*index], ring[(index + 1) % count]);
        !((before.0 == at.0 && at.0 == after.0) || (before.1 == at.1 && at.1 == after.1))
    };
    (0..count).filter(turns).map(|index| ring[index]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn outline(picture: &[&str]) -> Vec<Vec<Corner>> {
        let rows: Vec<&[u8]> = picture.iter().rev().map(|line| line.as_bytes()).collect();
        raster_outlines(rows[0].len(), rows.len(), |column, row| rows[row][column] == b'#')
    }

    #[test]
    fn a_block_has_four_corners() {
        assert_eq!(outline(&["....", ".##.", ".##."]), [[(1, 0), (3, 0), (3, 2), (1, 2)]]);
    }

    #[test]
    fn blocks_that_touch_in_a_corner_are_two_rings() {
        let rings = outline(&[".#", "#."]);
        assert_eq!(rings, [[(0, 0), (1, 0), (1, 1), (0, 1)], [(1, 1), (2, 1), (2, 2), (1, 2)]]);
    }

    #[test]
    fn a_hole_that_touches_the_outside_in_a_corner_stays_a_hole() {
        let rings = outline(&["###.", "#.##", "####"]);
        let points = |ring: Vec<Corner>| ring.into_iter().map(|(x, y)| Point::new(x as f64, y as f64)).collect();
        let polygons = polygons(rings.into_iter().map(points).collect());
        assert_eq!(polygons.len(), 1);
        assert_eq!(polygons[0].iter().map(|ring| ring_area(ring)).collect::<Vec<_>>(), [11.0, -1.0]);
    }

    proptest! {
        #[test]
        fn areas_are_kept(cells in prop::collection::vec(any::<bool>(), 30)) {
            let rings = raster_outlines(6, 5, |column, row| cells[row * 6 + column]);
            let points = |ring: Vec<Corner>| ring.into_iter().map(|(x, y)| Point::new(x as f64, y as f64)).collect();
            let polygons = polygons(rings.into_iter().map(points).collect());
            let area: f64 = polygons.iter().flatten().map(|ring| ring_area(ring)).sum();
            prop_assert_eq!(area, cells.iter().filter(|cell| **cell).count() as f64);
        }
    }
}
