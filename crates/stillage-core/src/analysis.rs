//! The geometric level of the paper's Fig. 2 in one call.

use serde::{Deserialize, Serialize};

use crate::adjacency::AdjacencyGraph;
use crate::annotation::{self, EdgeAnnotation, FaceAnnotation, FaceCategories};
use crate::arrangement::{self, CellFaces, Subdivision};
use crate::categorization::{self, CategoryMap};
use crate::declutter;
use crate::grid::{GridFrame, Occupancy, OccupancyGrid};
use crate::hatching;
use crate::line::Line;
use crate::orientation::{self, Orientations};
use crate::radiography::{self, Radiogram};
use crate::relaxation::RelaxationReport;
use crate::rooms::RoomMap;
use crate::segmentation::{self, RegionMap};
use crate::site_plan::{self, SitePlan};
use crate::spec::{AnalysisOptions, AnalysisSpec, DecompositionMethod};
use crate::stage_shares::{CellCounts, StageShares};
use crate::surroundings::{self, PaintedGround};
use crate::watch::{Stage, Stopped, Watch};

/// Version of the algorithms: part of the address of a stored analysis, raised whenever results change.
pub const ALGORITHM_VERSION: u32 = 13;

/// What the geometric level finds in a map. Immutable; addressed by grid, options and [`ALGORITHM_VERSION`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Analysis {
    /// Pose and resolution of the grid.
    pub frame: GridFrame,
    /// Columns of the grid.
    pub width: usize,
    /// Rows of the grid.
    pub height: usize,
    /// The options, whole.
    pub options: AnalysisOptions,
    /// What the first stage removed as clutter.
    pub clutter: declutter::Removed,
    /// Cell -> category.
    pub categories: CategoryMap,
    /// Dominant orientations of the whole map.
    pub orientations: Orientations,
    /// Cell -> region, with the orientations of each.
    pub regions: RegionMap,
    /// Projections along the orientations of each region.
    pub radiograms: Vec<Radiogram>,
    /// Lines, by id.
    pub lines: Vec<Line>,
    /// Vertices, edges, faces.
    pub subdivision: Subdivision,
    /// The dual of the subdivision.
    pub graph: AdjacencyGraph,
    /// Rooms of the faces, and the doors between them.
    pub rooms: RoomMap,
    /// What is known of each face, by face id (entry 0, the unbounded face, is empty).
    pub faces: Vec<FaceAnnotation>,
    /// The categories that faces may have.
    pub face_categories: FaceCategories,
    /// What is known of each edge, by edge id.
    pub edges: Vec<EdgeAnnotation>,
    /// What the relaxation of the faces did, where it was asked for.
    pub face_relaxation: Option<RelaxationReport>,
    /// What the user should know about this result.
    pub diagnostics: Vec<Diagnostic>,
}

/// A remark on a result that is valid but may surprise.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Diagnostic {
    /// Stable, for programs: `no-free-cells`, `no-orientation`, `no-lines`, ...
    pub code: String,
    /// For people: what it is, and how to correct it.
    pub message: String,
}

impl Diagnostic {
    /// A remark with a stable code.
    #[must_use]
    pub fn new(code: &str, message: impl Into<String>) -> Self {
        Self { code: code.to_owned(), message: message.into() }
    }
}

/// What is said of hatched areas.
const HATCHED: &str = "areas that the drawing hatches are read as solid: draw their outline alone where they are free";

/// Runs every stage on a grid.
///
/// Fails only when it is stopped: a map without structure gives one face and a [`Diagnostic`].
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn analyze(grid: &OccupancyGrid, spec: &AnalysisSpec, watch: &Watch<'_>) -> Result<Analysis, Stopped> {
    let options = spec.options();
    watch.begin(&StageShares::estimate(&CellCounts::of(grid), options));
    let is_adaptive = options.decomposition.method == DecompositionMethod::Adaptive;
    let (solid, surroundings, declutter::Decluttered { grid: clean, removed: clutter }) =
        watch.stage(Stage::Declutter, || {
            let solid = if is_adaptive { hatching::solid(grid, watch)? } else { None };
            let grid = solid.as_ref().unwrap_or(grid);
            let surroundings = if is_adaptive { surroundings::find(grid, watch)? } else { None };
            let grid = surroundings.as_ref().map_or(grid, |found| &found.grid);
            let decluttered = declutter::declutter(grid, &options.declutter, watch)?;
            Ok((solid, surroundings, decluttered))
        })?;
    let grid = &clean;
    let categorization = categorization::categorize(grid, &options.categorization, options.seed, watch)?;
    let orientations =
        watch.stage(Stage::Orientation, || orientation::dominant_orientations(grid, &options.orientation, watch))?;
    let regions = watch.stage(Stage::Regions, || segmentation::segment(grid, &orientations, options, watch))?;
    let (radiograms, lines) =
        watch.stage(Stage::Radiography, || radiography::lines(grid, &regions, &options.decomposition, watch))?;
    let SitePlan { lines, plots, rooms, vehicles_m } = match options.decomposition.method {
        DecompositionMethod::Adaptive => site_plan::plan(grid, &regions, &options.decomposition, watch)?,
        DecompositionMethod::Paper => SitePlan { lines, ..SitePlan::default() },
    };
    let subdivision = watch.stage(Stage::Arrangement, || {
        let segments = arrangement::source_segments(grid, &regions, &lines, &rooms.cells, watch)?;
        let subdivision = arrangement::arrange(&segments, watch)?;
        let grounds = if rooms.count == 0 {
            Vec::new()
        } else {
            rooms.of_faces(subdivision.face_count(), &CellFaces::of_grid(&subdivision, grid), watch)?
        };
        let planned = annotation::PlannedGround { plots: &plots, grounds: &grounds };
        annotation::merge_alike(grid, &regions, subdivision, planned, &options.annotation, watch)
    })?;
    let graph = AdjacencyGraph::dual(&subdivision, watch)?;
    let cells = CellFaces::of_grid(&subdivision, grid);
    let grounds = rooms.of_faces(subdivision.face_count(), &cells, watch)?;
    let rooms = RoomMap::of(&rooms, &subdivision, &grounds);
    let annotations = watch.stage(Stage::Annotation, || {
        let subject = annotation::Subject {
            grid,
            categorization: &categorization,
            regions: &regions,
            subdivision: &subdivision,
            graph: &graph,
            cells: &cells,
            plots: &plots,
            grounds: &grounds,
        };
        annotation::annotate(&subject, &options.annotation, options.seed, watch)
    })?;
    let mut analysis = Analysis {
        frame: *grid.frame(),
        width: grid.width(),
        height: grid.height(),
        options: options.clone(),
        clutter,
        categories: categorization.map,
        orientations,
        regions,
        radiograms,
        lines,
        subdivision,
        graph,
        rooms,
        faces: annotations.faces,
        face_categories: annotations.categories,
        edges: annotations.edges,
        face_relaxation: annotations.relaxation,
        diagnostics: Vec::new(),
    };
    analysis.diagnostics = diagnose(grid, &analysis);
    analysis.diagnostics.extend(vehicle_remark(&vehicles_m));
    analysis.diagnostics.extend(surroundings.map(|found| remark_on(&found)));
    if solid.is_some() {
        analysis.diagnostics.push(Diagnostic::new("hatched-areas", HATCHED));
    }
    Ok(analysis)
}

/// The remark on painted ground around the building.
fn remark_on(found: &PaintedGround) -> Diagnostic {
    let area = found.cells as f64 * found.grid.resolution().powi(2);
    let painted = if found.painted == Occupancy::Free { "free" } else { "occupied" };
    let message = format!(
        "{area:.0} m2 around the building are painted {painted}; all stages but the upload take them for unknown ground, \
         as nobody was there"
    );
    Diagnostic::new("painted-surroundings", message)
}

/// The vehicles that the aisles between rows were cut for; `None` without such aisles.
fn vehicle_remark(vehicles_m: &[Option<f64>]) -> Option<Diagnostic> {
    let mut widths: Vec<f64> = vehicles_m.iter().copied().flatten().collect();
    widths.sort_by(f64::total_cmp);
    widths.dedup();
    let list = widths.iter().map(|width| format!("{width} m")).collect::<Vec<_>>().join(" and ");
    let message = format!(
        "aisles between rows were cut for vehicles {list} wide: set `decomposition.vehicleWidthM` where others drive there"
    );
    (!widths.is_empty()).then(|| Diagnostic::new("vehicle-width", message))
}

/// Remarks on a degenerate or cluttered map.
fn diagnose(grid: &OccupancyGrid, analysis: &Analysis) -> Vec<Diagnostic> {
    use crate::grid::Occupancy::{Free, Occupied};
    let mut diagnostics = Vec::new();
    let mut say = |code: &str, message: &str| diagnostics.push(Diagnostic::new(code, message));
    if grid.known_bounds().is_none() {
        say("all-unknown", "no cell of the map is known: check the thresholds and the unknown value of the map");
    }
    if grid.count(Free) == 0 {
        say("no-free-cells", "no cell is free, so there is no place to categorize: check `negate` and the thresholds");
    }
    if grid.count(Occupied) == 0 {
        say("no-occupied-cells", "no cell is occupied, so no structure can be found: check the thresholds");
    } else if analysis.orientations.angles.is_empty() {
        say("no-orientation", "no dominant orientation stands out: the map is one face per region");
    } else if analysis.lines.is_empty() {
        say("no-lines", "no line stands out along the dominant orientations: the map is one face per region");
    }
    let declutter::Removed { occupied, unknown, rate } = &analysis.clutter;
    if !occupied.is_empty() || !unknown.is_empty() {
        let message = format!(
            "{} occupied cells stand alone and were taken for speckle ({:.2} % of the floor), {} unknown ones for holes in \
             free space; all stages but the upload see the map without them",
            occupied.len(),
            100.0 * rate,
            unknown.len()
        );
        diagnostics.push(Diagnostic::new("decluttered", message));
    }
    diagnostics
}
