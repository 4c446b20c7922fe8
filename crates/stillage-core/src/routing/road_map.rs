//! The portals of all tiles and the ways between them: a graph that is searched in place of the cells.
//!
//! Cost: O(cells) where portals of a tile see each other, O(portals x cells of the tile) where they do not; tiles in
//! parallel. Memory: 4 bytes for each pair of portals of a tile, and the bends of ways.

use std::collections::BTreeSet;

use rayon::prelude::*;

use super::drive_grid::DriveGrid;
use super::sight::Sight;
use super::tile_search::TileSearch;
use super::tile_ways::{PortalId, TilePortal, TileWays};
use super::tiles::{Border, SearchTiles};
use crate::geometry::DisjointSets;

/// Portals and the ways between them.
#[derive(Debug, Clone)]
pub(super) struct RoadMap {
    pub tiles: SearchTiles,
    /// By border.
    of_borders: Vec<Vec<[u32; 2]>>,
    /// By number: border by border.
    portals: Vec<Portal>,
    /// By tile.
    ways: Vec<TileWays>,
    /// By portal: the smallest number of those that are connected with it.
    components: Vec<u32>,
    /// The number of the largest of them.
    hub: u32,
}

/// A pair of cells on both sides of a border.
#[derive(Debug, Clone, Copy)]
struct Portal {
    /// The cell on the side of the border's first tile and the one beyond.
    cells: [u32; 2],
    /// Their tiles.
    tiles: [u32; 2],
}

impl RoadMap {
    pub fn new(grid: &DriveGrid) -> Self {
        let tiles = SearchTiles::of(grid);
        let borders = (0..2 * tiles.count()).into_par_iter();
        let of_borders = borders.map(|border| tiles.portals(grid, Border(border))).collect();
        let mut map = Self { tiles, of_borders, portals: Vec::new(), ways: Vec::new(), components: Vec::new(), hub: 0 };
        let firsts = map.number_portals();
        map.ways = map.ways_of(grid, &firsts, &(0..tiles.count()).collect::<Vec<_>>());
        (map.components, map.hub) = map.find_components();
        map
    }

    /// The same map after the cells of some tiles changed.
    pub fn renewed(&self, grid: &DriveGrid, changed: &BTreeSet<usize>) -> Self {
        let mut map = self.clone();
        let borders: BTreeSet<Border> = changed.iter().flat_map(|&tile| map.tiles.borders(tile)).collect();
        for &border in &borders {
            map.of_borders[border.0] = map.tiles.portals(grid, border);
        }
        let firsts = map.number_portals();
        let sides = borders.iter().filter_map(|&border| map.tiles.sides(border)).flatten();
        let touched: BTreeSet<usize> = sides.chain(changed.iter().copied()).collect();
        for tile in (0..map.tiles.count()).filter(|tile| !touched.contains(tile)) {
            let portals = map.portals_of(&firsts, tile);
            map.ways[tile].portals = portals;
        }
        let touched: Vec<usize> = touched.into_iter().collect();
        for (&tile, ways) in touched.iter().zip(map.ways_of(grid, &firsts, &touched)) {
            map.ways[tile] = ways;
        }
        (map.components, map.hub) = map.find_components();
        map
    }

    /// Numbers the portals; answers the first number of each border.
    fn number_portals(&mut self) -> Vec<u32> {
        self.portals.clear();
        let mut firsts = Vec::with_capacity(self.of_borders.len());
        for (border, cells) in self.of_borders.iter().enumerate() {
            firsts.push(self.portals.len() as u32);
            let Some(tiles) = self.tiles.sides(Border(border)) else { continue };
            let tiles = tiles.map(|tile| tile as u32);
            self.portals.extend(cells.iter().map(|&cells| Portal { cells, tiles }));
        }
        firsts
    }

    fn ways_of(&self, grid: &DriveGrid, firsts: &[u32], tiles: &[usize]) -> Vec<TileWays> {
        let sight = Sight { grid, clearance: &[], preferred: 0 };
        let ways = |search: &mut TileSearch, &tile: &usize| {
            TileWays::find(self.portals_of(firsts, tile), tile, &self.tiles, sight, search)
        };
        tiles.par_iter().map_init(TileSearch::new, ways).collect()
    }

    fn portals_of(&self, firsts: &[u32], tile: usize) -> Vec<TilePortal> {
        let mut found = Vec::new();
        for border in self.tiles.borders(tile) {
            let side = usize::from(border.0 / 2 != tile);
            let portals = (firsts[border.0]..).zip(&self.of_borders[border.0]);
            found.extend(portals.map(|(id, cells)| TilePortal { id: PortalId(id), cell: cells[side] as usize }));
        }
        found
    }

    /// The ways through a tile.
    pub fn ways(&self, tile: usize) -> &TileWays {
        &self.ways[tile]
    }

    /// The tiles on both sides of a portal.
    pub fn sides(&self, portal: PortalId) -> [usize; 2] {
        self.portals[portal.index()].tiles.map(|tile| tile as usize)
    }

    /// The cells of a portal: on the side of its first tile, and beyond.
    pub fn cells(&self, portal: PortalId) -> [usize; 2] {
        self.portals[portal.index()].cells.map(|cell| cell as usize)
    }

    /// How many portals there are; they are numbered from 0.
    pub fn count(&self) -> usize {
        self.portals.len()
    }

    /// A number that connected portals share.
    pub fn component(&self, portal: PortalId) -> u32 {
        self.components[portal.index()]
    }

    /// A portal of the largest component; 0 where there is no portal.
    pub fn hub(&self) -> u32 {
        self.hub
    }

    /// Whether a cell is a portal of the largest component.
    pub fn is_hub(&self, cell: usize) -> bool {
        self.tiles.is_on_border(cell) && {
            let portals = &self.ways[self.tiles.of_cell(cell)].portals;
            portals.iter().any(|portal| portal.cell == cell && self.component(portal.id) == self.hub)
        }
    }

    /// The components, and the largest.
    fn find_components(&self) -> (Vec<u32>, u32) {
        let mut sets = DisjointSets::new(self.count());
        for ways in &self.ways {
            for (place, from) in ways.portals.iter().enumerate() {
                for (to, length) in ways.portals.iter().zip(ways.lengths_from(place)) {
                    if length.is_finite() {
                        sets.join(from.id.index(), to.id.index());
                    }
                }
            }
        }
        let components: Vec<u32> = (0..self.count()).map(|portal| sets.find(portal) as u32).collect();
        let mut sizes = vec![0_usize; components.len()];
        for &component in &components {
            sizes[component as usize] += 1;
        }
        // Of equals the one with the smallest number.
        let hub = (0..components.len()).rev().max_by_key(|&component| sizes[component]);
        (components, hub.unwrap_or(0) as u32)
    }
}
