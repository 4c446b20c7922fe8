//! Maps drawn in characters, for tests of the human level.

use crate::adjacency::AdjacencyGraph;
use crate::analysis::Analysis;
use crate::annotation;
use crate::arrangement::{self, CellFaces, EdgeSource, FaceId, SourceSegment};
use crate::categorization::{Categorization, Category, CategoryMap};
use crate::clearance::Clearance;
use crate::clustering::FitReport;
use crate::declutter::Removed;
use crate::geometry::{OrientedBox, Point};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::layout::{Layout, LayoutSpec, layout};
use crate::orientation::Orientations;
use crate::rooms::RoomMap;
use crate::segmentation::{Region, RegionMap};
use crate::semantics::{Assignment, RuleSet, SemanticMap, apply};
use crate::site_map::{SiteCells, SiteMap};
use crate::spec::{AnalysisOptions, AnnotationMethod};
use crate::watch::Watch;

/// Side of a cell, metres: coarse, so that a pallet place is four characters.
pub(crate) const RESOLUTION: f64 = 0.5;

/// Half the width of a vehicle, metres: it fits into an aisle of one cell.
pub(crate) const VEHICLE_RADIUS: f64 = 0.2;

/// An analysis whose faces were drawn: a face for each piece of one letter.
pub(crate) struct DrawnMap {
    pub grid: OccupancyGrid,
    pub analysis: Analysis,
    pub cells: SiteCells,
    /// Letter of every cell, row-major, lowest row first.
    letters: Vec<u8>,
}

/// Letters by category: corridors c and d, junctions j, pallet cells p and q, offices o, anything else.
fn category(letter: u8) -> u8 {
    match letter {
        b'c' | b'd' => 0,
        b'j' => 1,
        b'p' | b'q' => 2,
        b'o' => 3,
        _ => 4,
    }
}

impl DrawnMap {
    /// Draws cells (`#` occupied, `.` free, else unknown) and faces (letters; a space is outside).
    pub fn new(cells: &str, faces: &str) -> Self {
        Self::with_lines(cells, faces, &[])
    }

    /// Draws cells and faces, and cuts the faces along more lines.
    pub fn with_lines(cells: &str, faces: &str, lines: &[[Point; 2]]) -> Self {
        let grid = OccupancyGrid::from_ascii(cells, RESOLUTION);
        let rows: Vec<&[u8]> =
            faces.lines().map(str::trim).filter(|line| !line.is_empty()).map(str::as_bytes).collect();
        assert!(rows.len() == grid.height() && rows.iter().all(|row| row.len() == grid.width()));
        let letters: Vec<u8> = rows.iter().rev().flat_map(|row| row.iter().copied()).collect();
        let mut segments = borders(&letters, grid.width());
        let line = |&[start, end]: &[Point; 2]| SourceSegment { start, end, source: EdgeSource::Boundary };
        segments.extend(lines.iter().map(line));
        let subdivision = arrangement::arrange(&segments, &Watch::unwatched()).unwrap();
        let graph = AdjacencyGraph::dual(&subdivision, &Watch::unwatched()).unwrap();
        let cells = CellFaces::rasterize(&subdivision, grid.width(), grid.height(), RESOLUTION);
        let regions = one_region(&grid);
        let categorization = Categorization { map: categories(&grid, &letters), memberships: None };
        let mut options = AnalysisOptions::default();
        options.annotation.method = AnnotationMethod::Vote;
        let subject = annotation::Subject {
            grid: &grid,
            categorization: &categorization,
            regions: &regions,
            subdivision: &subdivision,
            graph: &graph,
            cells: &cells,
            plots: &[],
            grounds: &[],
        };
        let annotations =
            annotation::annotate(&subject, &options.annotation, options.seed, &Watch::unwatched()).unwrap();
        let analysis = Analysis {
            frame: *grid.frame(),
            width: grid.width(),
            height: grid.height(),
            options,
            clutter: Removed::default(),
            categories: categorization.map,
            orientations: Orientations::default(),
            regions,
            radiograms: Vec::new(),
            lines: Vec::new(),
            subdivision,
            graph,
            rooms: RoomMap::default(),
            faces: annotations.faces,
            face_categories: annotations.categories,
            edges: annotations.edges,
            face_relaxation: None,
            diagnostics: Vec::new(),
        };
        let cells = SiteCells { faces: cells, clearance: Clearance::of(&grid).into() };
        Self { grid, analysis, cells, letters }
    }

    /// Reads the letters as the labels they stand for; faces without free cells are pallet cells.
    pub fn semantic(&self, rule_set: &RuleSet) -> SemanticMap {
        let storage = self.analysis.face_categories.occupied()..=self.analysis.face_categories.unknown();
        let names = ["co", "ju", "pc", "of", "un"];
        let by_letter = names.iter().enumerate().map(|(category, id)| (category as u8, *id));
        let assignment = by_letter
            .chain(storage.map(|category| (category, "pc")))
            .filter(|(_, id)| rule_set.find(id).is_some())
            .map(|(category, id)| (category, id.to_owned()))
            .collect();
        apply(&self.analysis, rule_set, &Assignment { assignment, ..Assignment::default() }).unwrap()
    }

    pub fn layout(&self, semantic: &SemanticMap) -> Layout {
        let spec = LayoutSpec::of(&self.analysis.options);
        layout(&self.site(semantic), &LayoutSpec { vehicle_radius: VEHICLE_RADIUS, ..spec })
    }

    pub fn site<'a>(&'a self, semantic: &'a SemanticMap) -> SiteMap<'a> {
        self.cells.map(&self.grid, &self.analysis, semantic)
    }

    /// The face of the cell at a column and row of the drawing, the first line on top.
    pub fn face_at(&self, column: usize, line: usize) -> FaceId {
        self.cells.faces.at(column, self.grid.height() - 1 - line)
    }

    /// Centre of the cell at a column and row of the drawing, the first line on top.
    pub fn point_at(&self, column: usize, line: usize) -> Point {
        self.grid.center(column, self.grid.height() - 1 - line)
    }

    /// The letter a face was drawn with.
    pub fn letter(&self, face: FaceId) -> char {
        let cell = self.cells.faces.iter().position(|other| other == face);
        cell.map_or('?', |cell| self.letters[cell].into())
    }

    /// A picture with one character per cell, the first line on top.
    pub fn draw(&self, character: impl Fn(usize, usize) -> char) -> String {
        let line = |row| (0..self.grid.width()).map(|column| character(column, row)).collect::<String>() + "\n";
        (0..self.grid.height()).rev().map(line).collect()
    }
}

/// The borders between different letters, each as long as it lies between the same two.
fn borders(letters: &[u8], width: usize) -> Vec<SourceSegment> {
    let height = letters.len() / width;
    // One cell of outside all around.
    let at = |column: usize, row: usize| {
        let inside = (1..=width).contains(&column) && (1..=height).contains(&row);
        if inside { letters[(row - 1) * width + column - 1] } else { b' ' }
    };
    let corner = |column: usize, row: usize| Point::new(column as f64, row as f64) * RESOLUTION;
    let mut segments = Vec::new();
    let mut runs = |pairs: Vec<(u8, u8)>, corner: &dyn Fn(usize) -> Point| {
        let mut start = 0;
        for run in pairs.chunk_by(|first, second| first == second) {
            let end = start + run.len();
            if run[0].0 != run[0].1 {
                let (start, end) = (corner(start), corner(end));
                segments.push(SourceSegment { start, end, source: EdgeSource::Boundary });
            }
            start = end;
        }
    };
    for row in 0..=height {
        let pairs = (1..=width).map(|column| (at(column, row), at(column, row + 1))).collect();
        runs(pairs, &|column| corner(column, row));
    }
    for column in 0..=width {
        let pairs = (1..=height).map(|row| (at(column, row), at(column + 1, row))).collect();
        runs(pairs, &|row| corner(column, row));
    }
    segments
}

fn categories(grid: &OccupancyGrid, letters: &[u8]) -> CategoryMap {
    let cells: Vec<u8> = letters
        .iter()
        .zip(grid.cells())
        .map(|(&letter, &cell)| if cell == Occupancy::Free { category(letter) } else { CategoryMap::NONE })
        .collect();
    let mut categories = vec![Category { cells: 0, mean_features: Vec::new() }; 5];
    for &cell in cells.iter().filter(|&&cell| cell != CategoryMap::NONE) {
        categories[usize::from(cell)].cells += 1;
    }
    CategoryMap { cells, categories, feature_names: Vec::new(), fit: FitReport::default(), relaxation: None }
}

fn one_region(grid: &OccupancyGrid) -> RegionMap {
    let tile_cells = grid.width().max(grid.height()).max(1);
    let far = Point::new(grid.width() as f64, grid.height() as f64) * RESOLUTION;
    let bounds = OrientedBox::around([Point::origin(), far], 0.0).unwrap();
    let region = Region { orientations: vec![0.0], bounds, share: 1.0 };
    RegionMap { tile_cells, columns: 1, rows: 1, tiles: vec![0], regions: vec![region] }
}
