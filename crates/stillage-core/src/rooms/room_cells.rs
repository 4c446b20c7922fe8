//! The room of every cell, and from it the room of every face.
//!
//! Cost: O(cells + runs log runs) for the faces, a run being neighbouring cells of a row with one face and one room.

use crate::arrangement::{CellFaces, FaceId};
use crate::geometry::Point;
use crate::runs::runs_of_equal;

/// Which cells lie in rooms, and the doorways between them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RoomCells {
    /// Number of rooms.
    pub count: usize,
    /// Room of each cell, row-major: 1 to `count`, larger numbers for the stacks that stand in them, 0 for neither.
    /// Empty without rooms.
    pub cells: Vec<u32>,
    /// Lines from jamb to jamb of the doorways between two rooms, or a room and a hall; metres of the grid frame.
    pub doorways: Vec<[Point; 2]>,
}

impl RoomCells {
    /// The room that most cells of each face lie in, by face id; rooms are numbered anew by their first face. Empty
    /// without rooms.
    #[must_use]
    pub fn of_faces(&self, face_count: usize, cells: &CellFaces) -> Vec<Option<u32>> {
        if self.count == 0 {
            return Vec::new();
        }
        let pairs: Vec<(FaceId, u32)> = cells.as_slice().iter().copied().zip(self.cells.iter().copied()).collect();
        let mut runs: Vec<(FaceId, u32, usize)> =
            runs_of_equal(&pairs).map(|run| (pairs[run.start].0, pairs[run.start].1, run.len())).collect();
        runs.sort_unstable();
        let mut room_of = vec![0; face_count];
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
