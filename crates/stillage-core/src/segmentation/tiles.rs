//! Labels on tiles: smoothing, contiguous pieces, and the absorption of small pieces.
//!
//! Cost: O(tiles) for each operation, times the kernel for [`Tiles::smoothed`].

use std::collections::VecDeque;

use rayon::prelude::*;

use super::region_map::RegionMap;
use crate::grid::{Occupancy, OccupancyGrid};

/// No label: outside the known part of the map, or not decided yet.
pub(super) const NONE: u8 = RegionMap::NONE;
/// Most regions that have a number.
const MOST_REGIONS: usize = NONE as usize;
/// Least side of a tile, metres: the pixel of the Gabor texture.
const MIN_TILE_M: f64 = 0.4;

/// A grid cut into squares.
pub(super) struct Tiles {
    /// Side of a tile, cells.
    pub tile_cells: usize,
    pub columns: usize,
    pub rows: usize,
    /// Number of known cells per tile, row-major.
    pub known: Vec<u32>,
}

impl Tiles {
    pub(super) fn new(grid: &OccupancyGrid, tile_m: f64) -> Self {
        let tile_cells = ((tile_m.max(MIN_TILE_M) / grid.resolution()).round() as usize).max(1);
        let (columns, rows) = (grid.width().div_ceil(tile_cells), grid.height().div_ceil(tile_cells));
        let row_of_tiles = |row: usize| {
            let mut known = vec![0; columns];
            for row in row * tile_cells..((row + 1) * tile_cells).min(grid.height()) {
                for (known, cells) in known.iter_mut().zip(grid.row(row).chunks(tile_cells)) {
                    *known += cells.iter().filter(|&&cell| cell != Occupancy::Unknown).count() as u32;
                }
            }
            known
        };
        let known = (0..rows).into_par_iter().flat_map_iter(row_of_tiles).collect();
        Self { tile_cells, columns, rows, known }
    }

    /// The tile that holds a cell.
    pub(super) fn of_cell(&self, column: usize, row: usize) -> usize {
        row / self.tile_cells * self.columns + column / self.tile_cells
    }

    /// Indices of the tiles with known cells.
    pub(super) fn known_tiles(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.known.len()).filter(|&tile| self.known[tile] > 0)
    }

    /// The same label on every known tile.
    pub(super) fn uniform(&self) -> Vec<u8> {
        self.known.iter().map(|&known| if known > 0 { 0 } else { NONE }).collect()
    }

    /// Gaussian mean over the known tiles, `sigma` in tiles; zero on tiles without known cells.
    pub(super) fn smoothed(&self, values: &[f32], sigma: f64) -> Vec<f32> {
        let reach = (3.0 * sigma).ceil() as usize;
        let kernel: Vec<f32> =
            (0..=reach).map(|offset| (-0.5 * (offset as f64 / sigma).powi(2)).exp() as f32).collect();
        let weights: Vec<f32> = self.known.iter().map(|&known| f32::from(u8::from(known > 0))).collect();
        let weighted: Vec<f32> = values.iter().zip(&weights).map(|(value, weight)| value * weight).collect();
        let sums = self.blurred(&weighted, &kernel);
        let shares = self.blurred(&weights, &kernel);
        let mean = |tile: usize| if weights[tile] > 0.0 { sums[tile] / shares[tile] } else { 0.0 };
        (0..values.len()).map(mean).collect()
    }

    /// Weighted sums along rows, then along columns; `kernel` is one half of a symmetric kernel, middle first.
    fn blurred(&self, values: &[f32], kernel: &[f32]) -> Vec<f32> {
        let mut along = vec![0.0; values.len()];
        for (sums, row) in along.chunks_exact_mut(self.columns).zip(values.chunks_exact(self.columns)) {
            for (column, &value) in row.iter().enumerate().filter(|&(_, &value)| value != 0.0) {
                for (offset, weight) in kernel.iter().enumerate() {
                    if let Some(left) = column.checked_sub(offset).filter(|_| offset > 0) {
                        sums[left] += value * weight;
                    }
                    if column + offset < self.columns {
                        sums[column + offset] += value * weight;
                    }
                }
            }
        }
        let mut both = vec![0.0; values.len()];
        for (row, sums) in both.chunks_exact_mut(self.columns).enumerate() {
            let reach = kernel.len() - 1;
            for other in row.saturating_sub(reach)..(row + reach + 1).min(self.rows) {
                let weight = kernel[row.abs_diff(other)];
                for (sum, value) in sums.iter_mut().zip(&along[other * self.columns..]) {
                    *sum += weight * value;
                }
            }
        }
        both
    }

    /// The tiles beside, below and above a tile.
    fn neighbours(&self, tile: usize) -> impl Iterator<Item = usize> {
        let (column, row) = (tile % self.columns, tile / self.columns);
        let below = (row > 0).then(|| tile - self.columns);
        let left = (column > 0).then(|| tile - 1);
        let right = (column + 1 < self.columns).then_some(tile + 1);
        let above = (row + 1 < self.rows).then_some(tile + self.columns);
        [below, left, right, above].into_iter().flatten()
    }

    /// Each labelled tile takes the most frequent label of the 3 x 3 tiles around it; in a tie its own, else the
    /// lowest.
    pub(super) fn majority(&self, labels: &[u8]) -> Vec<u8> {
        let vote = |tile: usize| {
            let (column, row) = (tile % self.columns, tile / self.columns);
            let mut votes = [0_u8; NONE as usize];
            for row in row.saturating_sub(1)..(row + 2).min(self.rows) {
                for column in column.saturating_sub(1)..(column + 2).min(self.columns) {
                    if let Some(votes) = votes.get_mut(usize::from(labels[row * self.columns + column])) {
                        *votes += 1;
                    }
                }
            }
            let own = labels[tile];
            let better =
                |best: u8, label: u8| if votes[usize::from(label)] > votes[usize::from(best)] { label } else { best };
            (0..NONE).fold(own, better)
        };
        (0..labels.len()).map(|tile| if labels[tile] == NONE { NONE } else { vote(tile) }).collect()
    }

    /// Splits labels into contiguous pieces; small pieces take the label of the nearest large one.
    ///
    /// A piece is large when it holds at least `min_share` of the known cells; the largest always is. With `split` each
    /// large piece becomes a region of its own, else the large pieces of one label are one region. Regions are numbered
    /// by their first tile.
    pub(super) fn absorb_small_pieces(&self, labels: &[u8], min_share: f64, split: bool) -> Vec<u8> {
        let (piece_of, mut pieces) = self.pieces(labels);
        let total: u64 = self.known.iter().map(|&known| u64::from(known)).sum();
        pieces.sort_by(|one, other| other.known.cmp(&one.known).then(one.first.cmp(&other.first)));
        let enough = |piece: &TilePiece| piece.known as f64 >= min_share * total as f64;
        let large = pieces.iter().take(MOST_REGIONS).take_while(|piece| enough(piece)).count().max(1);
        let mut region_of_piece = vec![NONE; pieces.len()];
        for (rank, piece) in pieces.iter().take(large).enumerate() {
            region_of_piece[piece.index] = if split { rank as u8 } else { labels[piece.first] };
        }
        let mut regions: Vec<u8> =
            piece_of.iter().map(|piece| piece.map_or(NONE, |piece| region_of_piece[piece])).collect();
        self.fill_from_nearest(&mut regions);
        renumber(&mut regions);
        regions
    }

    /// Contiguous tiles of one label: the piece of each tile, and the pieces by index.
    fn pieces(&self, labels: &[u8]) -> (Vec<Option<usize>>, Vec<TilePiece>) {
        let mut piece_of = vec![None; labels.len()];
        let mut pieces: Vec<TilePiece> = Vec::new();
        for first in 0..labels.len() {
            if labels[first] == NONE || piece_of[first].is_some() {
                continue;
            }
            let index = pieces.len();
            let mut known = 0;
            let mut open = vec![first];
            piece_of[first] = Some(index);
            while let Some(tile) = open.pop() {
                known += u64::from(self.known[tile]);
                for next in self.neighbours(tile) {
                    if labels[next] == labels[first] && piece_of[next].is_none() {
                        piece_of[next] = Some(index);
                        open.push(next);
                    }
                }
            }
            pieces.push(TilePiece { index, first, known });
        }
        (piece_of, pieces)
    }

    /// Every known tile with the label of the nearest tile that has one; all 0 where none has.
    pub(super) fn filled(&self, labels: &[u8]) -> Vec<u8> {
        if labels.iter().all(|&label| label == NONE) {
            return self.uniform();
        }
        let mut filled = labels.to_vec();
        self.fill_from_nearest(&mut filled);
        filled
    }

    /// Gives every known tile without a label that of the nearest tile with one, counted in steps over any tiles.
    fn fill_from_nearest(&self, labels: &mut [u8]) {
        let mut reached = labels.to_vec();
        let mut open: VecDeque<usize> = (0..reached.len()).filter(|&tile| reached[tile] != NONE).collect();
        while let Some(tile) = open.pop_front() {
            for next in self.neighbours(tile) {
                if reached[next] == NONE {
                    reached[next] = reached[tile];
                    open.push_back(next);
                }
            }
        }
        for tile in self.known_tiles() {
            labels[tile] = reached[tile];
        }
    }
}

/// A contiguous set of tiles.
struct TilePiece {
    index: usize,
    /// Its lowest tile.
    first: usize,
    /// Known cells.
    known: u64,
}

/// Numbers labels from 0 in the order of their first tiles.
fn renumber(labels: &mut [u8]) {
    let mut numbers = [NONE; NONE as usize];
    let mut next = 0;
    for label in labels.iter_mut().filter(|label| **label != NONE) {
        let number = &mut numbers[usize::from(*label)];
        if *number == NONE {
            *number = next;
            next += 1;
        }
        *label = *number;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads labels from digits, one tile per character, first line on top; anything else is unknown.
    fn tiles(picture: &str) -> (Tiles, Vec<u8>) {
        let rows: Vec<&str> = picture.split_whitespace().rev().collect();
        let labels: Vec<u8> = rows
            .iter()
            .flat_map(|row| row.bytes())
            .map(|byte| if byte.is_ascii_digit() { byte - b'0' } else { NONE })
            .collect();
        let known = labels.iter().map(|&label| u32::from(label != NONE)).collect();
        (Tiles { tile_cells: 1, columns: rows[0].len(), rows: rows.len(), known }, labels)
    }

    fn picture(tiles: &Tiles, labels: &[u8]) -> String {
        let character = |&label: &u8| if label == NONE { '-' } else { char::from(b'0' + label) };
        let rows: Vec<String> =
            labels.chunks(tiles.columns).rev().map(|row| row.iter().map(character).collect()).collect();
        rows.join("\n")
    }

    #[test]
    fn a_lone_tile_follows_its_neighbours() {
        let (tiles, labels) = tiles("0001 0101 0011");
        expect_test::expect![[r"
            0001
            0011
            0011"]]
        .assert_eq(&picture(&tiles, &tiles.majority(&labels)));
    }

    #[test]
    fn small_pieces_are_absorbed_and_large_ones_split() {
        let (tiles, labels) = tiles("555-333 515-333 555-333 55522-5 5552255");
        expect_test::expect![[r"
            000-111
            000-111
            000-111
            00001-1
            0000011"]]
        .assert_eq(&picture(&tiles, &tiles.absorb_small_pieces(&labels, 0.2, true)));
        expect_test::expect![[r"
            000-333
            000-333
            000-333
            00011-2
            0001122"]]
        .assert_eq(&picture(&tiles, &tiles.absorb_small_pieces(&labels, 0.09, true)));
        expect_test::expect![[r"
            000-222
            000-222
            000-222
            00011-0
            0001100"]]
        .assert_eq(&picture(&tiles, &tiles.absorb_small_pieces(&labels, 0.09, false)));
    }

    #[test]
    fn a_mean_over_known_tiles_ignores_the_others() {
        let (tiles, _) = tiles("00-0");
        let smooth = tiles.smoothed(&[2.0, 2.0, 99.0, 2.0], 1.5);
        assert!(
            smooth.iter().zip([2.0, 2.0, 0.0, 2.0]).all(|(value, wanted): (&f32, f32)| (value - wanted).abs() < 1e-5)
        );
    }

    #[test]
    fn more_pieces_than_numbers_still_become_regions() {
        let columns = 40;
        let labels: Vec<u8> =
            (0..columns * columns).map(|tile| ((tile / columns + tile % columns) % 2) as u8).collect();
        let tiles = Tiles { tile_cells: 1, columns, rows: columns, known: vec![1; labels.len()] };
        let regions = tiles.absorb_small_pieces(&labels, 0.0, true);
        assert_eq!(regions.iter().copied().max(), Some(NONE - 1));
    }
}
