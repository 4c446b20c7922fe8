//! The room of every cell, and from it the room of every face.
//!
//! Cost: O(cells + runs log faces) for the faces, a run being neighbouring cells of a row with one face and one room.

use std::collections::BTreeMap;

use crate::arrangement::{CellFaces, FaceId};
use crate::geometry::Point;
use crate::plot::PlotKind;
use crate::runs::runs_of_equal;
use crate::watch::{Stopped, Watch};

/// Cells that are counted between two looks at the stop flag: below 50 ms of work.
const CHECK_EVERY: usize = 1 << 18;

/// Which cells lie in rooms, and the doorways between them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RoomCells {
    /// Number of rooms.
    pub count: usize,
    /// Room of each cell, row-major: 1 to `count`, larger numbers for the parts of rooms, 0 for neither. Empty without
    /// rooms.
    pub cells: Vec<u32>,
    /// What the parts of rooms are, which are no part of their room any more: stacks, aisles, open floor. The first one has
    /// the number `count + 1`.
    pub parts: Vec<PlotKind>,
    /// Lines from jamb to jamb of the doorways between two rooms, or a room and a hall; metres of the grid frame.
    pub doorways: Vec<[Point; 2]>,
}

/// The room that a face lies in, or the part of one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct FaceGround {
    /// Number of the room.
    pub room: Option<u32>,
    /// Number of the part, and what it is.
    pub part: Option<(u32, PlotKind)>,
}

impl FaceGround {
    /// Whether it is a room or a part of one.
    pub(crate) const fn is_planned(&self) -> bool {
        self.room.is_some() || self.part.is_some()
    }
}

impl RoomCells {
    /// Adds a part that has no cells yet, and gives its number.
    pub(crate) fn add_part(&mut self, kind: PlotKind) -> u32 {
        self.parts.push(kind);
        (self.count + self.parts.len()) as u32
    }

    /// The room, or part of one, that most cells of each face lie in, by face id; rooms are numbered anew by their first
    /// face. Empty without rooms.
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    pub fn of_faces(
        &self,
        face_count: usize,
        cells: &CellFaces,
        watch: &Watch<'_>,
    ) -> Result<Vec<FaceGround>, Stopped> {
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
        let ground = |number: u32| {
            if number == 0 {
                return FaceGround::default();
            }
            if let Some(part) = (number as usize).checked_sub(self.count + 1) {
                return FaceGround { room: None, part: self.parts.get(part).map(|&kind| (number, kind)) };
            }
            let room = numbers[number as usize].get_or_insert_with(|| {
                next += 1;
                next - 1
            });
            FaceGround { room: Some(*room), part: None }
        };
        Ok(room_of.into_iter().map(ground).collect())
    }
}
