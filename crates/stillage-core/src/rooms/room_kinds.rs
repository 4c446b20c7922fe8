//! What the rooms are: corridors, or plain rooms; and which one may be a hall with storage.
//!
//! Which rooms are corridors follows from their shapes ([`RoomShape`]) and their doorways. Storage is looked for in the
//! one room only that holds most of the ground of a site and is no corridor. In all other rooms thick things are
//! furniture, or rooms that were not entered:
//!
//! | development maps, on which the threshold was chosen | share of the ground in the largest room |
//! | --- | --- |
//! | halls with goods | 0.82 to 1.00 |
//! | a hall of rooms and boxes | 0.49 |
//! | an office with one large room | 0.53 |
//! | 24 of 26 maps of offices | 0.07 to 0.45 |
//! | an open-plan office | 0.70 |
//! | a basement of corridors | 0.73, a corridor |
//!
//! Cost: O(cells). Limits: goods in a small store room are taken for furniture.

use super::doorways::Doorway;
use super::ground::RoomGround;
use super::partition::Partition;
use super::room_cells::RoomCells;
use super::room_shape::RoomShape;
use crate::watch::{Stopped, Watch};

/// Least share of the ground of a site in its hall: about two thirds (see the table above; no other map was tried).
const HALL_SHARE: f64 = 0.65;

/// What the rooms of a site are.
pub(crate) struct RoomKinds {
    /// The corridors, ascending, each with its width, cells.
    pub corridors: Vec<(u32, f64)>,
    /// The room that may be a hall with storage.
    pub hall: Option<u32>,
}

/// Finds out what some rooms are.
pub(super) fn find(
    ground: &RoomGround,
    partition: &Partition,
    doorways: &[Doorway],
    rooms: &RoomCells,
    watch: &Watch<'_>,
) -> Result<RoomKinds, Stopped> {
    let shapes = RoomShape::of_rooms(ground, rooms, doorways, watch)?;
    let counts = doorways_of_rooms(ground, partition, doorways, rooms);
    let site = partition.rooms.iter().zip(&ground.is_free).filter(|&(&room, &is_free)| is_free && room != 0).count();
    let mut kinds = RoomKinds { corridors: Vec::new(), hall: None };
    for (number, shape) in (1..).zip(&shapes) {
        if shape.is_corridor(counts[number as usize]) {
            kinds.corridors.push((number, shape.width));
        } else if shape.cells as f64 > HALL_SHARE * site as f64 {
            kinds.hall = Some(number);
        }
    }
    Ok(kinds)
}

/// The number of doorways of each room, by its number.
fn doorways_of_rooms(
    ground: &RoomGround,
    partition: &Partition,
    doorways: &[Doorway],
    rooms: &RoomCells,
) -> Vec<usize> {
    // The rooms of a plan are unions of those of the partition.
    let mut numbers = vec![0; partition.count + 1];
    for (&room, &number) in partition.rooms.iter().zip(&rooms.cells) {
        numbers[room as usize] = number;
    }
    let mut counts = vec![0; rooms.count + 1];
    let sides = doorways.iter().map(|doorway| partition.sides(ground, doorway));
    for [one, other] in sides.map(|sides| sides.map(|room| numbers[room as usize] as usize)) {
        if one != other {
            counts[one] += 1;
            counts[other] += 1;
        }
    }
    counts
}
