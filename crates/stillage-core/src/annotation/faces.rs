//! Measurements of faces: shares of their cells, shape, and the vote L(f) = Mode { L(p) | p in M(f) } (paper, II-B).
//!
//! The vote is over the categorized cells, which are free; ties go to the lower id. (The author's published code takes
//! the median of the labels, which is not the mode for more than two.) A face without a vote is occupied or unknown.
//! Counts are whole numbers, so the result does not depend on the order in which threads add them. Cost: O(cells +
//! corners log corners).

use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::evidence::Evidence;
use super::face_categories::FaceCategories;
use crate::adjacency::pole;
use crate::arrangement::{CellFaces, FaceId, Subdivision};
use crate::categorization::CategoryMap;
use crate::geometry::{OrientedBox, Point, polygon};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::plot::PlotKind;
use crate::segmentation::RegionMap;
use crate::watch::{Stopped, Watch};

/// Occupied cells nearer than this to the border of a face do not count as inside, metres: they may be a post of its
/// own rack or goods of a neighbour that overhang.
const RIM_M: f64 = 0.1;
/// Counts of cells: free, occupied, unknown, and occupied away from the border.
const OCCUPANCY_SLOTS: usize = 4;

/// What is known of a face from its cells and its shape.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FaceAnnotation {
    /// Category in force: a cluster, or `occupied`, `unknown` or `outside` of [`FaceCategories`].
    pub category: u8,
    /// Share of each cluster among the categorized cells of the face (sums to 1, or all 0 without such cells).
    pub category_shares: Vec<f32>,
    /// Distribution over the clusters: the mean membership of its measured cells, or what relaxation made of it. Absent
    /// where it is no other than [`FaceAnnotation::category_shares`]; empty for a face without categorized cells.
    pub membership: Option<Vec<f32>>,
    /// Cells whose centre lies in the face.
    pub cells: usize,
    /// Share of its cells that are free.
    pub free_fraction: f64,
    /// Share of its cells that are occupied.
    pub occupied_fraction: f64,
    /// Share of its cells that are occupied and lie more than a rim of 0.1 m inside its border.
    pub inside_occupied_fraction: f64,
    /// Share of its cells that are unknown (1 for a face without cells).
    pub unknown_fraction: f64,
    /// Area, square metres.
    pub area: f64,
    /// Long side over short side of the smallest-area oriented box around it, at least 1.
    pub elongation: f64,
    /// Direction of the long side of that box, radians in `[-pi/2, pi/2)`.
    pub heading: f64,
    /// Long and short side of that box, metres.
    pub extent: [f64; 2],
    /// Region it lies in.
    pub region: u8,
    /// What it was cut out for; `None` where no plot of the decomposition lies.
    pub kind: Option<PlotKind>,
    /// Share of the category in force among the votes, or in the distribution of the face, 0 to 1.
    pub confidence: f64,
    /// Whether most of its border is observed.
    pub evidence: Evidence,
}

impl FaceAnnotation {
    /// Distribution over the clusters: the membership where there is one, else the shares of the votes.
    #[must_use]
    pub fn distribution(&self) -> &[f32] {
        self.membership.as_ref().filter(|membership| !membership.is_empty()).unwrap_or(&self.category_shares)
    }
}

/// Annotates some faces, or all: by face id, `None` for those that are not selected. Entry 0, the unbounded face, is
/// empty.
pub(super) fn annotate_faces(
    grid: &OccupancyGrid,
    categories: &CategoryMap,
    regions: &RegionMap,
    subdivision: &Subdivision,
    cells: &CellFaces,
    is_selected: impl Fn(FaceId) -> bool + Sync,
    watch: &Watch<'_>,
) -> Result<Vec<Option<FaceAnnotation>>, Stopped> {
    let table = FaceCountTable::count(grid, categories, regions, subdivision, cells, &is_selected, watch)?;
    let annotate = |face: usize| {
        if face.is_multiple_of(256) {
            watch.check()?;
        }
        let face = FaceId(face as u32);
        if !is_selected(face) {
            return Ok(None);
        }
        let rings = if face == FaceId::OUTER { Vec::new() } else { subdivision.rings(face) };
        let mut counts = table.of(face);
        if counts.total() == 0 && face != FaceId::OUTER {
            // No cell centre lies in it: its region is that of a point inside.
            counts.regions[region_slot(regions, region_at(grid, regions, pole(&rings)))] += 1;
        }
        Ok(Some(face_annotation(&counts, &rings, categories)))
    };
    (0..subdivision.face_count()).into_par_iter().map(annotate).collect()
}

pub(super) fn region_at(grid: &OccupancyGrid, regions: &RegionMap, point: Point) -> u8 {
    let region = grid.cell_at(point).and_then(|(column, row)| regions.region_of_cell(column, row));
    region.unwrap_or(RegionMap::NONE)
}

/// The slot in which the cells of a region are counted; the last one is for cells outside all regions.
fn region_slot(regions: &RegionMap, region: u8) -> usize {
    usize::from(region).min(regions.regions.len())
}

/// Counts of one face.
struct FaceCounts {
    categories: Vec<u32>,
    /// Free, occupied, unknown.
    occupancy: [u32; 3],
    /// Occupied, and away from the border.
    inside: u32,
    /// By region, and outside all.
    regions: Vec<u32>,
}

impl FaceCounts {
    fn total(&self) -> u32 {
        self.occupancy.iter().sum()
    }

    fn known(&self) -> u32 {
        self.occupancy[Occupancy::Free as usize] + self.occupancy[Occupancy::Occupied as usize]
    }
}

/// The counts of all faces, in one table that all threads add to.
struct FaceCountTable {
    counts: Vec<AtomicU32>,
    categories: usize,
    regions: usize,
}

impl FaceCountTable {
    fn count(
        grid: &OccupancyGrid,
        categories: &CategoryMap,
        regions: &RegionMap,
        subdivision: &Subdivision,
        cells: &CellFaces,
        is_selected: impl Fn(FaceId) -> bool + Sync,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let (category_count, region_count) = (categories.categories.len(), regions.regions.len() + 1);
        let size = subdivision.face_count() * (category_count + OCCUPANCY_SLOTS + region_count);
        let counts = std::iter::repeat_with(|| AtomicU32::new(0)).take(size).collect();
        let table = Self { counts, categories: category_count, regions: region_count };
        let width = grid.width();
        let rim = (RIM_M / grid.resolution()).round() as usize;
        (0..grid.height()).into_par_iter().try_for_each(|row| {
            watch.check()?;
            let votes = categories.cells.get(row * width..(row + 1) * width).unwrap_or_default();
            let mut votes_by_category = [0; 256];
            for (face, run) in cells.runs(row * width..(row + 1) * width) {
                let columns = run.start - row * width..run.end - row * width;
                if face != FaceId::OUTER && is_selected(face) {
                    let votes = votes.get(columns.clone()).unwrap_or_default();
                    table.add_run(face, votes, &grid.row(row)[columns.clone()], &mut votes_by_category);
                    let is_inside = |&column: &usize| cells.holds_around(face, column, row, rim);
                    let occupied = columns.clone().filter(|&column| grid.row(row)[column] == Occupancy::Occupied);
                    table.add(face, table.categories + 3, occupied.filter(is_inside).count() as u32);
                    table.add_regions(face, regions, row, columns);
                }
            }
            Ok(())
        })?;
        Ok(table)
    }

    fn stride(&self) -> usize {
        self.categories + OCCUPANCY_SLOTS + self.regions
    }

    fn add(&self, face: FaceId, slot: usize, count: u32) {
        if count > 0 {
            // Only sums leave the tasks, and rayon joins them before these are read.
            self.counts[face.index() * self.stride() + slot].fetch_add(count, Ordering::Relaxed);
        }
    }

    /// Adds the cells of a face in one row. `votes_by_category` is working memory, all 0
    /// before and after.
    fn add_run(&self, face: FaceId, votes: &[u8], cells: &[Occupancy], votes_by_category: &mut [u32; 256]) {
        for &vote in votes {
            votes_by_category[usize::from(vote)] += 1;
        }
        for (category, count) in votes_by_category[..self.categories].iter_mut().enumerate() {
            self.add(face, category, std::mem::take(count));
        }
        let count = |occupancy| cells.iter().map(|&cell| u32::from(cell == occupancy)).sum::<u32>();
        let (free, occupied) = (count(Occupancy::Free), count(Occupancy::Occupied));
        let unknown = cells.len() as u32 - free - occupied;
        for (slot, count) in [free, occupied, unknown].into_iter().enumerate() {
            self.add(face, self.categories + slot, count);
        }
    }

    /// Adds the regions of the cells of a face in one row, tile by tile.
    fn add_regions(&self, face: FaceId, regions: &RegionMap, row: usize, columns: std::ops::Range<usize>) {
        let tile = regions.tile_cells.max(1);
        let mut column = columns.start;
        while column < columns.end {
            let end = ((column / tile + 1) * tile).min(columns.end);
            let region = regions.region_of_cell(column, row).unwrap_or(RegionMap::NONE);
            self.add(face, self.categories + OCCUPANCY_SLOTS + region_slot(regions, region), (end - column) as u32);
            column = end;
        }
    }

    fn of(&self, face: FaceId) -> FaceCounts {
        let counts = &self.counts[face.index() * self.stride()..][..self.stride()];
        let counts: Vec<u32> = counts.iter().map(|count| count.load(Ordering::Relaxed)).collect();
        let (categories, rest) = counts.split_at(self.categories);
        let (occupancy, regions) = rest.split_at(OCCUPANCY_SLOTS);
        FaceCounts {
            categories: categories.to_vec(),
            occupancy: [occupancy[0], occupancy[1], occupancy[2]],
            inside: occupancy[3],
            regions: regions.to_vec(),
        }
    }
}

/// Index of the greatest count, the first of equals; `None` if all are 0.
fn mode(counts: &[u32]) -> Option<usize> {
    let most = counts.iter().copied().max().filter(|&most| most > 0)?;
    counts.iter().position(|&count| count == most)
}

fn share(count: u32, of: u32) -> f64 {
    if of == 0 { 0.0 } else { f64::from(count) / f64::from(of) }
}

fn face_annotation(counts: &FaceCounts, rings: &[Vec<Point>], categories: &CategoryMap) -> FaceAnnotation {
    let votes: u32 = counts.categories.iter().sum();
    let [free, occupied, unknown] = counts.occupancy;
    let kinds = FaceCategories::from(categories);
    let (category, confidence) = match mode(&counts.categories) {
        Some(winner) => (winner as u8, share(counts.categories[winner], votes)),
        None if occupied > free => (kinds.occupied(), share(occupied, counts.known())),
        None => (kinds.unknown(), 0.0),
    };
    let smallest_box = OrientedBox::smallest_around(rings.first().map_or(&[], Vec::as_slice));
    let total = counts.total();
    let region = mode(&counts.regions).filter(|&slot| slot + 1 < counts.regions.len());
    FaceAnnotation {
        category,
        category_shares: counts.categories.iter().map(|&count| share(count, votes) as f32).collect(),
        membership: None,
        cells: total as usize,
        free_fraction: share(free, total),
        occupied_fraction: share(occupied, total),
        inside_occupied_fraction: share(counts.inside, total),
        unknown_fraction: if total == 0 { 1.0 } else { share(unknown, total) },
        area: polygon::area(rings),
        elongation: smallest_box.elongation(),
        heading: smallest_box.angle,
        extent: smallest_box.sides(),
        region: region.map_or(RegionMap::NONE, |region| region as u8),
        kind: None,
        confidence,
        evidence: Evidence::Interpolated,
    }
}
