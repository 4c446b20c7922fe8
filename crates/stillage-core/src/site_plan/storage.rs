//! Which rooms are halls with storage that no rows were laid out in: whole racks, stacks of goods, shelves.
//!
//! Only the room that holds most of a site's ground can be one; in all others thick things are furniture. What nobody saw
//! deep inside is no goods either, but a room that was not entered. Cost: O(cells).

use std::collections::BTreeMap;

use crate::distance_transform::DistanceTransform;
use crate::geometry::OrientedBox;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::plot::PlotKind;
use crate::rooms::{RoomCells, Stacks};
use crate::watch::{Stopped, Watch};

/// Least area of such a hall, square metres: two racks of four places and the aisles along them.
const HALL_M2: f64 = 60.0;
/// Least share of its ground that stacks stand on: offices have some cupboards, halls have rows.
const STACKS_SHARE: f64 = 0.02;
/// Least number of stacks.
const LEAST_STACKS: usize = 3;

/// Unseen ground further than this from all that was seen is nobody's, metres: goods are seen from an aisle, and rows
/// back to back are up to 3 deep.
const UNSEEN_M: f64 = 3.0;

/// The rooms with storage, each with the boxes around its stacks.
pub(super) type StorageRooms = BTreeMap<u32, Vec<OrientedBox>>;

/// The rooms with storage; `hall` is the one that may have some.
pub(super) fn find(
    grid: &OccupancyGrid,
    rooms: &RoomCells,
    stacks: &Stacks,
    hall: Option<u32>,
    watch: &Watch<'_>,
) -> Result<StorageRooms, Stopped> {
    let Some(hall) = hall else { return Ok(StorageRooms::new()) };
    if holds_unseen_ground(grid, stacks, watch)? {
        return Ok(StorageRooms::new());
    }
    let mut areas = vec![0_usize; rooms.count + 1];
    for &room in &rooms.cells {
        areas[room as usize] += 1;
    }
    let mut found = StorageRooms::new();
    for (&room, &bounds) in stacks.rooms.iter().zip(&stacks.footprints).filter(|(room, _)| **room == hall) {
        found.entry(room).or_default().push(bounds);
    }
    found.retain(|&room, bodies| {
        let area = areas[room as usize] as f64 * grid.resolution().powi(2);
        let taken: f64 = bodies.iter().map(OrientedBox::area).sum();
        area >= HALL_M2 && bodies.len() >= LEAST_STACKS && taken >= STACKS_SHARE * area
    });
    Ok(found)
}

/// Whether nobody knows what is inside of a stack: then the site is rooms around rooms that were not entered.
fn holds_unseen_ground(grid: &OccupancyGrid, stacks: &Stacks, watch: &Watch<'_>) -> Result<bool, Stopped> {
    let is_seen = |cell: usize| grid.cells()[cell] != Occupancy::Unknown;
    let from_seen = DistanceTransform::of(grid.width(), stacks.cells.len(), is_seen, watch)?;
    let reach = (UNSEEN_M / grid.resolution()).powi(2);
    let is_deep = |(&stack, squared): (&u32, u32)| stack != 0 && f64::from(squared) > reach;
    Ok(stacks.cells.iter().zip(from_seen.squared).any(is_deep))
}

/// Makes the stacks parts of the rooms: places in halls, furniture elsewhere.
pub(super) fn add_stacks(rooms: &mut RoomCells, stacks: &Stacks, storage: &StorageRooms) {
    let kind = |room: &u32| if storage.contains_key(room) { PlotKind::Place } else { PlotKind::Other };
    let numbers: Vec<u32> = stacks.rooms.iter().map(|room| rooms.add_part(kind(room))).collect();
    for (cell, stack) in rooms.cells.iter_mut().zip(&stacks.cells) {
        if let Some(stack) = stack.checked_sub(1) {
            *cell = numbers[stack as usize];
        }
    }
}
