mod site;
use stillage_core::grid::Occupancy;
use stillage_core::spec::CategorizationOptions;
use stillage_core::{Watch, features};
use std::time::Instant;
fn main() {
    let threads: usize = std::env::args().nth(1).map_or(1, |a| a.parse().unwrap());
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().unwrap();
    let start = Instant::now();
    let grid = site::warehouse();
    println!("drawn in {:.2} s: {} free of {}", start.elapsed().as_secs_f64(), grid.count(Occupancy::Free), grid.cells().len());
    if let Some(path) = std::env::args().nth(2).filter(|p| p != "-") {
        let f = std::fs::File::create(path).unwrap();
        let mut e = png::Encoder::new(f, grid.width() as u32, grid.height() as u32);
        e.set_color(png::ColorType::Grayscale);
        let mut w = e.write_header().unwrap();
        let d: Vec<u8> = grid.cells().chunks(grid.width()).rev().flatten().map(|c| match c { Occupancy::Free => 254, Occupancy::Occupied => 0, _ => 205 }).collect();
        w.write_image_data(&d).unwrap();
        return;
    }
    let options = CategorizationOptions::default();
    let start = Instant::now();
    let f = features::FeatureSource::new(&grid, &options, stillage_core::vectors::Vectors::available()[std::env::args().nth(3).map_or(0, |a| a.parse().unwrap())], &Watch::unwatched()).unwrap().all(&Watch::unwatched()).unwrap();
    let t = start.elapsed().as_secs_f64();
    println!("features {:.2} s wall, {:.2} ns per", t, t * 1e9 / f.cells.len() as f64 / 360.0);
}
