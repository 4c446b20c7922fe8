//! What `layout`, `graph` and `routing` read of a map.

use std::sync::Arc;

use crate::analysis::Analysis;
use crate::arrangement::{CellFaces, FaceId};
use crate::clearance::Clearance;
use crate::geometry::Point;
use crate::grid::OccupancyGrid;
use crate::semantics::SemanticMap;

/// An analysed and labelled map with its cells. Points lie in the grid frame.
#[derive(Debug, Clone, Copy)]
pub struct SiteMap<'a> {
    /// The cells.
    pub grid: &'a OccupancyGrid,
    /// The face of every cell.
    pub cells: &'a CellFaces,
    /// How far every cell is from the nearest obstacle.
    pub clearance: &'a Clearance,
    /// The geometric level.
    pub analysis: &'a Analysis,
    /// The human level.
    pub semantic: &'a SemanticMap,
}

/// What is read off the cells of an analysed map once: O(cells).
#[derive(Debug, Clone, PartialEq)]
pub struct SiteCells {
    /// The face of every cell.
    pub faces: CellFaces,
    /// How far every cell is from the nearest obstacle, whatever the faces are.
    pub clearance: Arc<Clearance>,
}

impl SiteCells {
    /// Reads the cells of a map.
    #[must_use]
    pub fn of(grid: &OccupancyGrid, analysis: &Analysis) -> Self {
        Self { faces: CellFaces::of_grid(&analysis.subdivision, grid), clearance: Arc::new(Clearance::of(grid)) }
    }

    /// The map with these cells.
    #[must_use]
    pub fn map<'a>(
        &'a self,
        grid: &'a OccupancyGrid,
        analysis: &'a Analysis,
        semantic: &'a SemanticMap,
    ) -> SiteMap<'a> {
        SiteMap { grid, cells: &self.faces, clearance: &self.clearance, analysis, semantic }
    }
}

impl SiteMap<'_> {
    /// The face that holds a point; [`FaceId::OUTER`] outside the decomposed part of the map.
    #[must_use]
    pub fn face_at(&self, point: Point) -> FaceId {
        self.grid.cell_at(point).map_or(FaceId::OUTER, |(column, row)| self.cells.at(column, row))
    }

    /// Whether vehicles may drive on a face.
    #[must_use]
    pub fn is_drivable(&self, face: FaceId) -> bool {
        face != FaceId::OUTER && face.index() < self.semantic.labels.len() && self.semantic.label(face).is_drivable()
    }
}
