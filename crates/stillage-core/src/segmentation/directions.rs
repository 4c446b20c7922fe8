//! Regions by direction: each tile takes the pair of perpendicular directions that its structure is aligned with.
//!
//! Around each tile the occupied cells are projected along every dominant pair of the map, with weights that fall with
//! the distance; the tile takes the pair with the largest radiogram energy. Source: the accuracy study behind this
//! project (0.995 to 1.0 of the places in the right region, without a given number of regions).
//!
//! Departure: walls are left out where there is anything else, since a straight wall has more energy than all the racks
//! beside it, and racks may be turned against their hall. Tiles without structure take the pair of the nearest tile
//! with some, so borders run through the middle of aisles.
//!
//! Cost: O(tiles x cells in the window x pairs). Limits: blocks of the same direction are one region.

use std::f64::consts::FRAC_PI_2;

use rayon::prelude::*;

use super::tiles::{NONE, Tiles};
use crate::geometry::{fold_half_turn, normal};
use crate::grid::OccupancyGrid;
use crate::orientation::Orientations;
use crate::orientation::energy::{OccupiedSample, pair_angle_between};
use crate::spec::RegionOptions;
use crate::walls;
use crate::watch::{Stopped, Watch};

/// Occupied cells of the whole map that are sampled.
const SAMPLE_CELLS: usize = 200_000;
/// Pairs closer than this are one pair, degrees: half the least separation of orientations, which is 6.
const SAME_PAIR_DEG: f64 = 3.0;
/// Radius of the window around a tile, metres.
const WINDOW_M: f64 = 6.0;
/// Standard deviation of the weight of points in the window, metres.
const SIGMA_M: f64 = 3.0;
/// Bin of the projections, metres (accuracy study: 0.05 and no less than a cell).
const BIN_M: f64 = 0.05;
/// Fewest cells in the window that show a direction; 60 in the larger window of the accuracy study.
const LEAST_CELLS: usize = 30;
/// A tile without structure nearer than this has no direction of its own, metres.
const OWN_REACH_M: f64 = 2.0;
/// Factor on `min_share`: pieces of one direction below that share of the known cells are absorbed.
/// No measurement is recorded for this value.
const SHARE_FACTOR: f64 = 0.25;

/// The pairs of directions and the pair of every tile.
pub(super) struct Directions {
    /// One direction of each pair, radians in `[0, pi/2)`.
    pub pairs: Vec<f64>,
    /// Index of the pair of each tile, [`NONE`] outside the known part of the map.
    pub labels: Vec<u8>,
}

/// Finds the pair of directions of every tile.
pub(super) fn by_direction(
    grid: &OccupancyGrid,
    tiles: &Tiles,
    global: &Orientations,
    options: &RegionOptions,
    watch: &Watch<'_>,
) -> Result<Directions, Stopped> {
    let pairs = pairs(global);
    if pairs.len() < 2 {
        return Ok(Directions { pairs, labels: tiles.uniform() });
    }
    let is_wall = walls::find(grid, watch)?;
    let unless_wall = |column: usize, row: usize| (!is_wall[row * grid.width() + column]).then_some(0);
    let goods = OccupiedSample::of_parts(grid, 1, unless_wall, SAMPLE_CELLS, watch)?.swap_remove(0);
    let of_goods = energies(grid, tiles, &goods, &pairs, |_| true, watch)?;
    let all = OccupiedSample::of_parts(grid, 1, |_, _| Some(0), SAMPLE_CELLS, watch)?.swap_remove(0);
    let of_all = energies(grid, tiles, &all, &pairs, |tile| of_goods[tile].is_none(), watch)?;
    let mut labels = vec![NONE; tiles.known.len()];
    for tile in tiles.known_tiles() {
        let best = of_goods[tile].as_ref().or(of_all[tile].as_ref()).map(|energies| {
            (0..energies.len()).fold(0, |best, at| if energies[at] > energies[best] { at } else { best })
        });
        labels[tile] = best.map_or(NONE, |best| best as u8);
    }
    let labels = tiles.filled(&labels);
    let labels = tiles.majority(&tiles.majority(&labels));
    Ok(Directions { pairs, labels: tiles.absorb_small_pieces(&labels, SHARE_FACTOR * options.min_share, false) }
        .renumbered(tiles, &labels))
}

impl Directions {
    /// Brings the pairs into the order of the final labels, which are numbered by their first tiles.
    fn renumbered(self, tiles: &Tiles, before: &[u8]) -> Self {
        let count = self.labels.iter().filter(|&&label| label != NONE).max().map_or(0, |&last| usize::from(last) + 1);
        let mut tiles_of_pairs = vec![vec![0_usize; self.pairs.len()]; count];
        for tile in tiles.known_tiles() {
            tiles_of_pairs[usize::from(self.labels[tile])][usize::from(before[tile])] += 1;
        }
        let most = |tiles_of_pairs: &Vec<usize>| {
            (0..tiles_of_pairs.len()).fold(0, |a, b| if tiles_of_pairs[b] > tiles_of_pairs[a] { b } else { a })
        };
        Self {
            pairs: tiles_of_pairs.iter().map(|tiles_of_pairs| self.pairs[most(tiles_of_pairs)]).collect(),
            labels: self.labels,
        }
    }
}

/// Directions that are not perpendicular to one another, folded to a quarter turn, in the order of the angles.
fn pairs(global: &Orientations) -> Vec<f64> {
    let mut pairs: Vec<f64> = Vec::new();
    for angle in &global.angles {
        let folded = angle.rem_euclid(FRAC_PI_2);
        if pairs.iter().all(|&other| pair_angle_between(folded, other) > SAME_PAIR_DEG.to_radians()) {
            pairs.push(folded);
        }
    }
    pairs.truncate(usize::from(NONE) - 1);
    pairs
}

/// Energy of each pair around each tile that `is_asked` names; `None` where the window holds too little, or nothing
/// near the tile.
fn energies(
    grid: &OccupancyGrid,
    tiles: &Tiles,
    sample: &OccupiedSample,
    pairs: &[f64],
    is_asked: impl Fn(usize) -> bool + Sync,
    watch: &Watch<'_>,
) -> Result<Vec<Option<Vec<f64>>>, Stopped> {
    let side = tiles.tile_cells as f64;
    let mut by_tile: Vec<Vec<[f32; 2]>> = vec![Vec::new(); tiles.known.len()];
    for &[x, y] in sample.points() {
        by_tile[tiles.of_cell(x as usize, y as usize)].push([x, y]);
    }
    let reach = (WINDOW_M / grid.resolution() / side).ceil() as usize;
    (0..tiles.known.len())
        .into_par_iter()
        .map(|tile| {
            if tile % 64 == 0 {
                watch.check()?;
            }
            if !is_asked(tile) {
                return Ok(None);
            }
            let (column, row) = (tile % tiles.columns, tile / tiles.columns);
            let center = [(column as f64 + 0.5) * side, (row as f64 + 0.5) * side];
            let rows = row.saturating_sub(reach)..(row + reach + 1).min(tiles.rows);
            let points = rows.flat_map(|row| {
                (column.saturating_sub(reach)..(column + reach + 1).min(tiles.columns))
                    .flat_map(move |column| [row * tiles.columns + column])
            });
            let mut window = TileWindow::new(grid.resolution());
            for &point in points.flat_map(|tile| &by_tile[tile]) {
                window.add([f64::from(point[0]) - center[0], f64::from(point[1]) - center[1]]);
            }
            Ok(window.energies(pairs))
        })
        .collect()
}

/// The occupied points around a tile.
struct TileWindow {
    /// Side of a cell, metres.
    cell: f64,
    /// Offsets from the tile in metres, and the weight.
    points: Vec<[f64; 3]>,
    /// Whether a point is nearer than [`OWN_REACH_M`].
    is_near: bool,
}

impl TileWindow {
    fn new(cell: f64) -> Self {
        Self { cell, points: Vec::new(), is_near: false }
    }

    /// Adds a point by its offset from the tile, cells.
    fn add(&mut self, offset: [f64; 2]) {
        let [x, y] = offset.map(|value| value * self.cell);
        let distance = x.hypot(y);
        if distance <= WINDOW_M {
            self.is_near |= distance <= OWN_REACH_M;
            self.points.push([x, y, (-0.5 * (distance / SIGMA_M).powi(2)).exp()]);
        }
    }

    /// Energy of each pair; `None` where there are too few points, or none near.
    fn energies(&self, pairs: &[f64]) -> Option<Vec<f64>> {
        if !self.is_near || self.points.len() < LEAST_CELLS {
            return None;
        }
        let bin = BIN_M.max(self.cell);
        let bins = (2.0 * WINDOW_M / bin) as usize + 3;
        let mut counts = vec![0.0; bins];
        let mut energy = |angle: f64| -> f64 {
            counts.fill(0.0);
            let across = normal(angle);
            for &[x, y, weight] in &self.points {
                counts[((across.x * x + across.y * y + WINDOW_M) / bin) as usize + 1] += weight;
            }
            counts.iter().map(|count| count * count).sum()
        };
        Some(pairs.iter().map(|&angle| energy(angle) + energy(angle + FRAC_PI_2)).collect())
    }
}

/// The direction and its perpendicular, as line directions, ascending.
pub(super) fn both(angle: f64) -> Vec<f64> {
    let mut both = [angle, angle + FRAC_PI_2].map(fold_half_turn).to_vec();
    both.sort_by(f64::total_cmp);
    both
}
