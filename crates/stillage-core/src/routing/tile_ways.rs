//! The ways between the portals of one tile.

use super::sight::{self, Sight};
use super::tile_search::TileSearch;
use super::tiles::SearchTiles;
use crate::geometry::Point;

/// The number of a portal in its road map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct PortalId(pub u32);

impl PortalId {
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A portal as seen from a tile: its number, and its cell in the tile.
#[derive(Debug, Clone, Copy)]
pub(super) struct TilePortal {
    pub id: PortalId,
    pub cell: usize,
}

/// The portals of a tile and the ways between them, pulled tight.
#[derive(Debug, Clone, Default)]
pub(super) struct TileWays {
    pub portals: Vec<TilePortal>,
    /// Lengths between the portals, metres, row by row; infinite where no way leads through the tile.
    lengths: Vec<f32>,
    /// The cells where ways bend that are not straight: (first portal, second portal, cells), ascending.
    bends: Vec<(u8, u8, Box<[u32]>)>,
}

impl TileWays {
    pub fn find(
        portals: Vec<TilePortal>,
        tile: usize,
        tiles: &SearchTiles,
        sight: Sight<'_>,
        search: &mut TileSearch,
    ) -> Self {
        let count = portals.len();
        let mut ways = Self { portals, lengths: vec![f32::INFINITY; count * count], bends: Vec::new() };
        for from in 0..count {
            ways.set_length(from, from, 0.0);
            let mut is_searched = false;
            for to in from + 1..count {
                let [start, end] = [from, to].map(|place| ways.portals[place].cell);
                let [first, last] = [start, end].map(|cell| sight.grid.center(cell));
                if sight.sees(first, last) {
                    // Half a cell from the middle of each portal.
                    ways.set_length(from, to, (last - first).norm() + sight.grid.resolution);
                    continue;
                }
                if !std::mem::replace(&mut is_searched, true) {
                    search.run(sight.grid, tiles.window(tile), start);
                }
                if search.length_to(end).is_some() {
                    let pulled = pull(start, &search.path_to(end), sight);
                    let points: Vec<Point> = pulled.iter().map(|&cell| sight.grid.center(cell)).collect();
                    ways.set_length(from, to, sight::length(&points) + sight.grid.resolution);
                    let bends = pulled[1..pulled.len() - 1].iter().map(|&cell| cell as u32).collect();
                    ways.bends.push((from as u8, to as u8, bends));
                }
            }
        }
        ways
    }

    fn set_length(&mut self, from: usize, to: usize, length: f64) {
        let count = self.portals.len();
        self.lengths[from * count + to] = length as f32;
        self.lengths[to * count + from] = length as f32;
    }

    /// Lengths from one of the portals to all of them, metres.
    pub fn lengths_from(&self, place: usize) -> &[f32] {
        &self.lengths[place * self.portals.len()..(place + 1) * self.portals.len()]
    }

    /// The place of a portal among those of the tile.
    pub fn place_of(&self, portal: PortalId) -> Option<usize> {
        self.portals.iter().position(|other| other.id == portal)
    }

    /// The cells where the way between two portals bends.
    pub fn bends(&self, from: usize, to: usize) -> impl DoubleEndedIterator<Item = usize> + '_ {
        let (low, high) = (from.min(to) as u8, from.max(to) as u8);
        let found = self.bends.binary_search_by_key(&(low, high), |&(low, high, _)| (low, high));
        found.into_iter().flat_map(|index| self.bends[index].2.iter().map(|&cell| cell as usize))
    }
}

/// The cells of a path that are left when it is pulled tight.
pub(super) fn pull(start: usize, path: &[usize], sight: Sight<'_>) -> Vec<usize> {
    let points: Vec<Point> = std::iter::once(&start).chain(path).map(|&cell| sight.grid.center(cell)).collect();
    let pulled = sight.pull(&points);
    pulled.into_iter().map(|point| sight.grid.cell_at(point).expect("points of a path lie on the grid")).collect()
}
