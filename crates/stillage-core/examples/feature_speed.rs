//! Times the beams and features of a map: `cargo run --release --example feature_speed -- map.png 0.05 [threads]`.
//!
//! Dark pixels are walls, light ones free, the rest unknown. Prints wall time per (free cell, beam) and a checksum of
//! the features that is the same for any thread count, the time of the categories, and that of the exact beams of a
//! sample of cells.

#![allow(clippy::print_stdout, reason = "an example prints what it measured")]

use std::fs::File;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::BufReader;
use std::time::Instant;

use stillage_core::categorization::categorize;
use stillage_core::grid::{GridFrame, Occupancy, OccupancyGrid};
use stillage_core::raycast::{BeamOptions, march_around};
use stillage_core::spec::CategorizationOptions;
use stillage_core::{Point, Watch, features};

/// Cells whose exact beams are timed.
const SAMPLE: usize = 2_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path, resolution, threads @ ..] = arguments.as_slice() else {
        return Err("usage: feature_speed map.png resolution [threads]".into());
    };
    let threads = threads.first().map_or(Ok(1), |threads| threads.parse())?;
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    let grid = read(path, resolution.parse()?)?;
    let options = CategorizationOptions::default();
    let beams = grid.count(Occupancy::Free) * options.beams;

    let start = Instant::now();
    let features = features::extract(&grid, &options, &Watch::unwatched())?;
    let swept = start.elapsed().as_secs_f64();
    let mut hasher = DefaultHasher::new();
    features.values.iter().for_each(|value| value.to_bits().hash(&mut hasher));
    println!("{} free cells x {} beams, {threads} thread(s)", features.cells.len(), options.beams);
    println!(
        "features    {swept:8.3} s {:8.2} ns per (cell, beam)  {:016x}",
        swept * 1e9 / beams as f64,
        hasher.finish()
    );

    let start = Instant::now();
    let map = categorize(&grid, &features, &options, 1, &Watch::unwatched())?.map;
    println!("categories  {:8.3} s, {} of them", start.elapsed().as_secs_f64(), map.categories.len());

    let start = Instant::now();
    let step = features.cells.len().div_ceil(SAMPLE).max(1);
    let sample: Vec<usize> = features.cells.iter().step_by(step).map(|&cell| cell as usize).collect();
    let exact: f64 = sample
        .iter()
        .flat_map(|cell| march_around(&grid, (cell % grid.width(), cell / grid.width()), &BeamOptions::from(&options)))
        .sum();
    let (marched, beams) = (start.elapsed().as_secs_f64(), (sample.len() * options.beams) as f64);
    println!(
        "exact beams {marched:8.3} s {:8.2} ns per (cell, beam), 1 thread, {} cells, mean {:.3} m",
        marched * 1e9 / beams,
        sample.len(),
        exact / beams
    );
    Ok(())
}

fn read(path: &str, resolution: f64) -> Result<OccupancyGrid, Box<dyn std::error::Error>> {
    let mut decoder = png::Decoder::new(BufReader::new(File::open(path)?));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let mut pixels = vec![0; reader.output_buffer_size().ok_or("the picture is too large")?];
    let info = reader.next_frame(&mut pixels)?;
    let cell = |pixel: &[u8]| match pixel[0] {
        0..90 => Occupancy::Occupied,
        230.. => Occupancy::Free,
        _ => Occupancy::Unknown,
    };
    let rows: Vec<&[u8]> = pixels[..info.buffer_size()].chunks_exact(info.line_size).collect();
    let cells = rows.iter().rev().flat_map(|row| row.chunks_exact(info.color_type.samples()).map(cell)).collect();
    let frame = GridFrame { resolution, origin: Point::origin(), yaw: 0.0 };
    Ok(OccupancyGrid::new(info.width as usize, info.height as usize, frame, cells))
}
