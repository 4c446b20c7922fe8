//! The storage layout of a map: locations, aisles and rows, numbered.

use std::collections::BTreeSet;

use rayon::prelude::*;

use super::access::{self, AccessSide};
use super::aisle::{Aisle, Row};
use super::aisles::{AisleFront, FrontLine, aisles_of};
use super::approach::{ApproachFront, Stands};
use super::code_template::{CodeNumbers, CodeTemplate};
use super::depths::{DepthInRow, depths};
use super::draft::{Draft, drafts_of};
use super::layout_spec::LayoutSpec;
use super::location::{Location, Side};
use super::rows;
use crate::arrangement::FaceId;
use crate::site_map::SiteMap;

/// Everything there is to say about where goods are stored.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Layout {
    /// Storage locations, by aisle, bay and depth.
    pub locations: Vec<Location>,
    /// Aisles, by number.
    pub aisles: Vec<Aisle>,
    /// Rows, by number.
    pub rows: Vec<Row>,
    /// Codes of the wished template that are too long. Where there are some, all codes are of the default template.
    pub long_codes: Vec<String>,
}

/// The numbers of one location.
#[derive(Debug, Clone, Copy)]
struct Numbers {
    aisle: u32,
    bay: u32,
    row: u32,
    side: Option<Side>,
    depth: u32,
}

/// Finds the storage locations of a map and numbers them.
#[must_use]
pub fn layout(map: &SiteMap<'_>, spec: &LayoutSpec) -> Layout {
    let subdivision = &map.analysis.subdivision;
    let faces: Vec<FaceId> = subdivision.faces().filter(|&face| map.semantic.label(face).is_storage()).collect();
    let mut sides = access::sides_of(map, &faces, spec.vehicle_radius);
    let (mut drafts, mut depths) = drafted(map, &faces, &sides, spec);
    let is_reached: BTreeSet<FaceId> =
        drafts.iter().zip(&depths).filter(|(_, depth)| depth.is_some()).map(|(draft, _)| draft.face).collect();
    let without: Vec<usize> = (0..faces.len()).filter(|&index| !is_reached.contains(&faces[index])).collect();
    if !without.is_empty() {
        access::reach_from_any_ground(map, &faces, &without, spec.vehicle_radius, &mut sides);
        (drafts, depths) = drafted(map, &faces, &sides, spec);
    }
    let mut numbering = Numbering::new(&drafts, &depths);
    for line in aisles_of(fronts(map, &drafts), spec.entrance) {
        numbering.add_aisle(map, &line, 2.0 * spec.vehicle_radius);
    }
    numbering.number_the_rest();
    numbering.finish(map, spec)
}

/// The locations of storage faces that are reached from these sides, and how they lie in their rows.
fn drafted(
    map: &SiteMap<'_>,
    faces: &[FaceId],
    sides: &[Vec<AccessSide>],
    spec: &LayoutSpec,
) -> (Vec<Draft>, Vec<Option<DepthInRow>>) {
    let mut drafts: Vec<Draft> = faces
        .par_iter()
        .zip(sides)
        .flat_map_iter(|(&face, sides)| drafts_of(map, face, sides.first(), spec.place_width))
        .collect();
    let depths = depths(map, &mut drafts);
    (drafts, depths)
}

fn fronts(map: &SiteMap<'_>, drafts: &[Draft]) -> Vec<AisleFront> {
    let front = |(location, draft): (usize, &Draft)| {
        let front = draft.front?;
        let place = map.semantic.face_places[front.from.index()]?;
        Some(AisleFront { location, middle: front.middle, heading: draft.heading, place })
    };
    drafts.iter().enumerate().filter_map(front).collect()
}

/// Gives numbers to locations, aisle by aisle.
struct Numbering<'a> {
    drafts: &'a [Draft],
    /// Locations behind each location at an aisle, by depth.
    behind: Vec<Vec<usize>>,
    depths: &'a [Option<DepthInRow>],
    numbers: Vec<Option<Numbers>>,
    aisles: Vec<Aisle>,
    rows: Vec<Row>,
}

impl<'a> Numbering<'a> {
    fn new(drafts: &'a [Draft], depths: &'a [Option<DepthInRow>]) -> Self {
        let mut behind = vec![Vec::new(); drafts.len()];
        for (index, depth) in depths.iter().enumerate() {
            if let Some(DepthInRow { number: 2.., first }) = *depth {
                behind[first].push(index);
            }
        }
        for places in &mut behind {
            places.sort_by_key(|&index| (depths[index].map(|depth| depth.number), index));
        }
        Self { drafts, behind, depths, numbers: vec![None; drafts.len()], aisles: Vec::new(), rows: Vec::new() }
    }

    /// Numbers the locations of the next aisle: odd bays on the left, even ones on the right.
    fn add_aisle(&mut self, map: &SiteMap<'_>, line: &FrontLine, vehicle: f64) {
        let number = self.aisles.len() as u32 + 1;
        let mut aisle = rows::course(map, number, line, self.drafts);
        for (side, first_bay) in [(Side::Left, 1), (Side::Right, 2)] {
            let mut bay = first_bay;
            for row in rows::cut_rows(line, side, self.drafts, vehicle) {
                let row_number = self.rows.len() as u32 + 1;
                let mut behind = Vec::new();
                let mut members = Vec::new();
                for AisleFront { location, .. } in row {
                    let numbers = Numbers { aisle: number, bay, row: row_number, side: Some(side), depth: 1 };
                    members.push(location);
                    self.numbers[location] = Some(numbers);
                    behind.extend(self.number_behind(location, numbers));
                    bay += 2;
                }
                members.extend(behind);
                let listed = if side == Side::Left { &mut aisle.left } else { &mut aisle.right };
                listed.extend(&members);
                let layers =
                    members.iter().filter_map(|&member| self.numbers[member]).map(|numbers| numbers.depth).max();
                let layers = layers.unwrap_or(1);
                self.rows.push(rows::row(row_number, number, side, line.angle, members, layers, self.drafts));
            }
        }
        self.aisles.push(aisle);
    }

    /// Numbers the locations behind one at the aisle, and lists them.
    fn number_behind(&mut self, location: usize, first: Numbers) -> Vec<usize> {
        let behind = std::mem::take(&mut self.behind[location]);
        // Two places side by side behind one have the same depth: they are counted one after the other.
        for (depth, &index) in (2..).zip(&behind) {
            self.numbers[index] = Some(Numbers { depth, ..first });
        }
        behind
    }

    /// Counts the locations without an aisle from the bottom of the map, then from the left.
    fn number_the_rest(&mut self) {
        let mut rest: Vec<usize> = (0..self.drafts.len()).filter(|&index| self.numbers[index].is_none()).collect();
        let center = |index: usize| self.drafts[index].center;
        rest.sort_by(|&first, &second| {
            let upwards = center(first).y.total_cmp(&center(second).y);
            upwards.then(center(first).x.total_cmp(&center(second).x)).then(first.cmp(&second))
        });
        for (bay, index) in (1..).zip(rest) {
            let depth = self.depths[index].map_or(1, |depth| depth.number);
            self.numbers[index] = Some(Numbers { aisle: 0, bay, row: 0, side: None, depth });
        }
    }

    /// Writes the codes and sorts the locations; aisles and rows name them by their new indices.
    fn finish(self, map: &SiteMap<'_>, spec: &LayoutSpec) -> Layout {
        let Self { drafts, depths, numbers, mut aisles, mut rows, .. } = self;
        let numbers: Vec<Numbers> = numbers.into_iter().flatten().collect();
        let all: Vec<CodeNumbers> = numbers.iter().map(Numbers::code).collect();
        let mut order: Vec<usize> = (0..drafts.len()).collect();
        order.sort_by_key(|&index| (numbers[index].aisle, numbers[index].bay, numbers[index].depth));
        let (codes, long_codes) = match spec.code.write_all(&all) {
            Ok(codes) => (codes, Vec::new()),
            Err(long) => (CodeTemplate::default().write_all(&all).unwrap_or_else(|codes| codes), long),
        };
        let widest = drafts.iter().map(|draft| draft.width).fold(0.0, f64::max);
        let stands = Stands::new(spec.vehicle_radius, widest, map.grid.resolution());
        let location = |&index: &usize| {
            let first = depths[index].map_or(index, |depth| depth.first);
            let (own, served) = (&drafts[index], &drafts[first]);
            let front = served.front.map(|front| front.middle);
            let approach = front.and_then(|middle| {
                let front = ApproachFront { middle, heading: served.heading, width: served.width };
                stands.approach(map, front)
            });
            let from = served.front.map(|front| front.from);
            let corridor = from.and_then(|face| map.semantic.face_places[face.index()]);
            let Numbers { aisle, bay, row, side, depth } = numbers[index];
            Location {
                code: codes[index].clone(),
                face: own.face,
                part: own.part,
                parts: own.parts,
                outline: own.outline.clone(),
                label: map.semantic.labels[own.face.index()],
                aisle,
                bay,
                row,
                side,
                depth_in_row: depth,
                center: own.center,
                width: own.width,
                depth: own.depth,
                heading: own.heading,
                area: own.area,
                occupancy: own.occupancy,
                access_edges: served.edges.clone(),
                access_from: from,
                corridor,
                front,
                approach,
            }
        };
        let locations: Vec<Location> = order.par_iter().map(location).collect();
        let mut places = vec![0; order.len()];
        for (place, &index) in order.iter().enumerate() {
            places[index] = place;
        }
        let lists = aisles.iter_mut().flat_map(|aisle| [&mut aisle.left, &mut aisle.right]);
        for index in lists.chain(rows.iter_mut().map(|row| &mut row.locations)).flatten() {
            *index = places[*index];
        }
        Layout { locations, aisles, rows, long_codes }
    }
}

impl Numbers {
    fn code(&self) -> CodeNumbers {
        CodeNumbers { aisle: self.aisle, bay: self.bay, row: self.row, depth: self.depth, side: self.side }
    }
}
