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
    /// What the rooms are: corridors, or rooms. The first one has the number 1.
    pub kinds: Vec<PlotKind>,
    /// What the parts of rooms are. The first one has the number `count + 1`.
    pub parts: Vec<Part>,
    /// Lines from jamb to jamb of the doors between two rooms, or a room and a hall, and of the gates of bays; metres of
    /// the grid frame.
    pub doorways: Vec<[Point; 2]>,
}

/// What is cut out of a room.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// What it is.
    pub kind: PlotKind,
    /// The room that it still belongs to, from 1: junctions do; stacks, aisles and open floor do not.
    pub room: Option<u32>,
}

/// The room that a face lies in, or the part of one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct FaceGround {
    /// Number of the room.
    pub room: Option<u32>,
    /// Number of the room or part among both, and what it is.
    pub area: Option<(u32, PlotKind)>,
}

impl FaceGround {
    /// Whether it is a room or a part of one.
    pub(crate) const fn is_planned(&self) -> bool {
        self.area.is_some()
    }
}

impl RoomCells {
    /// Adds a part that has no cells yet and belongs to no room any more, and gives its number.
    pub(crate) fn add_part(&mut self, kind: PlotKind) -> u32 {
        self.push(Part { kind, room: None })
    }

    /// Adds a part of a room, from 1, that has no cells yet, and gives its number.
    pub(super) fn add_part_of(&mut self, room: u32, kind: PlotKind) -> u32 {
        self.push(Part { kind, room: Some(room) })
    }

    fn push(&mut self, part: Part) -> u32 {
        self.parts.push(part);
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
        for start in (0..cells.len()).step_by(CHECK_EVERY) {
            watch.check()?;
            for (face, run) in cells.runs(start..(start + CHECK_EVERY).min(cells.len())) {
                let rooms = &self.cells[run];
                for run in runs_of_equal(rooms) {
                    *counts.entry((face, rooms[run.start])).or_default() += run.len();
                }
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
        let mut renumbered = |room: u32| {
            *numbers[room as usize].get_or_insert_with(|| {
                next += 1;
                next - 1
            })
        };
        let ground = |number: u32| {
            let Some(index) = (number as usize).checked_sub(1) else { return FaceGround::default() };
            let (room, kind) = match index.checked_sub(self.count) {
                Some(part) => (self.parts[part].room, self.parts[part].kind),
                None => (Some(number), self.kinds[index]),
            };
            FaceGround { room: room.map(&mut renumbered), area: Some((number, kind)) }
        };
        Ok(room_of.into_iter().map(ground).collect())
    }
}
