//! Names of what has no code: places, aisles and rows.

use serde::{Deserialize, Serialize};

use crate::geometry::{Bounds, Point};

/// What an area is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AreaKind {
    /// A room, or mutually open faces of one label.
    Place,
    /// An aisle.
    Aisle,
    /// A row of locations.
    Row,
}

/// Ground that people gave a name or put in groups.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NamedArea {
    /// What it is.
    pub kind: AreaKind,
    /// Its name.
    pub name: Option<String>,
    /// Its groups.
    pub groups: Vec<String>,
    /// Its outlines (counter-clockwise) and holes (clockwise) when it was named, in the frame of the site, metres.
    pub rings: Vec<Vec<Point>>,
}

impl NamedArea {
    /// The box around it.
    pub(super) fn bounds(&self) -> Bounds {
        Bounds::around(self.rings.iter().flatten())
    }
}
