//! Which rooms are halls with storage that no rows were laid out in: whole racks, stacks of goods, shelves.
//!
//! Cost: O(cells).

use std::collections::BTreeMap;

use crate::geometry::OrientedBox;
use crate::grid::OccupancyGrid;
use crate::plot::PlotKind;
use crate::rooms::{RoomCells, Stacks};

/// Least area of such a hall, square metres: two racks of four places and the aisles along them.
const HALL_M2: f64 = 60.0;
/// Least share of its ground that stacks stand on: offices have some cupboards, halls have rows.
const STACKS_SHARE: f64 = 0.02;
/// Least number of stacks.
const LEAST_STACKS: usize = 3;

/// The rooms with storage, each with the boxes around its stacks.
pub(super) type StorageRooms = BTreeMap<u32, Vec<OrientedBox>>;

/// The rooms with storage.
pub(super) fn find(grid: &OccupancyGrid, rooms: &RoomCells, stacks: &Stacks) -> StorageRooms {
    let mut areas = vec![0_usize; rooms.count + 1];
    for &room in &rooms.cells {
        areas[room as usize] += 1;
    }
    let mut found = StorageRooms::new();
    for (&room, &bounds) in stacks.rooms.iter().zip(&stacks.footprints).filter(|(room, _)| **room != 0) {
        found.entry(room).or_default().push(bounds);
    }
    found.retain(|&room, bodies| {
        let area = areas[room as usize] as f64 * grid.resolution().powi(2);
        let taken: f64 = bodies.iter().map(OrientedBox::area).sum();
        area >= HALL_M2 && bodies.len() >= LEAST_STACKS && taken >= STACKS_SHARE * area
    });
    found
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
