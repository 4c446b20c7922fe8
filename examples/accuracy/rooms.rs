//! Places of offices against the rooms that people drew (the maps of R. Bormann et al., *Room segmentation*, ICRA 2016,
//! doi 10.1109/ICRA.2016.7487234).
//!
//! Panoptic quality (A. Kirillov et al., CVPR 2019): the mean intersection over union of the pairs above one half, times
//! their F1. Strict MCC (after M. Mielle et al., ICRA 2018): rooms are paired one to one, the largest overlap first; the
//! Matthews correlation of each pair over all cells of either side, 0 for what is left alone. Places count where the map
//! is white; segments of a hundred cells or fewer are dropped on both sides, as the field does.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use rayon::prelude::*;
use stillage_core::AnalysisSpec;
use stillage_core::arrangement::CellFaces;

use crate::{Outcome, sites};

/// Segments of so many cells or fewer are none.
const SMALLEST: usize = 100;
/// From this grey level on, a map is free and a truth is room; these drawings have walls in light grey.
const WHITE: u8 = 250;
const SETS: [(&str, &str); 2] = [("plain", "map.png"), ("furnished", "map_furnished.png")];

/// Panoptic quality and strict MCC of one map.
#[derive(Debug, Clone, Copy)]
pub struct Scores {
    pub panoptic: f64,
    pub strict: f64,
    pub places: usize,
    pub rooms: usize,
}

/// The table of all maps `bormann__*` in a folder.
pub fn table(folder: &Path) -> Outcome<String> {
    let mut names = sites::names(folder, "")?;
    names.retain(|name| name.starts_with("bormann__"));
    let jobs: Vec<(&String, &str)> = names.iter().flat_map(|name| SETS.map(|(_, image)| (name, image))).collect();
    let scores: Vec<Scores> =
        jobs.par_iter().map(|(name, image)| score(&folder.join(name), image)).collect::<Outcome<_>>()?;
    let mut text = String::from("| map | rooms |");
    for (set, _) in SETS {
        let _ = write!(text, " {set}: places | PQ | strict MCC |");
    }
    text += "\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (name, row) in names.iter().zip(scores.chunks_exact(SETS.len())) {
        let _ = write!(text, "| {} | {} |", name.trim_start_matches("bormann__"), row[0].rooms);
        for scores in row {
            let _ = write!(text, " {} | {:.2} | {:.2} |", scores.places, scores.panoptic, scores.strict);
        }
        text.push('\n');
    }
    text += "| **mean** | |";
    for set in 0..SETS.len() {
        let of = |figure: fn(&Scores) -> f64| {
            let figures = scores.iter().skip(set).step_by(SETS.len()).map(figure);
            figures.sum::<f64>() / names.len().max(1) as f64
        };
        let _ = write!(text, " | {:.3} | {:.3} |", of(|scores| scores.panoptic), of(|scores| scores.strict));
    }
    Ok(text + "\n")
}

fn score(folder: &Path, image: &str) -> Outcome<Scores> {
    let site = sites::read_image(&folder.join(image), &folder.join("map.yaml"))?;
    let analysis = sites::analyzed(&site.grid, &AnalysisSpec::default())?;
    let semantic = sites::suggested(&analysis);
    let (width, height) = (analysis.width, analysis.height);
    let faces = CellFaces::rasterize(&analysis.subdivision, width, height, site.grid.resolution());
    let map = image::open(folder.join(image))?.into_luma8();
    let is_white: Vec<bool> = map.rows().rev().flatten().map(|pixel| pixel.0[0] >= WHITE).collect();
    let place = |cell: usize| {
        let (column, row) = (cell % width, cell / width);
        let is_free = is_white[cell];
        let place = semantic.face_places[faces.at(column, row).index()].filter(|_| is_free);
        place.map_or(0, |place| place as usize + 1)
    };
    let truth = image::open(folder.join("gt_segmentation.png"))?.into_luma8();
    if truth.dimensions() != map.dimensions() {
        return Err(format!("{}: map and truth differ in size", folder.display()).into());
    }
    let places = without_small((0..width * height).map(place).collect());
    let is_room: Vec<bool> = truth.rows().rev().flatten().map(|pixel| pixel.0[0] >= WHITE).collect();
    let rooms = without_small(components(&is_room, width));
    Ok(Contingency::of(&places, &rooms).scores())
}

/// Numbers eight-connected components from 1; 0 where there is none.
fn components(is_in: &[bool], width: usize) -> Vec<usize> {
    let mut numbers = vec![0; is_in.len()];
    let (mut count, mut open) = (0, Vec::new());
    for start in 0..is_in.len() {
        if !is_in[start] || numbers[start] > 0 {
            continue;
        }
        count += 1;
        numbers[start] = count;
        open.push(start);
        while let Some(cell) = open.pop() {
            let (column, row) = (cell % width, cell / width);
            for row in row.saturating_sub(1)..(row + 2).min(is_in.len() / width) {
                for near in (column.saturating_sub(1)..(column + 2).min(width)).map(|column| row * width + column) {
                    if is_in[near] && numbers[near] == 0 {
                        numbers[near] = count;
                        open.push(near);
                    }
                }
            }
        }
    }
    numbers
}

/// Segments of more than [`SMALLEST`] cells.
pub fn without_small(mut labels: Vec<usize>) -> Vec<usize> {
    let mut sizes = vec![0; labels.iter().max().map_or(1, |&last| last + 1)];
    for &label in &labels {
        sizes[label] += 1;
    }
    for label in labels.iter_mut().filter(|label| sizes[**label] <= SMALLEST) {
        *label = 0;
    }
    labels
}

/// How many cells places and rooms have, and have in common; 0 is no segment.
pub struct Contingency {
    places: BTreeMap<usize, f64>,
    rooms: BTreeMap<usize, f64>,
    common: BTreeMap<(usize, usize), f64>,
    /// Cells of a place or a room.
    cells: f64,
}

impl Contingency {
    pub fn of(places: &[usize], rooms: &[usize]) -> Self {
        let mut table = Self { places: BTreeMap::new(), rooms: BTreeMap::new(), common: BTreeMap::new(), cells: 0.0 };
        for (&place, &room) in places.iter().zip(rooms).filter(|&(&place, &room)| place + room > 0) {
            table.cells += 1.0;
            if place > 0 {
                *table.places.entry(place).or_default() += 1.0;
            }
            if room > 0 {
                *table.rooms.entry(room).or_default() += 1.0;
            }
            if place > 0 && room > 0 {
                *table.common.entry((place, room)).or_default() += 1.0;
            }
        }
        table
    }

    pub fn scores(&self) -> Scores {
        let segments = (self.places.len() + self.rooms.len()) as f64;
        let overlap = |(&(place, room), &common): (&(usize, usize), &f64)| {
            common / (self.places[&place] + self.rooms[&room] - common)
        };
        // The pairs above one half, twice over all segments: their mean overlap times their F1.
        let matched: f64 = self.common.iter().map(overlap).filter(|&overlap| overlap > 0.5).sum();
        Scores {
            panoptic: 2.0 * matched / segments.max(1.0),
            strict: self.strict(),
            places: self.places.len(),
            rooms: self.rooms.len(),
        }
    }

    fn strict(&self) -> f64 {
        let mut candidates: BTreeMap<usize, Vec<(usize, f64)>> = BTreeMap::new();
        for (&(place, room), &common) in &self.common {
            candidates.entry(place).or_default().push((room, common));
        }
        for rooms in candidates.values_mut() {
            rooms.sort_by(|one, other| other.1.total_cmp(&one.1));
        }
        let mut order: Vec<(usize, Vec<(usize, f64)>)> = candidates.into_iter().collect();
        order.sort_by(|one, other| other.1[0].1.total_cmp(&one.1[0].1));
        let mut taken = std::collections::BTreeSet::new();
        let mut sum = 0.0;
        for (place, rooms) in &order {
            if let Some(&(room, common)) = rooms.iter().find(|(room, _)| !taken.contains(room)) {
                taken.insert(room);
                sum += self.correlation(self.places[place], self.rooms[&room], common);
            }
        }
        // Pairs, and whatever has no partner.
        let count = self.places.len() + self.rooms.len() - taken.len();
        sum / count.max(1) as f64
    }

    /// Matthews correlation of a place of so many cells and a room.
    fn correlation(&self, place: f64, room: f64, common: f64) -> f64 {
        let (false_cells, missed) = (place - common, room - common);
        let neither = self.cells - common - false_cells - missed;
        let norm = (place * room * (neither + false_cells) * (neither + missed)).sqrt();
        if norm > 0.0 { (common * neither - false_cells * missed) / norm } else { 0.0 }
    }
}
