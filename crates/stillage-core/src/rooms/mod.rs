//! Rooms: the ground that walls divide, with the doors between them.
//!
//! ```text
//! grid ── ground ── nearest obstacle ── flood ── passages ── partition ── outline ── lines
//!                                                   └── doors ── edges of the subdivision
//! ```
//!
//! Racks repeat, walls do not: where no rows of places are found, a site is made of rooms. Necks of the ground with
//! walls at their ends are closed ([`flood`]), what is left are the rooms ([`partition`]), and their borders, straightened,
//! are the lines of the subdivision ([`outline`]), so every room is a union of faces. What juts out of a hall behind a gate
//! is a room as well ([`bays`]); goods that stand in rooms keep their own ground ([`stacks`]). [`mod@plan`] says which
//! ground is rooms and which is rows.
//!
//! Cost: O(cells log cells). Limits: openings as wide as the room behind them part nothing.

mod bays;
mod doors;
mod flood;
mod ground;
mod nearest;
mod outline;
mod partition;
mod plan;
mod stacks;

#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use crate::annotation::CellFaces;
use crate::arrangement::{EdgeId, FaceId, Subdivision};
use crate::geometry::Point;
use crate::grid::OccupancyGrid;

pub use plan::{SitePlan, plan};

/// Which cells lie in rooms, and the narrow lines between them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rooms {
    /// Number of rooms.
    pub count: usize,
    /// Room of each cell, row-major: 1 to `count`, larger numbers for the stacks that stand in them, 0 for neither. Empty
    /// without rooms.
    pub cells: Vec<u32>,
    /// Lines across the passages between two rooms, or a room and a hall; metres of the grid frame.
    pub passages: Vec<[Point; 2]>,
}

/// The rooms and doors of a subdivision.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RoomMap {
    /// Room of each face, by face id (entry 0, the unbounded face, has none). Empty without rooms.
    pub faces: Vec<Option<u32>>,
    /// Narrow passages between two rooms, or between a room and other ground.
    pub doors: Vec<Door>,
}

/// A narrow passage between two places.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Door {
    /// From jamb to jamb, metres of the grid frame.
    pub ends: [Point; 2],
    /// The edges that run through it, ascending; at least one.
    pub edges: Vec<EdgeId>,
    /// The faces that its first edge lies between.
    pub faces: [FaceId; 2],
}

impl Door {
    /// Distance between the jambs, metres.
    #[must_use]
    pub fn width(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }
}

impl RoomMap {
    /// Finds the faces of each room and the edges of each door.
    #[must_use]
    pub fn of(rooms: &Rooms, subdivision: &Subdivision, grid: &OccupancyGrid) -> Self {
        let faces = rooms.of_faces(subdivision, grid);
        let doors = doors::of(&rooms.passages, subdivision, &faces);
        Self { faces, doors }
    }

    /// Room of a face.
    #[must_use]
    pub fn room(&self, face: FaceId) -> Option<u32> {
        self.faces.get(face.index()).copied().flatten()
    }
}

impl Rooms {
    /// The room that most cells of each face lie in, by face id; rooms are numbered anew by their first face. Empty
    /// without rooms.
    #[must_use]
    pub fn of_faces(&self, subdivision: &Subdivision, grid: &OccupancyGrid) -> Vec<Option<u32>> {
        if self.count == 0 {
            return Vec::new();
        }
        let cells = CellFaces::rasterize(subdivision, grid.width(), grid.height(), grid.resolution());
        let pairs: Vec<(FaceId, u32)> = cells.as_slice().iter().copied().zip(self.cells.iter().copied()).collect();
        let mut runs: Vec<(FaceId, u32, usize)> =
            pairs.chunk_by(PartialEq::eq).map(|run| (run[0].0, run[0].1, run.len())).collect();
        runs.sort_unstable();
        let mut room_of = vec![0; subdivision.face_count()];
        for runs in runs.chunk_by(|one, other| one.0 == other.0).filter(|runs| runs[0].0 != FaceId::OUTER) {
            let cells = |runs: &&[(FaceId, u32, usize)]| runs.iter().map(|run| run.2).sum::<usize>();
            let most = runs.chunk_by(|one, other| one.1 == other.1).max_by_key(cells);
            room_of[runs[0].0.index()] = most.map_or(0, |runs| runs[0].1);
        }
        let mut numbers = vec![None; self.count + 1];
        let mut next = 0;
        let number = |room: u32| {
            if room == 0 || room as usize > self.count {
                return None;
            }
            let number = numbers[room as usize].get_or_insert_with(|| {
                next += 1;
                next - 1
            });
            Some(*number)
        };
        room_of.into_iter().map(number).collect()
    }
}
