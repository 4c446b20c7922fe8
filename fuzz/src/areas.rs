//! What people draw over a map, or bring along for it: corrections, names, the truth of a site.

use std::sync::LazyLock;

use serde_json::Value;
use stillage::ingest::{self, IngestError};
use stillage_core::corrections::{Correction, Outcome, apply};
use stillage_core::{Analysis, AnalysisOptions, GridFrame, Occupancy, OccupancyGrid, Point, SiteCells, Watch, analyze};

use super::check_refusal;

/// Most faces of one correction here: enough for a row, and drawn in a moment.
const MOST_FACES: usize = 200;

/// A hall with two racks, and its analysis.
struct Hall {
    grid: OccupancyGrid,
    analysis: Analysis,
    cells: SiteCells,
}

static HALL: LazyLock<Hall> = LazyLock::new(|| {
    let (width, height) = (40, 30);
    let is_wall = |x: usize, y: usize| x == 0 || y == 0 || x == width - 1 || y == height - 1;
    let is_rack = |x: usize, y: usize| (6..34).contains(&x) && ((8..11).contains(&y) || (18..21).contains(&y));
    let cell = |at: usize| match (at % width, at / width) {
        (x, y) if is_wall(x, y) || is_rack(x, y) => Occupancy::Occupied,
        _ => Occupancy::Free,
    };
    let frame = GridFrame { resolution: 0.25, origin: Point::new(0.0, 0.0), yaw: 0.0 };
    let grid = OccupancyGrid::new(width, height, frame, (0..width * height).map(cell).collect());
    let spec = AnalysisOptions::default().check().expect("the defaults are right");
    let analysis = analyze(&grid, &spec, &Watch::unwatched()).expect("nobody stops it");
    let cells = SiteCells::of(&grid, &analysis);
    Hall { grid, analysis, cells }
});

/// Corrections as GeoJSON, or a list of them, drawn over a hall.
pub fn corrections(bytes: &[u8]) {
    let Ok(document) = serde_json::from_slice::<Value>(bytes) else { return };
    let read: Vec<Value> = match document {
        Value::Array(list) => list.into_iter().take(8).collect(),
        document => match ingest::correction_features(&document, Some("pc"), &as_it_is) {
            Ok(features) => features.into_iter().take(8).map(|feature| Value::Object(feature.correction)).collect(),
            Err(errors) => return errors.iter().for_each(check_refusal),
        },
    };
    let mut list: Vec<Correction> = Vec::new();
    for correction in read {
        let Ok(correction) = serde_json::from_value::<Correction>(correction) else { continue };
        match correction.check(MOST_FACES) {
            Ok(()) => list.push(correction),
            Err(problem) => check_refusal(&problem),
        }
    }
    let Hall { grid, analysis, cells } = &*HALL;
    let corrected = apply(grid, analysis, &cells.faces, &list);
    assert_eq!(corrected.outcomes.len(), list.len());
    let known = corrected.analysis.faces.len();
    assert!(corrected.analysis.subdivision.faces().all(|face| face.index() < known));
    for outcome in &corrected.outcomes {
        if let Outcome::Unfit(problem) = outcome {
            check_refusal(problem);
        }
    }
}

/// Names as a table, or as GeoJSON.
pub fn names(bytes: &[u8]) {
    let read = match serde_json::from_slice::<Value>(bytes) {
        Ok(document) => ingest::name_areas(&document, &as_it_is),
        Err(_) => ingest::name_table(bytes, &["aisle", "bay"], &as_it_is),
    };
    match read {
        Ok(rows) => rows.iter().for_each(|row| check_refusal(&row.words())),
        Err(errors) => check_refusals(&errors),
    }
}

/// The truth of a site as GeoJSON.
pub fn truth(bytes: &[u8]) {
    let Ok(document) = serde_json::from_slice::<Value>(bytes) else { return };
    if let Err(error) = ingest::ground_truth(&document) {
        check_refusal(&error);
    }
}

fn as_it_is([x, y]: [f64; 2]) -> Point {
    Point::new(x, y)
}

fn check_refusals(errors: &[IngestError]) {
    assert!(!errors.is_empty());
    errors.iter().for_each(check_refusal);
}
