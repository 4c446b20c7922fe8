//! Rooms: the ground that walls divide, with the doors between them.
//!
//! ```text
//! grid ─ ground ─ passages ─┬─ doorways ─┬─ partition ─ floor_plan ─┬─ room_cells ─ room_map (with doors)
//!                           └─ gates ────┘              └─ zones    └─ stacks, borders
//! ```
//!
//! | module | what comes out |
//! | --- | --- |
//! | [`ground`] | free cells, and small obstacles that stand on them alone |
//! | [`passages`] | straight strips between two walls, and where they are open |
//! | [`doorways`], [`gates`] | lines across the ground where it parts two rooms, or a bay and its hall |
//! | [`partition`] | the room of every cell when all of them are closed |
//! | [`floor_plan`] | all of it together: rooms, zones, stacks and borders on request |
//! | [`zones`] | rooms that open widely into one another |
//! | [`room_kinds`], [`room_shape`], [`junctions`] | which rooms are corridors, and where these meet; which room may be a hall |
//! | [`stacks`] | goods that stand in rooms |
//! | [`borders`] | the borders of rooms and stacks as straight segments |
//! | [`room_cells`], [`room_map`], [`doors`] | the room of every cell; the room of every face, and the edges of every door |
//!
//! The borders are lines of the subdivision, so every room is a union of faces. Which rooms are halls is
//! given by the caller. Cost: O(cells log cells).

mod borders;
mod doors;
mod doorways;
mod floor_plan;
mod gates;
mod ground;
mod junctions;
mod partition;
mod passages;
mod room_cells;
mod room_kinds;
mod room_map;
mod room_shape;
mod stacks;
mod zones;

pub use doors::Door;
pub use room_cells::{FaceGround, Part, RoomCells};
pub use room_map::RoomMap;

pub(crate) use floor_plan::FloorPlan;
pub(crate) use stacks::Stacks;
pub(crate) use zones::Zones;
