//! Which of several motions explains two maps best, and how surely.
//!
//! Halls that look alike from both ends have two motions under which most surfaces touch: what both explain says nothing,
//! what one explains and the other does not decides. It comes in lumps, as a bay that was emptied or a column; so it is
//! summed by tiles of the floor, and its sum told in standard deviations of the tiles. Walls and all else are evidence of
//! two kinds, whose standard deviations are combined by the method of S. A. Stouffer (*The American Soldier* 1949): many
//! moved goods then do not outvote few walls that stay, nor long walls that are alike the racks between them.
//! Cost: O(points) for each pair of motions.

use std::collections::BTreeMap;

use super::agreement::{Tally, touch};
use super::surfaces::Surfaces;
use crate::geometry::RigidMotion;

/// Side of the tiles that count as independent, metres: about a bay of a rack.
const TILE_M: f64 = 2.0;
/// Share of the best rank below which a motion is no rival: 0.32 for two bent scans of a building, 0.5 at least for
/// different halls.
pub(super) const RIVAL: f64 = 0.42;

/// Brings the motion that explains the most to the front of those ranked by what touches, and tells by how many standard
/// deviations it explains more than the likeliest of its rivals: infinite without any.
pub(super) fn settle(maps: [&Surfaces<'_>; 2], points: [&[usize]; 2], ranked: &mut [(RigidMotion, Tally)]) -> f64 {
    let Some((_, best)) = ranked.first() else { return f64::INFINITY };
    let least = RIVAL * best.rank();
    let rivals = ranked.iter().take_while(|(_, tally)| tally.rank() > least).count();
    for challenger in 1..rivals {
        if advantage(maps, points, [&ranked[0].0, &ranked[challenger].0]) < 0.0 {
            ranked[..=challenger].rotate_right(1);
        }
    }
    let over = |(other, _): &(RigidMotion, Tally)| advantage(maps, points, [&ranked[0].0, other]);
    ranked.iter().take(rivals).skip(1).map(over).fold(f64::INFINITY, f64::min)
}

/// By how many standard deviations the first motion explains more than the second.
fn advantage(maps: [&Surfaces<'_>; 2], points: [&[usize]; 2], motions: [&RigidMotion; 2]) -> f64 {
    let there = by_tile(maps, points[0], motions.map(|motion| *motion));
    let back = by_tile([maps[1], maps[0]], points[1], motions.map(RigidMotion::inverse));
    let kinds = [0, 1].map(|kind| {
        let tiles = || there[kind].values().chain(back[kind].values());
        (tiles().sum::<f64>(), tiles().map(|tile| tile * tile).sum::<f64>())
    });
    // Where both motions explain all alike, a kind is no evidence.
    let telling = kinds.iter().filter(|(_, squares)| *squares > 0.0);
    let count = telling.clone().count().max(1) as f64;
    telling.map(|(sum, squares)| sum / squares.sqrt()).sum::<f64>() / count.sqrt()
}

/// What the first motion explains beyond the second, for walls and for all else, by tile of the first map: as shares of
/// its points.
fn by_tile(
    [from, to]: [&Surfaces<'_>; 2],
    points: &[usize],
    motions: [RigidMotion; 2],
) -> [BTreeMap<(i64, i64), f64>; 2] {
    let touch = touch([from, to]);
    let mut tiles = [BTreeMap::new(), BTreeMap::new()];
    for &index in points {
        let [one, other] = motions.map(|motion| Tally::of_point(from, to, index, &motion, touch).rank());
        let tile = (from.points[index] / TILE_M).map(|part| part.floor() as i64);
        let kind = usize::from(!from.is_wall[index]);
        *tiles[kind].entry((tile.x, tile.y)).or_default() += (one - other) / points.len() as f64;
    }
    tiles
}
