//! Areas that polygons have in common, by scan lines.
//!
//! Along a line every crossing is exact; the lines lie so close to each other that a figure which is rounded to three
//! decimals hardly notices. Polygons may touch, overlap and turn either way (even-odd rule).

use stillage_core::geometry::{Point, polygon};

/// Distance between two lines, metres.
const SPACING: f64 = 0.005;

/// Tells for each piece of the plane in which polygons it lies, by index, ascending, and its area in square metres.
/// Pieces that lie in none are left out. O(n log n) for n crossings of lines and sides.
pub fn pieces(polygons: &[Vec<Vec<Point>>], mut act: impl FnMut(&[usize], f64)) {
    let sides =
        || polygons.iter().enumerate().flat_map(|(index, rings)| polygon::sides(rings).map(move |side| (index, side)));
    let line_above = |y: f64| (y / SPACING - 0.5).ceil() as i64;
    let Some(first) = sides().map(|(_, [from, _])| line_above(from.y)).min() else { return };
    let end = sides().map(|(_, [from, _])| line_above(from.y)).max().map_or(first, |last| last);
    let mut lines: Vec<Vec<(f64, usize)>> = vec![Vec::new(); (end - first) as usize];
    for (index, [from, to]) in sides() {
        let (low, high) = if from.y < to.y { (from, to) } else { (to, from) };
        for line in line_above(low.y)..line_above(high.y) {
            let y = (line as f64 + 0.5) * SPACING;
            let x = low.x + (high.x - low.x) * (y - low.y) / (high.y - low.y);
            lines[(line - first) as usize].push((x, index));
        }
    }
    let mut inside: Vec<usize> = Vec::new();
    for mut crossings in lines {
        crossings.sort_by(|one, other| one.0.total_cmp(&other.0));
        inside.clear();
        for (at, &(x, index)) in crossings.iter().enumerate() {
            match inside.binary_search(&index) {
                Ok(found) => drop(inside.remove(found)),
                Err(place) => inside.insert(place, index),
            }
            let width = crossings.get(at + 1).map_or(0.0, |next| next.0 - x);
            if width > 0.0 && !inside.is_empty() {
                act(&inside, width * SPACING);
            }
        }
    }
}
