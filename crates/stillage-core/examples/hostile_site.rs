//! Decomposes a site that is made to be expensive, and stops it at many moments:
//! `cargo run --release -p stillage-core --example hostile_site -- [side in cells] [stops]`.
//!
//! Rows of three boxes and a gap fill a square from wall to wall, with the narrowest aisles that count as such. The gaps
//! are as wide as passages and drift from row to row, so every row has many runs of open pieces, and each of them goes on
//! in its neighbours. Printed are the size of the result, the time of the whole decomposition, and the longest time
//! from raising the stop flag to the return of the decomposition.

#![allow(clippy::print_stdout, reason = "an example prints what it measured")]

use std::time::{Duration, Instant};

use stillage_core::decomposition::{Decomposition, decompose};
use stillage_core::geometry::OrientedBox;
use stillage_core::plot::PlotKind;
use stillage_core::segmentation::{Region, RegionMap};
use stillage_core::spec::DecompositionOptions;
use stillage_core::watch::Observer;
use stillage_core::{GridFrame, Occupancy, OccupancyGrid, Point, Stage, StopFlag, Stopped, Watch};

/// Side of a cell, metres; the decomposition works on cells half as wide.
const CELL_M: f64 = 0.1;
/// Depth of a row, and of a row with its aisle, cells.
const ROW: usize = 11;
const PERIOD: usize = 30;
/// Width of a place and of the box in it, places before a gap, and width of the gap, cells.
const PLACE: usize = 12;
const BOX: usize = 10;
const PLACES: usize = 3;
const GAP: usize = 28;
/// What a row lies beside the one before, cells.
const DRIFT: usize = 2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1).map(|argument| argument.parse());
    let side: usize = arguments.next().unwrap_or(Ok(6_000))?;
    let stops = arguments.next().unwrap_or(Ok(30))?;
    let grid = site(side);
    let (result, whole) = decomposed(&grid, None);
    let found = result?;
    let count = |kind: PlotKind| found.plots.iter().filter(|plot| plot.kind == kind).count();
    let [places, passages, aisles] = [PlotKind::Place, PlotKind::Passage, PlotKind::Aisle].map(count);
    println!("{side} x {side} cells: {places} places, {passages} pieces of passages, {aisles} aisles");
    println!("whole decomposition: {:.2} s on {} threads", whole.as_secs_f64(), rayon::current_num_threads());
    let mut longest = Duration::ZERO;
    for stop in 0..stops {
        let after = whole.mul_f64((stop as f64 + 0.5) / stops as f64);
        let (result, delay) = decomposed(&grid, Some(after));
        if result.is_err() {
            longest = longest.max(delay);
        }
    }
    println!("longest of {stops} stops: {:.3} s", longest.as_secs_f64());
    Ok(())
}

/// Rows of boxes with drifting gaps, in a wall.
fn site(side: usize) -> OccupancyGrid {
    let cell = |index: usize| {
        let (column, row) = (index % side, index / side);
        let is_wall = column < 2 || row < 2 || column + 2 >= side || row + 2 >= side;
        let along = (column + row / PERIOD * DRIFT) % (PLACES * PLACE + GAP);
        let (depth, margin) = (row % PERIOD, PERIOD);
        let is_row = depth < ROW && (margin..side - margin).contains(&row) && (margin..side - margin).contains(&column);
        let is_outline = depth == 0 || depth + 1 == ROW || along.is_multiple_of(PLACE) || along % PLACE + 1 == BOX;
        match (is_wall, is_row && along < PLACES * PLACE && along % PLACE < BOX) {
            (true, _) => Occupancy::Occupied,
            (false, true) if is_outline => Occupancy::Occupied,
            (false, true) => Occupancy::Unknown,
            (false, false) => Occupancy::Free,
        }
    };
    let frame = GridFrame { resolution: CELL_M, origin: Point::origin(), yaw: 0.0 };
    OccupancyGrid::new(side, side, frame, (0..side * side).map(cell).collect())
}

/// Decomposes a grid, and how long that took; with a stop after some time, how long it went on afterwards.
fn decomposed(grid: &OccupancyGrid, stop_after: Option<Duration>) -> (Result<Decomposition, Stopped>, Duration) {
    let bounds = OrientedBox { center: Point::origin(), half_extents: [0.0; 2], angle: 0.0 };
    let region = Region { orientations: vec![0.0], bounds, share: 1.0 };
    let tile_cells = grid.width().max(grid.height());
    let regions = RegionMap { tile_cells, columns: 1, rows: 1, tiles: vec![0], regions: vec![region] };
    let (stop, options) = (StopFlag::default(), DecompositionOptions::default());
    std::thread::scope(|scope| {
        let mut start = Instant::now();
        let work = scope.spawn(|| decompose(grid, &regions, &options, &Watch::new(&stop, &Nobody)));
        if let Some(after) = stop_after {
            std::thread::sleep(after);
            start = Instant::now();
            stop.raise();
        }
        let result = work.join().expect("a decomposition does not panic");
        (result, start.elapsed())
    })
}

struct Nobody;

impl Observer for Nobody {
    fn progress(&self, _stage: Stage, _fraction: f64) {}
}
