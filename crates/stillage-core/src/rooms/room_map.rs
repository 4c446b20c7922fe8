//! The rooms and doors of a subdivision.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::doors::{self, Door};
use super::room_cells::{FaceGround, RoomCells};
use crate::arrangement::{EdgeId, FaceId, Subdivision};
use crate::geometry::Point;

/// The rooms and doors of a subdivision.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RoomMap {
    /// Room of each face, by face id (entry 0, the unbounded face, has none). Empty without rooms.
    pub faces: Vec<Option<u32>>,
    /// Narrow doorways between two rooms, or between a room and other ground.
    pub doors: Vec<Door>,
    /// Edges that people said vehicles may pass (true) or may not (false), whatever the labels say. Corrections say so;
    /// they are kept beside an analysis, never in it.
    #[serde(skip)]
    pub passages: BTreeMap<EdgeId, bool>,
}

impl RoomMap {
    /// Finds the edges of each door; `grounds` are the rooms of the faces of the subdivision.
    #[must_use]
    pub fn of(rooms: &RoomCells, subdivision: &Subdivision, grounds: &[FaceGround]) -> Self {
        let faces: Vec<Option<u32>> = grounds.iter().map(|ground| ground.room).collect();
        let doors = doors::find(&rooms.doorways, subdivision, &faces);
        Self { faces, doors, passages: BTreeMap::new() }
    }

    /// The same doors in a redrawn subdivision with rooms by face id.
    pub(crate) fn redrawn(&self, subdivision: &Subdivision, faces: Vec<Option<u32>>) -> Self {
        let doorways: Vec<[Point; 2]> = self.doors.iter().map(|door| door.ends).collect();
        let doors = doors::find(&doorways, subdivision, &faces);
        Self { faces, doors, passages: BTreeMap::new() }
    }

    /// Room of a face.
    #[must_use]
    pub fn room(&self, face: FaceId) -> Option<u32> {
        self.faces.get(face.index()).copied().flatten()
    }
}
