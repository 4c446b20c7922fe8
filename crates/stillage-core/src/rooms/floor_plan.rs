//! The floor plan: a whole site divided into rooms, before it is known which of them are halls.

use super::borders;
use super::doorways::{self, Doorway};
use super::gates;
use super::ground::RoomGround;
use super::junctions;
use super::partition::Partition;
use super::passages::RoomPassages;
use super::room_cells::RoomCells;
use super::room_kinds::{self, RoomKinds};
use super::stacks::Stacks;
use super::zones::Zones;
use crate::geometry::{DisjointSets, Point};
use crate::grid::OccupancyGrid;
use crate::plot::PlotKind;
use crate::watch::{Stage, Stopped, Watch};

/// A site divided at its doorways and at the gates of its bays.
pub(crate) struct FloorPlan {
    ground: RoomGround,
    partition: Partition,
    doorways: Vec<Doorway>,
    /// The doorways between a hall and its bays.
    gates: Vec<Doorway>,
}

impl FloorPlan {
    /// Divides a site into rooms; `angle` is a direction of the site, radians. Reports its progress as that of
    /// [`Stage::Rooms`].
    pub(crate) fn of(grid: &OccupancyGrid, angle: f64, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let mut ground = RoomGround::of(grid, watch)?;
        let passages = RoomPassages::of(&ground, angle, watch)?;
        ground.clear_furniture(&passages.walls, watch)?;
        watch.progress(Stage::Rooms, 0.1);
        let mut doorways = doorways::find(&passages.closed(&ground), watch)?;
        doorways.retain(|doorway| !passages.are_crossed_by(&ground, doorway));
        watch.progress(Stage::Rooms, 0.2);
        let gates = gates::find(grid, &ground, watch)?;
        watch.progress(Stage::Rooms, 0.3);
        let jambs = doorways.iter().chain(&gates).map(|doorway| doorway.ends);
        let mut partition = Partition::of(&ground, jambs.chain(passages.closings()), watch)?;
        doorways.extend(passages.join_arms(&ground, &doorways, &mut partition));
        Ok(Self { ground, partition, doorways, gates })
    }

    /// The rooms that open widely into one another.
    pub(crate) fn zones(&self) -> Zones {
        Zones::of(&self.ground, &self.partition, &self.doorways)
    }

    /// The room whose ground is nearest to a point of the grid, however far, 0 without rooms; `None` beyond the grid.
    pub(crate) fn nearest_room(&self, point: Point) -> Option<u32> {
        let [column, row] = [point.x, point.y].map(|side| (side / self.ground.cell) as usize);
        let is_inside = column < self.ground.width && row < self.ground.height;
        is_inside.then(|| self.partition.nearest_room(row * self.ground.width + column))
    }

    /// All rooms of a site without a hall.
    pub(crate) fn all_rooms(&self) -> RoomCells {
        self.rooms_beside(&vec![false; self.partition.count + 1])
    }

    /// The rooms that are no part of a hall, and the doors and gates that lead into them; `is_hall` is indexed by room, entry
    /// 0 is not read. Only a gate to a hall parts rooms: a bay whose gate leads to another room is part of it.
    pub(crate) fn rooms_beside(&self, is_hall: &[bool]) -> RoomCells {
        let Self { ground, partition, doorways, gates } = self;
        let mut joined = DisjointSets::new(is_hall.len());
        for gate in gates {
            let [one, other] = partition.sides(ground, gate).map(|room| room as usize);
            if one != 0 && other != 0 && !is_hall[one] && !is_hall[other] {
                joined.join(one, other);
            }
        }
        let mut count = 0;
        let mut numbers = vec![0; is_hall.len()];
        for room in (1..is_hall.len()).filter(|&room| !is_hall[room]) {
            let first = joined.find(room);
            if numbers[first] == 0 {
                count += 1;
                numbers[first] = count;
            }
            numbers[room] = numbers[first];
        }
        if count == 0 {
            return RoomCells::default();
        }
        let leads_into_room = |doorway: &&Doorway| {
            let [one, other] = partition.sides(ground, doorway).map(|room| numbers[room as usize]);
            one != other
        };
        let doors = doorways.iter().filter(|doorway| doorway.is_door(ground.cell));
        let openings = doors.chain(gates).filter(leads_into_room);
        RoomCells {
            count: count as usize,
            cells: partition.rooms.iter().map(|&room| numbers[room as usize]).collect(),
            kinds: vec![PlotKind::Room; count as usize],
            parts: Vec::new(),
            doorways: openings.map(|doorway| doorway.ends.map(|cell| ground.middle_of(cell))).collect(),
        }
    }

    /// Which of some rooms are corridors, and which one may be a hall with storage.
    pub(crate) fn kinds(&self, rooms: &RoomCells, watch: &Watch<'_>) -> Result<RoomKinds, Stopped> {
        let doorways: Vec<Doorway> = self.doorways.iter().chain(&self.gates).copied().collect();
        room_kinds::find(&self.ground, &self.partition, &doorways, rooms, watch)
    }

    /// Cuts the junctions out of the corridors; `angle` is a direction of the site, radians.
    pub(crate) fn cut_junctions(
        &self,
        rooms: &mut RoomCells,
        kinds: &RoomKinds,
        angle: f64,
        watch: &Watch<'_>,
    ) -> Result<(), Stopped> {
        for &(corridor, width) in &kinds.corridors {
            junctions::cut_out(&self.ground, &self.partition, rooms, corridor, width, angle, watch)?;
        }
        Ok(())
    }

    /// The stacks that stand in some rooms; `angle` is a direction of the site, radians.
    pub(crate) fn stacks(
        &self,
        grid: &OccupancyGrid,
        rooms: &RoomCells,
        angle: f64,
        watch: &Watch<'_>,
    ) -> Result<Stacks, Stopped> {
        let Self { ground, partition, .. } = self;
        let stands_alone = |cell: usize| ground.is_stack[cell] && rooms.cells[partition.nearest[cell] as usize] != 0;
        Stacks::find(grid, &rooms.cells, stands_alone, angle, watch)
    }

    /// The borders of rooms, and of the stacks in them, as straight segments, metres of the grid frame.
    pub(crate) fn borders(&self, rooms: &RoomCells, watch: &Watch<'_>) -> Result<Vec<[Point; 2]>, Stopped> {
        borders::segments(&rooms.cells, self.ground.width, self.ground.cell, watch)
    }
}
