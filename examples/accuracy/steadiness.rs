//! Whether results hang on how cells fall, and on what is painted outside: the same maps turned, moved, painted, cropped,
//! scaled and compressed, against the same truth.

use rayon::prelude::*;
use stillage_core::{AnalysisSpec, Occupancy, OccupancyGrid};
use stillage_zoo::{DrawingOptions, DrawingStyle, Outside};

use crate::real::{self, RealMap};
use crate::tables::{least, mean, percent, table};
use crate::{Arguments, Outcome, moved, sites};

/// Turns, degrees: almost with the cells, and anywhere in between.
const TURNS: [f64; 4] = [2.0, 10.0, 17.0, 45.0];
/// Half of a tile of the segmentation, metres (`regions.tileM` is 2).
const HALF_A_TILE: f64 = 1.0;
/// Part of a cell by which a drawing is moved.
const PART_OF_A_CELL: f64 = 0.25;
/// Quality of a JPEG, of 100.
const QUALITY: u8 = 60;
/// So many of the seeds of drawings are changed.
const SEEDS: usize = 3;

/// Scores of real maps and F1 of drawings, as they are and changed.
pub fn steadiness(arguments: &Arguments) -> Outcome<String> {
    let maps = real::maps(&arguments.shared, &arguments.only)?;
    let tables =
        [real_maps(&maps)?, drawings(arguments, &moved_drawings())?, drawings(arguments, &painted_drawings())?];
    Ok(tables.join("\n"))
}

fn turn_names() -> impl Iterator<Item = String> {
    TURNS.into_iter().map(|turn| format!("{turn}°"))
}

fn real_maps(maps: &[RealMap]) -> Outcome<String> {
    let variants = |grid: &OccupancyGrid| {
        let half = (HALF_A_TILE / grid.resolution()).round() as usize;
        let mut grids = vec![grid.clone()];
        grids.extend(TURNS.map(|turn| moved::turned(grid, turn.to_radians())));
        grids.push(moved::padded(grid, half));
        grids.extend([Occupancy::Occupied, Occupancy::Free].map(|outside| moved::painted(grid, outside)));
        grids
    };
    let jobs: Vec<(&RealMap, OccupancyGrid)> =
        maps.iter().flat_map(|map| variants(&map.grid).into_iter().map(move |grid| (map, grid))).collect();
    let scores: Vec<f64> = jobs.par_iter().map(|(map, grid)| Ok(map.score(grid)?.score())).collect::<Outcome<_>>()?;
    let names = maps.iter().map(|map| map.title().to_owned()).collect();
    let others = ["half a tile", "black outside", "white outside"].map(str::to_owned);
    let variants = std::iter::once("as it is".to_owned()).chain(turn_names()).chain(others).collect();
    Ok(rows("real map, score", variants, names, &scores))
}

/// One way to draw the same hall.
struct Variant {
    name: String,
    options: DrawingOptions,
    is_jpeg: bool,
}

impl Variant {
    fn new(name: &str, options: DrawingOptions) -> Self {
        Self { name: name.to_owned(), options, is_jpeg: false }
    }
}

/// Turned and moved under the cells.
fn moved_drawings() -> Vec<Variant> {
    let plain = DrawingOptions::default();
    let turned =
        turn_names().zip(TURNS).map(|(name, turned_deg)| Variant::new(&name, DrawingOptions { turned_deg, ..plain }));
    let shifted = Variant::new("a quarter cell", DrawingOptions { shifted_cells: PART_OF_A_CELL, ..plain });
    std::iter::once(Variant::new("as it is", plain)).chain(turned).chain([shifted]).collect()
}

/// Painted outside, cropped, scaled, compressed.
fn painted_drawings() -> Vec<Variant> {
    let plain = DrawingOptions::default();
    let outside = |outside| DrawingOptions { outside: Some(outside), ..plain };
    let margin = |margin| DrawingOptions { margin: Some(margin), ..plain };
    let scale = |scale| DrawingOptions { scale: Some(scale), ..plain };
    vec![
        Variant::new("as it is", plain),
        Variant::new("unknown outside", outside(Outside::Unknown)),
        Variant::new("black", outside(Outside::Black)),
        Variant::new("white", outside(Outside::White)),
        Variant::new("cropped at the walls", margin(0.0)),
        Variant::new("3 m around", margin(3.0)),
        Variant::new("cells of 0.7", scale(0.7)),
        Variant::new("cells of 1.3", scale(1.3)),
        Variant { name: format!("JPEG {QUALITY}"), options: plain, is_jpeg: true },
    ]
}

fn drawings(arguments: &Arguments, variants: &[Variant]) -> Outcome<String> {
    let styles: Vec<DrawingStyle> =
        DrawingStyle::ALL.into_iter().filter(|style| style.name().contains(&arguments.only)).collect();
    let seeds: Vec<u64> = (arguments.seeds.0..=arguments.seeds.1).take(SEEDS).collect();
    let jobs: Vec<(DrawingStyle, u64, &Variant)> = styles
        .iter()
        .flat_map(|&style| seeds.iter().map(move |&seed| (style, seed)))
        .flat_map(|(style, seed)| variants.iter().map(move |variant| (style, seed, variant)))
        .collect();
    let one = |&(style, seed, variant): &(DrawingStyle, u64, &Variant)| -> Outcome<f64> {
        let sample = stillage_zoo::draw(style, seed, &variant.options);
        let site = if variant.is_jpeg { sites::of_jpeg(&sample, QUALITY)? } else { sites::of_sample(&sample)? };
        let f1 = sites::scored(&site, &AnalysisSpec::default())?.decided.f1;
        eprintln!("{style:<10}{seed:>4}  F1 {f1:.3} {}", variant.name);
        Ok(f1)
    };
    let scores: Vec<f64> = jobs.par_iter().map(one).collect::<Outcome<_>>()?;
    let names = styles.iter().map(ToString::to_string).collect();
    Ok(rows("drawing, F1", variants.iter().map(|variant| variant.name.clone()).collect(), names, &scores))
}

/// A row for each name: means over its maps for each variant, the first of which is the map as it is, and the deepest fall
/// of a single map below that.
fn rows(title: &str, variants: Vec<String>, names: Vec<String>, scores: &[f64]) -> String {
    let count = variants.len();
    let row = |(name, scores): (String, &[f64])| {
        let of = |variant: usize| percent(mean(scores.iter().skip(variant).step_by(count).copied()));
        let fall = |map: &[f64]| map[0] - least(map.iter().copied());
        let deepest = scores.chunks(count).map(fall).fold(0.0, f64::max);
        [vec![name], (0..count).map(of).collect(), vec![percent(deepest)]].concat()
    };
    let head = [vec![title.to_owned()], variants, vec!["deepest fall".to_owned()]].concat();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    let of_a_name = scores.len() / names.len().max(1);
    let groups = names.into_iter().zip(scores.chunks(of_a_name.max(1))).chain([("**all**".to_owned(), scores)]);
    table(&head, groups.map(row))
}
