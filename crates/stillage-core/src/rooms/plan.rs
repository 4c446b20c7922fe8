//! Which ground is rooms and which is rows.
//!
//! The whole site is cut into rooms and, apart from that, into rows. Rooms that open widely into one another are one
//! zone: goods come in through gates, not through doors. A large zone with places on a good part of it is a hall, laid
//! out in rows as if the other zones did not exist; all others keep their rooms. So offices in the corner of a hall are
//! offices, what lies behind its gates is no floor of the hall, and a site without rows is rooms throughout.
//!
//! Cost: that of both cuts, and of the rows once more for each time that a zone turns out to have none.

use super::Rooms;
use super::bays;
use super::flood::{self, Passage};
use super::ground::Ground;
use super::outline;
use super::partition::Partition;
use super::stacks::Stacks;
use crate::decomposition::{self, Decomposition, Plot, PlotKind};
use crate::geometry::DisjointSets;
use crate::geometry::{OrientedBox, Point, direction, fold_half_turn, normal};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::radiography::Line;
use crate::segmentation::RegionMap;
use crate::spec::DecompositionOptions;
use crate::watch::{Stage, Stopped, Watch};

/// Passages wider than a door join their rooms to one zone, metres: doors have 0.7 to 1.6.
const DOOR_M: f64 = 1.6;

/// A zone smaller than this is no hall beside a larger one, square metres: two rows and their aisles.
const HALL_M2: f64 = 200.0;
/// Share of the ground of a hall that is places at least; halls have 0.08 and more, a stray row of furniture less.
const PLACES_SHARE: f64 = 0.06;

/// The lines of a site, what they enclose, and its rooms.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SitePlan {
    /// Lines of rows and borders of rooms; the latter belong to no region and run wherever they run.
    pub lines: Vec<Line>,
    /// The parcels of rows, and the stacks in rooms.
    pub plots: Vec<Plot>,
    /// The rooms.
    pub rooms: Rooms,
}

/// Cuts a site into rows and rooms.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn plan(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    options: &DecompositionOptions,
    watch: &Watch<'_>,
) -> Result<SitePlan, Stopped> {
    let (ground, cuts) = watch.stage(Stage::Rooms, || {
        let ground = Ground::of(grid, watch)?;
        watch.progress(Stage::Rooms, 0.1);
        let passages = flood::passages(&ground, watch)?;
        watch.progress(Stage::Rooms, 0.2);
        let gates = bays::gates(grid, &ground, watch)?;
        watch.progress(Stage::Rooms, 0.3);
        let partition = Partition::of(&ground, passages.iter().chain(&gates), watch)?;
        Ok((ground, Cuts { partition, passages, gates }))
    })?;
    let (rows, rooms) = watch.stage(Stage::Rows, || settle(grid, regions, &ground, &cuts, options, watch))?;
    watch.stage(Stage::SitePlan, || assemble(grid, regions, &ground, &cuts.partition, rows, rooms, watch))
}

/// Finds out which zones are halls: the rows of all that may be, again without those that turn out to have none.
fn settle(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    ground: &Ground,
    cuts: &Cuts,
    options: &DecompositionOptions,
    watch: &Watch<'_>,
) -> Result<(Decomposition, Rooms), Stopped> {
    let zones = Zones::of(ground, &cuts.partition, &cuts.passages);
    let mut is_hall = zones.may_be_halls();
    let mut rooms = cuts.rooms(ground, &is_hall);
    loop {
        let rows = if is_hall.contains(&true) {
            let grid = if rooms.count == 0 { grid } else { &without(grid, &rooms) };
            decomposition::decompose(grid, regions, options, watch)?
        } else {
            Decomposition::default()
        };
        let holds_places = zones.hold_places(ground, &cuts.partition, &rows);
        let is_settled = (1..is_hall.len()).all(|room| !is_hall[room] || holds_places[room]);
        if is_settled {
            return Ok((rows, rooms));
        }
        // Furniture that repeats by chance does so less when the rows of the next room are gone.
        is_hall.iter_mut().zip(holds_places).for_each(|(is_hall, holds_places)| *is_hall &= holds_places);
        rooms = cuts.rooms(ground, &is_hall);
    }
}

/// Puts rows and rooms together, with the stacks of goods that stand in rooms.
fn assemble(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    ground: &Ground,
    partition: &Partition,
    rows: Decomposition,
    mut rooms: Rooms,
    watch: &Watch<'_>,
) -> Result<SitePlan, Stopped> {
    let Decomposition { mut lines, mut plots } = rows;
    if rooms.count == 0 {
        return Ok(SitePlan { lines, plots, rooms });
    }
    let stands_alone = |cell: usize| ground.is_stack[cell] && rooms.cells[partition.nearest[cell] as usize] != 0;
    let stacks = Stacks::find(grid, &rooms.cells, stands_alone, main_direction(regions), watch)?;
    plots.extend(stacks.footprints.iter().map(|&bounds| plot(grid, regions, bounds)));
    for (room, stack) in rooms.cells.iter_mut().zip(stacks.cells).filter(|&(_, stack)| stack != 0) {
        *room = rooms.count as u32 + stack;
    }
    let borders = outline::segments(&rooms.cells, ground.width, ground.cell);
    lines.extend(borders.into_iter().map(|ends| line(grid, ends)));
    Ok(SitePlan { lines, plots, rooms })
}

/// The first direction of the largest region, radians.
fn main_direction(regions: &RegionMap) -> f64 {
    let largest = regions.regions.iter().max_by(|one, other| one.share.total_cmp(&other.share));
    largest.and_then(|region| region.orientations.first().copied()).unwrap_or(0.0)
}

/// The ground of a stack: one place, or a block of them.
fn plot(grid: &OccupancyGrid, regions: &RegionMap, bounds: OrientedBox) -> Plot {
    let region = grid.cell_at(bounds.center).and_then(|(column, row)| regions.region_of_cell(column, row));
    Plot { bounds, kind: PlotKind::Place, region: region.unwrap_or(RegionMap::NONE) }
}

/// The rooms on both sides of the middle of a passage, 0 where there is none.
fn sides(ground: &Ground, partition: &Partition, passage: &Passage) -> [u32; 2] {
    let [from, to] = passage.ends.map(|end| end.map(|place| place as f64));
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]).max(1.0);
    let middle = [f64::midpoint(from[0], to[0]), f64::midpoint(from[1], to[1])];
    // Beyond the passage's own cells, which went to either room.
    let step = ground.cells_of(DOOR_M / 8.0) as f64 + 1.0;
    [1.0, -1.0].map(|side| {
        let column = (middle[0] - side * step * along[1] / length).round() as i64;
        let row = (middle[1] + side * step * along[0] / length).round() as i64;
        if ground.holds(column, row) { partition.rooms[row as usize * ground.width + column as usize] } else { 0 }
    })
}

/// Rooms that open widely into one another.
struct Zones {
    /// Zone of each room by its smallest room; entry 0 is for no room.
    of: Vec<usize>,
    /// Ground of each zone, with its share of the walls, square metres.
    areas: Vec<f64>,
}

impl Zones {
    fn of(ground: &Ground, partition: &Partition, passages: &[Passage]) -> Self {
        let mut of: Vec<usize> = (0..=partition.count).collect();
        // A neck without a wall at either end is a gap between goods, however narrow.
        let is_gate = |passage: &&Passage| passage.wall_ends == 0 || passage.width(ground.cell) > DOOR_M;
        for passage in passages.iter().filter(is_gate) {
            let [one, other] = sides(ground, partition, passage).map(|room| of[room as usize]);
            if one != 0 && other != 0 {
                of.iter_mut().filter(|zone| **zone == one.max(other)).for_each(|zone| *zone = one.min(other));
            }
        }
        let mut areas = vec![0.0; of.len()];
        for &room in partition.rooms.iter().filter(|&&room| room != 0) {
            areas[of[room as usize]] += ground.cell * ground.cell;
        }
        Self { of, areas }
    }

    /// For every room whether its zone is large enough for a hall; entry 0, for no room, whether there are none.
    fn may_be_halls(&self) -> Vec<bool> {
        let largest = self.areas.iter().copied().fold(0.0, f64::max);
        let is_large = |&zone: &usize| self.areas[zone] >= largest.min(HALL_M2);
        let of_rooms = self.of.iter().skip(1).map(is_large);
        std::iter::once(self.of.len() == 1).chain(of_rooms).collect()
    }

    /// For every room whether places lie on a good part of its zone.
    fn hold_places(&self, ground: &Ground, partition: &Partition, rows: &Decomposition) -> Vec<bool> {
        let mut places = vec![0.0; self.of.len()];
        for plot in rows.plots.iter().filter(|plot| plot.kind == PlotKind::Place) {
            let [column, row] = [plot.bounds.center.x, plot.bounds.center.y].map(|side| (side / ground.cell) as usize);
            if column < ground.width && row < ground.height {
                let room = partition.nearest_room(row * ground.width + column) as usize;
                let [along, across] = plot.bounds.half_extents;
                places[self.of[room]] += 4.0 * along * across;
            }
        }
        self.of.iter().map(|&zone| places[zone] > PLACES_SHARE * self.areas[zone]).collect()
    }
}

/// A site cut at its passages and gates.
struct Cuts {
    partition: Partition,
    passages: Vec<Passage>,
    /// Those between a hall and the bays behind it.
    gates: Vec<Passage>,
}

impl Cuts {
    /// The rooms that are no part of a hall, and the passages that lead into them.
    fn rooms(&self, ground: &Ground, is_hall: &[bool]) -> Rooms {
        let Self { partition, passages, gates } = self;
        // Only what is behind the gate of a hall is a room by itself.
        let mut same = DisjointSets::new(is_hall.len());
        for gate in gates {
            let [one, other] = sides(ground, partition, gate).map(|room| room as usize);
            if one != 0 && other != 0 && !is_hall[one] && !is_hall[other] {
                same.join(one, other);
            }
        }
        let mut count = 0;
        let mut numbers = vec![0; is_hall.len()];
        for room in (1..is_hall.len()).filter(|&room| !is_hall[room]) {
            let first = same.find(room);
            if numbers[first] == 0 {
                count += 1;
                numbers[first] = count;
            }
            numbers[room] = numbers[first];
        }
        if count == 0 {
            return Rooms::default();
        }
        let leads_into_room = |passage: &&Passage| {
            let [one, other] = sides(ground, partition, passage).map(|room| numbers[room as usize]);
            one != other
        };
        let point = |[column, row]: [i64; 2]| Point::new(column as f64 + 0.5, row as f64 + 0.5) * ground.cell;
        let openings = passages.iter().chain(gates).filter(leads_into_room);
        Rooms {
            count: count as usize,
            cells: partition.rooms.iter().map(|&room| numbers[room as usize]).collect(),
            passages: openings.map(|passage| passage.ends.map(point)).collect(),
        }
    }
}

/// A grid on which nobody has seen the rooms.
fn without(grid: &OccupancyGrid, rooms: &Rooms) -> OccupancyGrid {
    let cells = grid.cells().iter().zip(&rooms.cells);
    let cells = cells.map(|(&cell, &room)| if room == 0 { cell } else { Occupancy::Unknown }).collect();
    OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), cells)
}

/// A border as a line of no region.
fn line(grid: &OccupancyGrid, [start, end]: [Point; 2]) -> Line {
    let orientation = fold_half_turn((end.y - start.y).atan2(end.x - start.x));
    let along = direction(orientation);
    let mut extent = [along.dot(&start.coords), along.dot(&end.coords)];
    extent.sort_by(f64::total_cmp);
    let length = extent[1] - extent[0];
    let steps = (length / grid.resolution()).ceil().max(1.0) as usize;
    let is_occupied = |step: &usize| {
        let place = start + (end - start) * ((*step as f64 + 0.5) / steps as f64);
        grid.cell_at(place).is_some_and(|(column, row)| grid.row(row)[column] == Occupancy::Occupied)
    };
    Line {
        region: RegionMap::NONE,
        orientation,
        offset: normal(orientation).dot(&start.coords),
        support: length * (0..steps).filter(is_occupied).count() as f64 / steps as f64,
        extents: vec![extent],
    }
}
