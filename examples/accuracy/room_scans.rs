//! Places of scanned offices against the rooms and doors that a person drew (the floors of the Gates Dell Complex, UT Austin
//! Building-Wide Intelligence: `locations.pgm` and `doors.yaml` beside the map).
//!
//! Panoptic quality as for plain maps ([`crate::rooms`]), on free cells of drawn rooms; a place that lies in no drawn room by
//! more than half is not counted. A door is found when the middle of one lies within [`NEAR_M`] of its own.

use std::fs;
use std::path::Path;

use rayon::prelude::*;
use stillage_core::arrangement::CellFaces;
use stillage_core::{AnalysisSpec, Occupancy, Point};

use crate::rooms::{Contingency, without_small};
use crate::tables::{percent, table};
use crate::{Outcome, sites};

/// Greatest distance of a door from a true one, metres: the width of a door.
const NEAR_M: f64 = 1.0;
/// Grey level of `locations.pgm` where no room is drawn.
const NO_ROOM: u8 = 255;

/// The table of all scans with drawn rooms in a folder.
pub fn scans(folder: &Path) -> Outcome<String> {
    let mut names = sites::names(folder, "")?;
    names.retain(|name| folder.join(name).join("locations.pgm").is_file());
    let rows: Vec<Vec<String>> = names.par_iter().map(|name| row(&folder.join(name), name)).collect::<Outcome<_>>()?;
    let head = ["map", "rooms", "places", "PQ", "doors", "found", "told", "found of those told"];
    Ok(table(&head, rows.into_iter()))
}

fn row(folder: &Path, name: &str) -> Outcome<Vec<String>> {
    let site = sites::read(&folder.join("map.yaml"))?;
    let analysis = sites::analyzed(&site.grid, &AnalysisSpec::default())?;
    let semantic = sites::suggested(&analysis);
    let (width, cells) = (analysis.width, site.grid.cells());
    let faces = CellFaces::rasterize(&analysis.subdivision, width, analysis.height, site.grid.resolution());
    let drawn = image::open(folder.join("locations.pgm"))?.into_luma8();
    let drawn: Vec<u8> = drawn.rows().rev().flatten().map(|pixel| pixel.0[0]).collect();
    if drawn.len() != cells.len() {
        return Err(format!("{name}: map and rooms differ in size").into());
    }
    let is_free = |cell: usize| cells[cell] == Occupancy::Free;
    let place = |cell: usize| {
        let place = semantic.face_places[faces.at(cell % width, cell / width).index()].filter(|_| is_free(cell));
        place.map_or(0, |place| place as usize + 1)
    };
    let mut places: Vec<usize> = (0..cells.len()).map(place).collect();
    let rooms: Vec<usize> = (0..cells.len())
        .map(|cell| if is_free(cell) && drawn[cell] != NO_ROOM { drawn[cell] as usize + 1 } else { 0 })
        .collect();
    let mut inside = vec![0_i64; semantic.places.len() + 1];
    for (&place, &room) in places.iter().zip(&rooms) {
        inside[place] += if room > 0 { 1 } else { -1 };
    }
    for (place, &room) in places.iter_mut().zip(&rooms) {
        if room == 0 || inside[*place] <= 0 {
            *place = 0;
        }
    }
    let scores = Contingency::of(&without_small(places), &without_small(rooms)).scores();
    let true_doors = true_doors(&fs::read_to_string(folder.join("doors.yaml"))?)?;
    let told: Vec<Point> = analysis
        .rooms
        .doors
        .iter()
        .map(|door| analysis.frame.to_map(nalgebra::center(&door.ends[0], &door.ends[1])))
        .collect();
    let found = found(&true_doors, told.clone());
    let share = |of: usize| percent(found as f64 / of.max(1) as f64);
    Ok(vec![
        name.replace("office__", ""),
        scores.rooms.to_string(),
        scores.places.to_string(),
        format!("{:.2}", scores.panoptic),
        true_doors.len().to_string(),
        share(true_doors.len()),
        told.len().to_string(),
        share(told.len()),
    ])
}

/// The middles of the doors of a file, metres of the map frame.
fn true_doors(text: &str) -> Outcome<Vec<Point>> {
    let corner = |line: &str| -> Outcome<Option<Point>> {
        let Some((_, list)) = line.split_once("door_corner_pt_") else { return Ok(None) };
        let list = list.split_once('[').and_then(|(_, rest)| rest.split_once(']')).ok_or("a corner is a list")?.0;
        let numbers: Vec<f64> = list.split(',').map(|number| number.trim().parse()).collect::<Result<_, _>>()?;
        match numbers[..] {
            [x, y] => Ok(Some(Point::new(x, y))),
            _ => Err("a corner has two coordinates".into()),
        }
    };
    let corners: Vec<Point> = text.lines().map(corner).filter_map(Outcome::transpose).collect::<Outcome<_>>()?;
    Ok(corners.chunks_exact(2).map(|pair| nalgebra::center(&pair[0], &pair[1])).collect())
}

/// How many true doors have one of their own near them.
fn found(true_doors: &[Point], mut told: Vec<Point>) -> usize {
    let mut count = 0;
    for door in true_doors {
        let nearest =
            (0..told.len()).min_by(|&one, &other| (told[one] - door).norm().total_cmp(&(told[other] - door).norm()));
        if let Some(index) = nearest.filter(|&index| (told[index] - door).norm() <= NEAR_M) {
            told.swap_remove(index);
            count += 1;
        }
    }
    count
}
