//! Which ground is rooms and which is rows.
//!
//! The whole site is cut into rows and, apart from that, into rooms. Rooms that open widely into one another are one
//! zone; a zone with rows of places is a hall, laid out in rows as if the other zones did not exist. All other zones keep
//! their rooms. So offices in the corner of a hall are offices, and a site without any rows is rooms throughout.
//!
//! Cost: that of both cuts, and of the rows once more where a site has both.

use super::Rooms;
use super::flood::{self, Passage};
use super::ground::Ground;
use super::nearest::Nearest;
use super::outline;
use super::partition::Partition;
use crate::decomposition::{self, Decomposition, PlotKind};
use crate::geometry::{Point, fold_half_turn, normal, direction};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::radiography::Line;
use crate::segmentation::RegionMap;
use crate::spec::DecompositionOptions;
use crate::watch::{Stopped, Watch};

/// Passages wider than this join their rooms to one zone, metres: a door has 0.7 to 1.6.
const DOOR_M: f64 = 1.6;

/// The lines of a site, what they enclose, and its rooms.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SitePlan {
    /// Lines of rows and borders of rooms; the latter belong to no region and run wherever they run.
    pub lines: Vec<Line>,
    /// The parcels of rows.
    pub plots: Vec<decomposition::Plot>,
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
    let mut rows = decomposition::decompose(grid, regions, options, watch)?;
    let ground = Ground::of(grid, watch)?;
    let clearance = Nearest::of(ground.width, ground.is_free.len(), |cell| !ground.is_free[cell], watch)?;
    let passages = flood::passages(&ground, &clearance, watch)?;
    let partition = Partition::of(&ground, &passages, watch)?;
    let is_hall = halls(grid, &ground, &rows, &partition, &passages);
    let rooms = kept(&ground, &partition, &passages, &is_hall);
    if rooms.count == 0 {
        return Ok(SitePlan { lines: rows.lines, plots: rows.plots, rooms: Rooms::default() });
    }
    if is_hall.contains(&true) {
        rows = decomposition::decompose(&without(grid, &rooms), regions, options, watch)?;
    } else {
        rows = Decomposition::default();
    }
    let borders = outline::segments(&rooms.cells, ground.width, ground.cell);
    let Decomposition { mut lines, plots } = rows;
    lines.extend(borders.into_iter().map(|ends| line(grid, ends)));
    Ok(SitePlan { lines, plots, rooms })
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

/// For every room, 1 to `count` (entry 0 is for none), whether it belongs to a zone with rows of places.
fn halls(
    grid: &OccupancyGrid,
    ground: &Ground,
    rows: &Decomposition,
    partition: &Partition,
    passages: &[Passage],
) -> Vec<bool> {
    let mut is_hall = vec![false; partition.count + 1];
    for plot in rows.plots.iter().filter(|plot| plot.kind == PlotKind::Place) {
        if let Some((column, row)) = grid.cell_at(plot.bounds.center) {
            is_hall[partition.nearest_room(row * ground.width + column) as usize] = true;
        }
    }
    let is_gate = |passage: &&Passage| passage.wall_ends == 0 || passage.width(ground.cell) > DOOR_M;
    let gates: Vec<[u32; 2]> = passages.iter().filter(is_gate).map(|passage| sides(ground, partition, passage)).collect();
    let mut before = 0;
    loop {
        for sides in &gates {
            if sides.iter().any(|&room| room != 0 && is_hall[room as usize]) {
                sides.iter().for_each(|&room| is_hall[room as usize] = true);
            }
        }
        let now = is_hall.iter().filter(|&&is_hall| is_hall).count();
        if now == before {
            return is_hall;
        }
        before = now;
    }
}

/// The rooms that are no part of a hall, and the passages that lead into them.
fn kept(ground: &Ground, partition: &Partition, passages: &[Passage], is_hall: &[bool]) -> Rooms {
    let mut count = 0;
    let numbers: Vec<u32> = (0..=partition.count)
        .map(|room| {
            if room == 0 || is_hall[room] {
                return 0;
            }
            count += 1;
            count
        })
        .collect();
    if count == 0 {
        return Rooms::default();
    }
    let leads_into_room = |passage: &&Passage| {
        let [one, other] = sides(ground, partition, passage).map(|room| numbers[room as usize]);
        one != other
    };
    let point = |[column, row]: [i64; 2]| Point::new(column as f64 + 0.5, row as f64 + 0.5) * ground.cell;
    Rooms {
        count: count as usize,
        cells: partition.rooms.iter().map(|&room| numbers[room as usize]).collect(),
        passages: passages.iter().filter(leads_into_room).map(|passage| passage.ends.map(point)).collect(),
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
