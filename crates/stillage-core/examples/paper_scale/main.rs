//! Analyses a warehouse of the paper's size and prints what every stage costs:
//! `cargo run --release --example paper_scale -- [threads] [picture.png]`.
//!
//! The map is drawn here (190 m x 270 m, 20.5 million cells), so the run needs no file. The beams are timed on every
//! vector width of this machine, beside the exact march (Amanatides and Woo) on a sample of cells, in the same run: on
//! a busy machine the ratio means more than the seconds.

#![allow(clippy::print_stdout, reason = "an example prints what it measured")]

mod clock;
mod site;

use std::fs::File;
use std::path::Path;

use clock::{Cost, StageClock};
use rayon::prelude::*;
use stillage_core::features::{FeatureSource, Workspace};
use stillage_core::raycast::{BeamOptions, march_around};
use stillage_core::spec::CategorizationOptions;
use stillage_core::vectors::Vectors;
use stillage_core::{AnalysisOptions, Occupancy, OccupancyGrid, StopFlag, Stopped, Watch, analyze};

/// Cells whose beams are marched.
const MARCHED: usize = 4_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let threads = arguments.next().map_or(Ok(0), |threads| threads.parse())?;
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    let grid = site::warehouse([0..site::SIZE[0], 0..site::SIZE[1]]);
    if let Some(path) = arguments.next() {
        write_picture(&grid, Path::new(&path))?;
    }
    let spec = AnalysisOptions::default().check().expect("the defaults are valid");
    let options = &spec.options().categorization;
    let free = grid.count(Occupancy::Free);
    let threads = rayon::current_num_threads();
    println!("{} x {} cells, {free} free, {} beams, {threads} thread(s)", grid.width(), grid.height(), options.beams);

    println!("\n{:<24}{:>9}{:>9}{:>12}", "whole analysis", "CPU s", "wall s", "peak MiB");
    let (clock, stop) = (StageClock::default(), StopFlag::default());
    let (analysis, whole) = Cost::of(|| analyze(&grid, &spec, &Watch::new(&stop, &clock)));
    for (stage, cost) in clock.stages() {
        print_cost(stage.name(), &cost);
    }
    print_cost("all", &whole);
    let analysis = analysis?;
    println!("{} faces, {} categories", analysis.faces.len() - 1, analysis.categories.categories.len());

    println!("\n{:<24}{:>9}{:>9}{:>12}{:>10}", "beams and features", "CPU s", "wall s", "ns per beam", "x march");
    let marched = marched_ns(&grid, &BeamOptions::from(options));
    for vectors in Vectors::available().into_iter().rev() {
        let (hash, cost) = Cost::of(|| feature_hash(&grid, options, vectors));
        let nanoseconds = cost.cpu_s * 1e9 / (free * options.beams) as f64;
        let (name, ratio) = (format!("{vectors:?}"), marched / nanoseconds);
        println!(
            "{name:<24}{:>9.2}{:>9.2}{nanoseconds:>12.2}{ratio:>10.0}  hash {:016x}",
            cost.cpu_s, cost.wall_s, hash?
        );
    }
    println!("{:<24}{:>9}{:>9}{marched:>12.0}{:>10}  {MARCHED} cells, one thread", "exact march", "", "", 1);
    Ok(())
}

fn print_cost(name: &str, cost: &Cost) {
    println!("{name:<24}{:>9.2}{:>9.2}{:>12.0}", cost.cpu_s, cost.wall_s, cost.peak_mib);
}

/// Nanoseconds that the exact march takes for a beam, one thread.
fn marched_ns(grid: &OccupancyGrid, options: &BeamOptions) -> f64 {
    let free: Vec<usize> = (0..grid.cells().len()).filter(|&cell| grid.cells()[cell] == Occupancy::Free).collect();
    let cells: Vec<usize> = free.iter().copied().step_by(free.len().div_ceil(MARCHED)).collect();
    let march = |&cell: &usize| march_around(grid, (cell % grid.width(), cell / grid.width()), options);
    let (beams, cost) = Cost::of(|| cells.iter().flat_map(march).filter(|length| *length > 0.0).count());
    cost.cpu_s * 1e9 / beams as f64
}

/// A number that changes with any bit of any feature.
fn feature_hash(grid: &OccupancyGrid, options: &CategorizationOptions, vectors: Vectors) -> Result<u64, Stopped> {
    let watch = Watch::unwatched();
    let source = FeatureSource::new(grid, options, vectors, &watch)?;
    let mix = |hash: u64, bits: u64| (hash ^ bits).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29);
    let hashes: Result<Vec<u64>, Stopped> = (0..source.parts())
        .into_par_iter()
        .map_init(Workspace::default, |workspace, part| {
            let features = source.part(part, workspace, &watch)?;
            Ok(features.values.iter().fold(1, |hash, value| mix(hash, u64::from(value.to_bits()))))
        })
        .collect();
    Ok(hashes?.into_iter().fold(1, mix))
}

/// Writes the map as `map_server` would: free white, occupied black, unknown grey.
fn write_picture(grid: &OccupancyGrid, path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let mut encoder = png::Encoder::new(File::create(path)?, grid.width() as u32, grid.height() as u32);
    encoder.set_color(png::ColorType::Grayscale);
    let grey = |cell: &Occupancy| match cell {
        Occupancy::Free => 254,
        Occupancy::Occupied => 0,
        Occupancy::Unknown => 205,
    };
    let pixels: Vec<u8> = grid.cells().chunks(grid.width()).rev().flatten().map(grey).collect();
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
