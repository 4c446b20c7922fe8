//! The rooms and doors of a subdivision.

use serde::{Deserialize, Serialize};

use super::doors::{self, Door};
use super::room_cells::RoomCells;
use crate::arrangement::{CellFaces, FaceId, Subdivision};
use crate::watch::{Stopped, Watch};

/// The rooms and doors of a subdivision.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RoomMap {
    /// Room of each face, by face id (entry 0, the unbounded face, has none). Empty without rooms.
    pub faces: Vec<Option<u32>>,
    /// Narrow doorways between two rooms, or between a room and other ground.
    pub doors: Vec<Door>,
}

impl RoomMap {
    /// Finds the faces of each room and the edges of each door; `cells` are those of the subdivision.
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    pub fn of(
        rooms: &RoomCells,
        subdivision: &Subdivision,
        cells: &CellFaces,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let faces = rooms.of_faces(subdivision.face_count(), cells, watch)?;
        let doors = doors::find(&rooms.doorways, subdivision, &faces);
        Ok(Self { faces, doors })
    }

    /// Room of a face.
    #[must_use]
    pub fn room(&self, face: FaceId) -> Option<u32> {
        self.faces.get(face.index()).copied().flatten()
    }
}
