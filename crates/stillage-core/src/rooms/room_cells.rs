//! The room of every cell, and from it the room of every face.
//!
//! Cost: O(cells + runs log faces) for the faces, a run being neighbouring cells of a row with one face and one room.

use std::collections::BTreeMap;

use crate::arrangement::{CellFaces, FaceId};
use crate::geometry::Point;
use crate::runs::runs_of_equal;
use crate::watch::{Stopped, Watch};

/// Cells that are counted between two looks at the stop flag: below 50 ms of work.
const CHECK_EVERY: usize = 1 << 18;

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
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    pub fn of_faces(
        &self,
        face_count: usize,
        cells: &CellFaces,
        watch: &Watch<'_>,
    ) -> Result<Vec<Option<u32>>, Stopped> {
        if self.count == 0 {
            return Ok(Vec::new());
        }
        let mut counts: BTreeMap<(FaceId, u32), usize> = BTreeMap::new();
        for (faces, rooms) in cells.as_slice().chunks(CHECK_EVERY).zip(self.cells.chunks(CHECK_EVERY)) {
            watch.check()?;
            let pairs: Vec<(FaceId, u32)> = faces.iter().copied().zip(rooms.iter().copied()).collect();
            for run in runs_of_equal(&pairs) {
                *counts.entry(pairs[run.start]).or_default() += run.len();
            }
        }
        let (mut room_of, mut most) = (vec![0; face_count], vec![0; face_count]);
        for ((face, room), count) in counts.into_iter().filter(|((face, _), _)| *face != FaceId::OUTER) {
            if count >= most[face.index()] {
                (room_of[face.index()], most[face.index()]) = (room, count);
            }
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
        Ok(room_of.into_iter().map(number).collect())
    }
}
