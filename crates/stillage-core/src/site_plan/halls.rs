//! Which rooms are halls, and the rows in them.

use crate::decomposition::{self, Decomposition};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::marks::MarkedRow;
use crate::plot::PlotKind;
use crate::rooms::{FloorPlan, RoomCells, Zones};
use crate::segmentation::RegionMap;
use crate::spec::DecompositionOptions;
use crate::watch::{Stopped, Watch};

/// Least area of a hall beside a larger zone, square metres: two rows and their aisles.
const HALL_M2: f64 = 200.0;
/// Least share of the ground of a hall that is places; halls have 0.08 and more, a stray row of furniture less.
const PLACES_SHARE: f64 = 0.06;

/// The rows in the halls of a site, and the rooms beside them.
pub(super) struct Halls {
    pub rows: Decomposition,
    pub rooms: RoomCells,
}

impl Halls {
    /// Lays out rows in every zone that may be a hall, and again without the zones in which too few places were found,
    /// until all have enough: furniture that repeats by chance does so less when the rows of the next room are gone.
    pub(super) fn find(
        grid: &OccupancyGrid,
        regions: &RegionMap,
        floor_plan: &FloorPlan,
        marked: &[MarkedRow],
        options: &DecompositionOptions,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let zones = floor_plan.zones();
        let mut is_hall = may_be_halls(&zones);
        let mut rooms = floor_plan.rooms_beside(&is_hall);
        loop {
            let rows = if is_hall.contains(&true) {
                let grid = if rooms.count == 0 { grid } else { &without(grid, &rooms) };
                decomposition::decompose_around(grid, regions, marked, options, watch)?
            } else {
                Decomposition::default()
            };
            let holds_places = hold_places(&zones, floor_plan, &rows);
            if (1..is_hall.len()).all(|room| !is_hall[room] || holds_places[room]) {
                return Ok(Self { rows, rooms });
            }
            is_hall.iter_mut().zip(holds_places).for_each(|(is_hall, holds_places)| *is_hall &= holds_places);
            rooms = floor_plan.rooms_beside(&is_hall);
        }
    }
}

/// For every room whether its zone is large enough for a hall; entry 0, for no room, whether there are no rooms at all.
fn may_be_halls(zones: &Zones) -> Vec<bool> {
    let largest = zones.areas.iter().copied().fold(0.0, f64::max);
    let is_large = |&zone: &usize| zones.areas[zone] >= largest.min(HALL_M2);
    let of_rooms = zones.of_room.iter().skip(1).map(is_large);
    std::iter::once(zones.of_room.len() == 1).chain(of_rooms).collect()
}

/// For every room whether places lie on a good part of its zone.
fn hold_places(zones: &Zones, floor_plan: &FloorPlan, rows: &Decomposition) -> Vec<bool> {
    let mut places = vec![0.0; zones.of_room.len()];
    for plot in rows.plots.iter().filter(|plot| plot.kind == PlotKind::Place) {
        if let Some(room) = floor_plan.nearest_room(plot.bounds.center) {
            places[zones.of_room[room as usize]] += plot.bounds.area();
        }
    }
    zones.of_room.iter().map(|&zone| places[zone] > PLACES_SHARE * zones.areas[zone]).collect()
}

/// The grid with all cells of the rooms unknown.
fn without(grid: &OccupancyGrid, rooms: &RoomCells) -> OccupancyGrid {
    let cells = grid.cells().iter().zip(&rooms.cells);
    let cells = cells.map(|(&cell, &room)| if room == 0 { cell } else { Occupancy::Unknown }).collect();
    OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), cells)
}
