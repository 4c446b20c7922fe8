//! Plots: what the ground of a site is planned to be, before it is cut into faces.

use serde::{Deserialize, Serialize};

use crate::geometry::OrientedBox;

/// What a piece of ground was cut out for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlotKind {
    /// One place for goods.
    Place,
    /// A drivable band with places along it.
    Aisle,
    /// Open floor: cross aisles, and floor beside and around rows.
    OpenFloor,
    /// A passage through a row.
    Passage,
    /// A room beside the hall, or a bay behind one of its gates.
    Room,
    /// Anything else.
    Other,
    /// A long and narrow room with doors along it.
    Corridor,
    /// Where corridors meet.
    Junction,
}

/// A rectangle of the ground and what it was cut out for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plot {
    /// Where it lies; its first side runs along the rows.
    pub bounds: OrientedBox,
    /// What it was cut out for.
    pub kind: PlotKind,
    /// Region it belongs to.
    pub region: u8,
}
