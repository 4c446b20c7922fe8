//! What every stage of an analysis costs, on a quarter of a million cells of a drawn warehouse: `cargo bench`.
//!
//! Beside the sweep runs the exact march, its yardstick: compare the beams per second. The paper's size, stage by
//! stage, is `cargo run --release --example paper_scale`; figures and peers are in `BENCHMARKS.md`.

#[path = "../examples/paper_scale/site.rs"]
mod site;

use std::sync::LazyLock;

use divan::Bencher;
use divan::counter::ItemsCount;
use stillage_core::alignment;
use stillage_core::annotation::{self, Subject};
use stillage_core::arrangement::{self, CellFaces};
use stillage_core::categorization::Categorization;
use stillage_core::clustering::{self, FitOptions, Method, PlaceModel};
use stillage_core::features::{CellFeatures, FeatureSource};
use stillage_core::geometry::{RigidMotion, Vector};
use stillage_core::orientation::dominant_orientations;
use stillage_core::radiography;
use stillage_core::raycast::{BeamOptions, march_around};
use stillage_core::segmentation::segment;
use stillage_core::vectors::Vectors;
use stillage_core::{Analysis, AnalysisSpec, Occupancy, OccupancyGrid, Watch, analyze};

/// The corner of a rack field: racks, aisles, a cross aisle, the wall.
static GRID: LazyLock<OccupancyGrid> = LazyLock::new(|| site::warehouse([100..612, 200..712]));
static SPEC: LazyLock<AnalysisSpec> = LazyLock::new(AnalysisSpec::default);
static ANALYSIS: LazyLock<Analysis> =
    LazyLock::new(|| analyze(&GRID, &SPEC, &Watch::unwatched()).expect("nobody stops it"));

/// Cells whose beams are marched one by one.
const MARCHED: usize = 512;

fn main() {
    // One thread: what is measured is work, not machines.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("nobody else made the pool");
    divan::main();
}

/// All beams and features of every free cell.
#[divan::bench(args = Vectors::available())]
fn features_by_sweep(bencher: Bencher<'_, '_>, vectors: Vectors) {
    let beams = GRID.count(Occupancy::Free) * SPEC.options().categorization.beams;
    bencher.counter(ItemsCount::new(beams)).bench(|| features(vectors));
}

/// The beams alone of some cells, each followed to its end.
#[divan::bench]
fn beams_by_exact_march(bencher: Bencher<'_, '_>) {
    let options = BeamOptions::from(&SPEC.options().categorization);
    let free: Vec<usize> = (0..GRID.cells().len()).filter(|&cell| GRID.cells()[cell] == Occupancy::Free).collect();
    let cells: Vec<usize> = free.iter().copied().step_by(free.len() / MARCHED).collect();
    let march = |&cell: &usize| march_around(&GRID, (cell % GRID.width(), cell / GRID.width()), &options);
    bencher.counter(ItemsCount::new(cells.len() * options.beams)).bench(|| cells.iter().flat_map(march).sum::<f64>());
}

/// The fit of k-means to the features of every free cell.
#[divan::bench]
fn clusters_fitted(bencher: Bencher<'_, '_>) {
    let features = features(Vectors::widest());
    bencher.counter(ItemsCount::new(features.cells.len())).bench(|| fit(&features));
}

/// The category of every free cell from its features.
#[divan::bench]
fn clusters_assigned(bencher: Bencher<'_, '_>) {
    let features = features(Vectors::widest());
    let model = fit(&features);
    let mut labels = vec![0; features.cells.len()];
    bencher
        .counter(ItemsCount::new(features.cells.len()))
        .bench_local(|| model.assign(&features.values, divan::black_box(&mut labels)));
}

#[divan::bench]
fn orientations(bencher: Bencher<'_, '_>) {
    let options = &SPEC.options().orientation;
    bencher.counter(cells()).bench(|| dominant_orientations(&GRID, options, &Watch::unwatched()));
}

#[divan::bench]
fn regions(bencher: Bencher<'_, '_>) {
    let orientations = &ANALYSIS.orientations;
    bencher.counter(cells()).bench(|| segment(&GRID, orientations, SPEC.options(), &Watch::unwatched()));
}

#[divan::bench]
fn lines(bencher: Bencher<'_, '_>) {
    let options = &SPEC.options().decomposition;
    bencher.counter(cells()).bench(|| radiography::lines(&GRID, &ANALYSIS.regions, options, &Watch::unwatched()));
}

/// Counted in faces.
#[divan::bench]
fn subdivision(bencher: Bencher<'_, '_>) {
    let watch = Watch::unwatched();
    let segments = arrangement::source_segments(&GRID, &ANALYSIS.regions, &ANALYSIS.lines, &[], &watch);
    let segments = segments.expect("nobody stops it");
    bencher
        .counter(ItemsCount::new(ANALYSIS.faces.len()))
        .bench(|| arrangement::arrange(&segments, &Watch::unwatched()));
}

#[divan::bench]
fn votes(bencher: Bencher<'_, '_>) {
    let (analysis, options) = (&*ANALYSIS, &SPEC.options().annotation);
    let categorization = Categorization { map: analysis.categories.clone(), memberships: None };
    bencher.counter(cells()).bench(|| {
        let faces = CellFaces::rasterize(&analysis.subdivision, GRID.width(), GRID.height(), GRID.resolution());
        let watch = Watch::unwatched();
        let subject = Subject {
            grid: &GRID,
            categorization: &categorization,
            regions: &analysis.regions,
            subdivision: &analysis.subdivision,
            graph: &analysis.graph,
            cells: &faces,
            plots: &[],
            grounds: &[],
        };
        annotation::annotate(&subject, options, 1, &watch)
    });
}

/// A map of two million cells onto itself, turned by 20 degrees. The goal of both cores together is two seconds.
#[divan::bench(sample_count = 10)]
fn alignment_of_two_million_cells(bencher: Bencher<'_, '_>) {
    let old = site::warehouse([600..2000, 600..2030]);
    let new = turned(&old, 20_f64.to_radians());
    bencher
        .counter(ItemsCount::new(2 * old.cells().len()))
        .bench(|| alignment::align(&new, &old, &Watch::unwatched()).map(|found| found.expect("it is one site")));
}

/// The grid turned about its middle, the nearest cell for each; unknown where it has none.
fn turned(grid: &OccupancyGrid, radians: f64) -> OccupancyGrid {
    let middle = grid.center(grid.width() / 2, grid.height() / 2);
    let turn = RigidMotion { shift: Vector::zeros(), turn: radians };
    let cell = |index: usize| {
        let from_middle = grid.center(index % grid.width(), index / grid.width()) - middle;
        let found = grid.cell_at(middle + turn.turned(from_middle));
        found.map_or(Occupancy::Unknown, |(column, row)| grid.at(column as i64, row as i64))
    };
    OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), (0..grid.cells().len()).map(cell).collect())
}

fn features(vectors: Vectors) -> CellFeatures {
    let watch = Watch::unwatched();
    FeatureSource::new(&GRID, &SPEC.options().categorization, vectors, &watch)
        .and_then(|source| source.all(&watch))
        .expect("nobody stops it")
}

/// Five clusters, as by default.
fn fit(features: &CellFeatures) -> PlaceModel {
    let options = &SPEC.options().categorization;
    let fit_options = FitOptions {
        method: Method::KMeans,
        count: options.k,
        max_count: options.max_k,
        scaling: options.scaling,
        restarts: options.restarts,
        max_iterations: options.max_iterations,
        tolerance: 1e-6,
        fit_rows: 200_000,
        seed: 1,
    };
    clustering::fit(&features.values, features.names.len(), &fit_options, &Watch::unwatched())
        .expect("nobody stops it")
        .0
}

fn cells() -> ItemsCount {
    ItemsCount::new(GRID.cells().len())
}
