//! The room of every cell: what is left of the ground when every doorway is closed, with a share of the walls around
//! it.
//!
//! Components of the ground between the closed doorways are rooms where they are large enough; smaller ones belong to
//! the room that they are open to. Then walls are shared among the rooms beside them, so that two rooms meet in the
//! middle of the wall between them. Cost: O(cells + lengths of the doorways).

use std::collections::VecDeque;

use super::doorways::Doorway;
use super::ground::{Jambs, RoomGround};
use crate::components::{Components, Neighbours};
use crate::distance_transform::{DistanceTransform, NONE};
use crate::geometry::DisjointSets;
use crate::watch::{Stopped, Watch};

/// Least area of a room, square metres: a cupboard that one can stand in.
const LEAST_ROOM_M2: f64 = 1.0;
/// How much of the wall around it belongs to a room, metres: walls between rooms are up to twice as thick.
const WALL_SHARE_M: f64 = 0.25;
/// Distance from a doorway at which its two sides are looked up, metres: beyond the cells of the doorway itself, which
/// went to either room.
const BESIDE_M: f64 = 0.2;
/// Cells that are spread to between two looks at the stop flag: well below 50 ms of work.
const CHECK_EVERY: usize = 1 << 20;

/// The room of every cell.
pub(super) struct Partition {
    /// Number of rooms.
    pub count: usize,
    /// Room of each cell, row-major: 1 to `count`, 0 for none. Rooms are numbered by their first cell.
    pub rooms: Vec<u32>,
    /// The nearest cell of a room's ground, near or far; [`NONE`] without rooms.
    pub nearest: Vec<u32>,
}

impl Partition {
    /// Divides the ground where lines between two jambs, or two parts of a wall, close it.
    pub(super) fn of(
        ground: &RoomGround,
        closed: impl Iterator<Item = Jambs>,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let mut is_open = ground.is_free.clone();
        for jambs in closed {
            ground.cells_between(&jambs).for_each(|cell| is_open[cell] = false);
        }
        let (count, mut rooms) = components(ground, &is_open, watch)?;
        spread(ground, &mut rooms, watch)?;
        let transform = DistanceTransform::of(ground.width, rooms.len(), |cell| rooms[cell] != 0, watch)?;
        let reach = ground.cells_of(WALL_SHARE_M) as u32;
        let shared: Vec<u32> = (0..rooms.len())
            .map(|cell| match transform.nearest[cell] {
                near if near != NONE && transform.squared[cell] <= reach * reach && !ground.is_stack[cell] => {
                    rooms[near as usize]
                }
                _ => 0,
            })
            .collect();
        Ok(Self { count, rooms: shared, nearest: transform.nearest })
    }

    /// Makes one room of all that are in one set.
    pub(super) fn join(&mut self, sets: &mut DisjointSets) {
        let mut numbers = vec![0; self.count + 1];
        self.count = 0;
        for room in 1..numbers.len() {
            let first = sets.find(room);
            if numbers[first] == 0 {
                self.count += 1;
                numbers[first] = self.count as u32;
            }
            numbers[room] = numbers[first];
        }
        self.rooms.iter_mut().for_each(|room| *room = numbers[*room as usize]);
    }

    /// The room whose ground is nearest to a cell, however far; 0 without rooms.
    pub(super) fn nearest_room(&self, cell: usize) -> u32 {
        let near = self.nearest[cell];
        if near == NONE { 0 } else { self.rooms[near as usize] }
    }

    /// The rooms on both sides of the middle of a doorway, 0 where there is none.
    pub(super) fn sides(&self, ground: &RoomGround, doorway: &Doorway) -> [u32; 2] {
        let [from, to] = doorway.ends.map(|end| end.map(|place| place as f64));
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = along[0].hypot(along[1]).max(1.0);
        let middle = [f64::midpoint(from[0], to[0]), f64::midpoint(from[1], to[1])];
        let step = ground.cells_of(BESIDE_M) as f64 + 1.0;
        [1.0, -1.0].map(|side| {
            let column = (middle[0] - side * step * along[1] / length).round() as i64;
            let row = (middle[1] + side * step * along[0] / length).round() as i64;
            if ground.holds(column, row) { self.rooms[row as usize * ground.width + column as usize] } else { 0 }
        })
    }
}

/// Four-connected components that are large enough, numbered in the order of their first cells.
fn components(ground: &RoomGround, is_open: &[bool], watch: &Watch<'_>) -> Result<(usize, Vec<u32>), Stopped> {
    let least = (LEAST_ROOM_M2 / (ground.cell * ground.cell)).ceil() as usize;
    let (mut count, mut rooms) = (0, vec![0; is_open.len()]);
    let found = Components::of([ground.width, is_open.len()], Neighbours::Four, |cell| is_open[cell], watch)?;
    for room in found.iter().filter(|room| room.len() >= least) {
        count += 1;
        room.cells().for_each(|cell| rooms[cell] = count);
    }
    Ok((count as usize, rooms))
}

/// Gives the rest of the ground to the rooms that it is connected with: each cell to the room reached in fewest steps.
fn spread(ground: &RoomGround, rooms: &mut [u32], watch: &Watch<'_>) -> Result<(), Stopped> {
    let mut open: VecDeque<usize> = (0..rooms.len()).filter(|&cell| rooms[cell] != 0).collect();
    let mut visited = 0_usize;
    while let Some(cell) = open.pop_front() {
        visited += 1;
        if visited.is_multiple_of(CHECK_EVERY) {
            watch.check()?;
        }
        for near in beside(ground, cell) {
            if ground.is_free[near] && rooms[near] == 0 {
                rooms[near] = rooms[cell];
                open.push_back(near);
            }
        }
    }
    Ok(())
}

fn beside(ground: &RoomGround, cell: usize) -> [usize; 4] {
    [cell - 1, cell + 1, cell - ground.width, cell + ground.width]
}
