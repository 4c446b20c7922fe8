//! The plan of a whole site: rows, rooms and the stacks in them, put together.

use super::halls::Halls;
use super::storage;
use super::survey::Survey;
use crate::decomposition::Decomposition;
use crate::floor;
use crate::geometry::{Point, direction, fold_half_turn, normal};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::line::Line;
use crate::plot::{Plot, PlotKind};
use crate::rooms::{FloorPlan, RoomCells};
use crate::segmentation::RegionMap;
use crate::spec::DecompositionOptions;
use crate::watch::{Stage, Stopped, Watch};

/// The lines of a site, what they enclose, and its rooms.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SitePlan {
    /// Lines of rows, and borders of rooms; the latter belong to no region and may run in any direction.
    pub lines: Vec<Line>,
    /// The plots of rows.
    pub plots: Vec<Plot>,
    /// The rooms and their parts.
    pub rooms: RoomCells,
    /// By region: the width of the vehicles that its aisles were cut for, metres; none where no rows have places.
    pub vehicles_m: Vec<Option<f64>>,
}

/// Divides a site into rows and rooms.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn plan(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    options: &DecompositionOptions,
    watch: &Watch<'_>,
) -> Result<SitePlan, Stopped> {
    let Survey { filled, floor_plan, halls } = Survey::of(grid, regions, options, watch)?;
    let grid = filled.as_ref().unwrap_or(grid);
    watch.stage(Stage::SitePlan, || assemble(grid, regions, &floor_plan, halls, watch))
}

/// Adds the stacks that stand in rooms, and the borders of rooms and stacks.
fn assemble(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    floor_plan: &FloorPlan,
    halls: Halls,
    watch: &Watch<'_>,
) -> Result<SitePlan, Stopped> {
    let Halls { rows: Decomposition { mut lines, plots, vehicles_m, .. }, mut rooms } = halls;
    if rooms.count == 0 {
        return Ok(SitePlan { lines, plots, rooms, vehicles_m });
    }
    let main = regions.main_direction();
    let kinds = floor_plan.kinds(&rooms, watch)?;
    let stacks = floor_plan.stacks(grid, &rooms, main, watch)?;
    let storage = storage::find(grid, &rooms, &stacks, kinds.hall, watch)?;
    storage::add_stacks(&mut rooms, &stacks, &storage);
    for &(corridor, _) in &kinds.corridors {
        rooms.kinds[corridor as usize - 1] = PlotKind::Corridor;
    }
    floor_plan.cut_junctions(&mut rooms, &kinds, main, watch)?;
    for (room, bodies) in &storage {
        floor::divide(grid, &mut rooms, *room, bodies, main, watch)?;
    }
    let borders = floor_plan.borders(&rooms, watch)?;
    lines.extend(borders.into_iter().map(|ends| border_line(grid, ends)));
    Ok(SitePlan { lines, plots, rooms, vehicles_m })
}

/// A border as a line of no region, supported by the occupied cells under it.
fn border_line(grid: &OccupancyGrid, [start, end]: [Point; 2]) -> Line {
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
