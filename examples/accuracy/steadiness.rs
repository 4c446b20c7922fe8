//! Whether results hang on how cells fall: maps turned and moved under the cells, against the same truth.

use rayon::prelude::*;
use stillage_core::{AnalysisSpec, OccupancyGrid};
use stillage_zoo::{DrawingOptions, DrawingStyle};

use crate::real::{self, RealMap};
use crate::tables::{least, mean, percent, table};
use crate::{Arguments, Outcome, Seeds, moved, sites};

/// Turns, degrees: almost with the cells, and anywhere in between.
const TURNS: [f64; 4] = [2.0, 10.0, 17.0, 45.0];
/// Half of a tile of the segmentation, metres (`regions.tileM` is 2).
const HALF_A_TILE: f64 = 1.0;
/// Part of a cell by which a drawing is moved.
const PART_OF_A_CELL: f64 = 0.25;
/// So many of the seeds of drawings are moved.
const SEEDS: u64 = 3;

/// Scores of real maps and F1 of drawings, as they are and moved.
pub fn steadiness(arguments: &Arguments) -> Outcome<String> {
    let maps = real::maps(&arguments.shared, &arguments.only)?;
    Ok(format!("{}\n{}", real_maps(&maps)?, drawings(arguments.seeds, &arguments.only)?))
}

fn real_maps(maps: &[RealMap]) -> Outcome<String> {
    let variants = |grid: &OccupancyGrid| {
        let half = (HALF_A_TILE / grid.resolution()).round() as usize;
        let turned = TURNS.map(|turn| moved::turned(grid, turn.to_radians()));
        [vec![grid.clone()], turned.to_vec(), vec![moved::padded(grid, half)]].concat()
    };
    let jobs: Vec<(&RealMap, OccupancyGrid)> =
        maps.iter().flat_map(|map| variants(&map.grid).into_iter().map(move |grid| (map, grid))).collect();
    let scores: Vec<f64> = jobs.par_iter().map(|(map, grid)| Ok(map.score(grid)?.score())).collect::<Outcome<_>>()?;
    let names = maps.iter().map(|map| map.title().to_owned()).collect();
    Ok(rows("real map, score", &["half a tile"], names, &scores, 1))
}

fn drawings(seeds: Seeds, wanted: &str) -> Outcome<String> {
    let styles: Vec<DrawingStyle> =
        DrawingStyle::ALL.into_iter().filter(|style| style.name().contains(wanted)).collect();
    let seeds: Vec<u64> = (seeds.0..=seeds.1).take(SEEDS as usize).collect();
    let mut variants = vec![DrawingOptions::default()];
    variants.extend(TURNS.map(|turned_deg| DrawingOptions { turned_deg, ..DrawingOptions::default() }));
    variants.push(DrawingOptions { shifted_cells: PART_OF_A_CELL, ..DrawingOptions::default() });
    let jobs: Vec<(DrawingStyle, u64, DrawingOptions)> = styles
        .iter()
        .flat_map(|&style| seeds.iter().map(move |&seed| (style, seed)))
        .flat_map(|(style, seed)| variants.iter().map(move |&options| (style, seed, options)))
        .collect();
    let one = |&(style, seed, options): &(DrawingStyle, u64, DrawingOptions)| -> Outcome<f64> {
        let site = sites::of_sample(&stillage_zoo::draw(style, seed, &options))?;
        Ok(sites::scored(&site, &AnalysisSpec::default())?.decided.f1)
    };
    let scores: Vec<f64> = jobs.par_iter().map(one).collect::<Outcome<_>>()?;
    let names = styles.iter().map(ToString::to_string).collect();
    Ok(rows("drawing, F1", &["a quarter cell"], names, &scores, seeds.len()))
}

/// A row for each name: means over its maps as they are, turned and moved, and the deepest fall of a single map.
fn rows(title: &str, moves: &[&str], names: Vec<String>, scores: &[f64], maps_of_a_name: usize) -> String {
    let head = [title.to_owned(), "as it is".to_owned()].into_iter().chain(TURNS.map(|turn| format!("{turn}°")));
    let head: Vec<String> =
        head.chain(moves.iter().map(ToString::to_string)).chain(["deepest fall".to_owned()]).collect();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    let variants = 1 + TURNS.len() + moves.len();
    let of_a_name = maps_of_a_name * variants;
    let row = |(name, scores): (String, &[f64])| {
        let of = |variant: usize| percent(mean(scores.iter().skip(variant).step_by(variants).copied()));
        let fall = |map: &[f64]| map[0] - least(map.iter().copied());
        let deepest = scores.chunks(variants).map(fall).fold(0.0, f64::max);
        [vec![name], (0..variants).map(of).collect(), vec![percent(deepest)]].concat()
    };
    let groups = names.into_iter().zip(scores.chunks(of_a_name)).chain([("**all**".to_owned(), scores)]);
    table(&head, groups.map(row))
}
