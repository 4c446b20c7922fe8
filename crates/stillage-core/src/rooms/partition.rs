//! Rooms: what is left of the ground when every passage is closed, each with its share of the walls around it.
//!
//! Components of the ground between the closed passages are rooms where they are large enough; smaller ones belong to
//! the room that they open to. Then walls are shared among the rooms beside them, so that two rooms meet in the middle
//! of the wall between them; stacks keep their own ground. Cost: O(cells).

use std::collections::VecDeque;

use super::flood::Passage;
use super::ground::Ground;
use super::nearest::{NONE, Nearest};
use crate::components::{Components, Neighbours};
use crate::watch::{Stopped, Watch};

/// Smaller components are no rooms, square metres: a cupboard that one can stand in.
const LEAST_ROOM_M2: f64 = 1.0;
/// A room has this much of the wall around it, metres: walls between rooms are up to twice as thick.
const WALL_SHARE_M: f64 = 0.25;

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
    pub(super) fn of<'a>(
        ground: &Ground,
        passages: impl Iterator<Item = &'a Passage>,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let mut is_open = ground.is_free.clone();
        for passage in passages {
            for cell in cells_along(ground, passage) {
                is_open[cell] = false;
            }
        }
        let (count, mut rooms) = components(ground, &is_open, watch)?;
        spread(ground, &mut rooms);
        let nearest = Nearest::of(ground.width, rooms.len(), |cell| rooms[cell] != 0, watch)?;
        let reach = ground.cells_of(WALL_SHARE_M) as u32;
        let shared: Vec<u32> = (0..rooms.len())
            .map(|cell| match nearest.cell[cell] {
                near if near != NONE && nearest.squared[cell] <= reach * reach && !ground.is_stack[cell] => {
                    rooms[near as usize]
                }
                _ => 0,
            })
            .collect();
        Ok(Self { count, rooms: shared, nearest: nearest.cell })
    }

    /// The room whose ground is nearest to a cell, however far; 0 without rooms.
    pub(super) fn nearest_room(&self, cell: usize) -> u32 {
        let near = self.nearest[cell];
        if near == NONE { 0 } else { self.rooms[near as usize] }
    }
}

/// The cells of a line across a passage, without a gap that a step up, down, left or right could take.
fn cells_along(ground: &Ground, passage: &Passage) -> impl Iterator<Item = usize> {
    let [from, to] = passage.ends;
    let span = [to[0] - from[0], to[1] - from[1]];
    let steps = 2 * span[0].abs().max(span[1].abs()).max(1);
    let width = ground.width;
    (0..=steps).map(move |step| {
        let at = |axis: usize| (from[axis] as f64 + (span[axis] * step) as f64 / steps as f64).round() as usize;
        at(1) * width + at(0)
    })
}

/// Four-connected components that are large enough, numbered in the order of their first cells.
fn components(ground: &Ground, is_open: &[bool], watch: &Watch<'_>) -> Result<(usize, Vec<u32>), Stopped> {
    let least = (LEAST_ROOM_M2 / (ground.cell * ground.cell)).ceil() as usize;
    let (mut count, mut rooms) = (0, vec![0; is_open.len()]);
    let found = Components::of([ground.width, is_open.len()], Neighbours::Four, |cell| is_open[cell], watch)?;
    for room in found.iter().filter(|room| room.len() >= least) {
        count += 1;
        room.cells().for_each(|cell| rooms[cell] = count);
    }
    Ok((count as usize, rooms))
}

/// Gives the rest of the ground to the rooms it is joined with, step by step.
fn spread(ground: &Ground, rooms: &mut [u32]) {
    let mut open: VecDeque<usize> = (0..rooms.len()).filter(|&cell| rooms[cell] != 0).collect();
    while let Some(cell) = open.pop_front() {
        for near in beside(ground, cell) {
            if ground.is_free[near] && rooms[near] == 0 {
                rooms[near] = rooms[cell];
                open.push_back(near);
            }
        }
    }
}

fn beside(ground: &Ground, cell: usize) -> [usize; 4] {
    [cell - 1, cell + 1, cell - ground.width, cell + ground.width]
}
