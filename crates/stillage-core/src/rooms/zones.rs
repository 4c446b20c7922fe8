//! Zones: rooms that open widely into one another.
//!
//! Goods come in through gates, not through doors: rooms that are joined by a doorway wider than a door, or by a gap
//! between goods, are one zone. Cost: O(cells + doorways log doorways).

use super::doorways::Doorway;
use super::ground::RoomGround;
use super::partition::Partition;
use crate::geometry::DisjointSets;

/// Greatest width of a doorway that keeps two rooms in different zones, metres: doors have 0.7 to 1.6.
const DOOR_M: f64 = 1.6;

/// The zones of a floor plan.
pub(crate) struct Zones {
    /// Zone of each room: the number of its first room. Entry 0 is for cells without a room.
    pub of_room: Vec<usize>,
    /// Area of each zone with its share of the walls, by the number of its first room, square metres.
    pub areas: Vec<f64>,
}

impl Zones {
    pub(super) fn of(ground: &RoomGround, partition: &Partition, doorways: &[Doorway]) -> Self {
        let mut zones = DisjointSets::new(partition.count + 1);
        // A doorway without a wall at either end is a gap between goods, however narrow.
        let is_gate = |doorway: &&Doorway| doorway.wall_ends == 0 || doorway.width(ground.cell) > DOOR_M;
        for doorway in doorways.iter().filter(is_gate) {
            let [one, other] = partition.sides(ground, doorway).map(|room| room as usize);
            if one != 0 && other != 0 {
                zones.join(one, other);
            }
        }
        let of_room: Vec<usize> = (0..=partition.count).map(|room| zones.find(room)).collect();
        let mut areas = vec![0.0; of_room.len()];
        for &room in partition.rooms.iter().filter(|&&room| room != 0) {
            areas[of_room[room as usize]] += ground.cell * ground.cell;
        }
        Self { of_room, areas }
    }
}
