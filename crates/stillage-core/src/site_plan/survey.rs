//! The rooms of a site and the rows in its halls, read by goods, dividers and marks.
//!
//! Rows are laid out by what stands in them and between them ([`crate::decomposition`]). Where equal marks tell more
//! ([`crate::marks`]), the site is surveyed again with the ground of these rows solid:
//!
//! | what repeats | what is taken |
//! | --- | --- |
//! | marks, and no goods | the rows of marks |
//! | marks and goods | the rows of marks, if most marks stand in rows and are no legs of pallets |
//! | neither, but racks of few bays side by side in the hall | these racks, whole |
//!
//! Cost: that of two surveys at most.

use super::halls::Halls;
use crate::decomposition::Decomposition;
use crate::grid::OccupancyGrid;
use crate::marks::{self, MarkedRow, MarkedRows};
use crate::plot::PlotKind;
use crate::rooms::FloorPlan;
use crate::segmentation::RegionMap;
use crate::spec::DecompositionOptions;
use crate::watch::{Stage, Stopped, Watch};

/// Where goods repeat, least share of the marks that stand in rows.
const EXPLAINED_BESIDE_GOODS: f64 = 0.75;
/// Most places of rows of marks for each place of goods, where these marks may be legs of pallets: in scans they give two to
/// five places for each pallet (64 generated sites).
const PLACES_OF_LEGS: f64 = 1.6;
/// Legs, blocks and stringers of pallets are nearer to each other than this, metres, and scans show them unequal: fewer than
/// this share of their marks stand in rows.
const LEGS_M: f64 = 0.9;
const EXPLAINED_LEGS: f64 = 0.9;

/// The rooms of a site, and the rows in its halls.
pub(super) struct Survey {
    /// The grid with the rows of marks that are known as solid as they are to a vehicle; `None` without such rows.
    pub filled: Option<OccupancyGrid>,
    pub floor_plan: FloorPlan,
    pub halls: Halls,
}

impl Survey {
    pub(super) fn of(
        grid: &OccupancyGrid,
        regions: &RegionMap,
        options: &DecompositionOptions,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let floor_plan = watch.stage(Stage::Rooms, || FloorPlan::of(grid, regions.main_direction(), watch))?;
        let (marked, halls) = watch.stage(Stage::Rows, || {
            let marked = MarkedRows::find(grid, regions, watch)?;
            Ok((marked, Halls::find(grid, regions, &floor_plan, &[], options, watch)?))
        })?;
        let is_better = explain_more(&marked, &halls);
        let whole =
            if is_better { marked.rows } else { racks_in_hall(grid, marked.blocks, &floor_plan, &halls, watch)? };
        if whole.is_empty() {
            return Ok(Self { filled: None, floor_plan, halls });
        }
        let filled = marks::filled(grid, &whole);
        let watch = watch.silent();
        let floor_plan = FloorPlan::of(&filled, regions.main_direction(), &watch)?;
        let halls = if is_better {
            Halls::find(&filled, regions, &floor_plan, &whole, options, &watch)?
        } else {
            // Whole racks are no rows of goods, however equal they are.
            Halls { rows: Decomposition::default(), rooms: floor_plan.all_rooms() }
        };
        Ok(Self { filled: Some(filled), floor_plan, halls })
    }
}

/// Whether the rows of marks tell more than the goods.
fn explain_more(marked: &MarkedRows, halls: &Halls) -> bool {
    let places = marked.place_count() as f64;
    if !halls.rows.has_repeating_goods || marked.rows.is_empty() {
        return !marked.rows.is_empty();
    }
    let of_goods = halls.rows.plots.iter().filter(|plot| plot.kind == PlotKind::Place).count() as f64;
    let may_be_legs = marked.usual_pitch() < LEGS_M && marked.explained < EXPLAINED_LEGS;
    marked.explained >= EXPLAINED_BESIDE_GOODS && (!may_be_legs || places <= PLACES_OF_LEGS * of_goods)
}

/// The racks of few bays that stand in the hall, where no rows are laid out there.
fn racks_in_hall(
    grid: &OccupancyGrid,
    mut racks: Vec<MarkedRow>,
    floor_plan: &FloorPlan,
    halls: &Halls,
    watch: &Watch<'_>,
) -> Result<Vec<MarkedRow>, Stopped> {
    if racks.is_empty() || halls.rows.plots.iter().any(|plot| plot.kind == PlotKind::Place) {
        return Ok(Vec::new());
    }
    let rooms = floor_plan.all_rooms();
    let hall = floor_plan.kinds(&rooms, watch)?.hall;
    racks.retain(|rack| {
        let cell = grid.cell_at(rack.bounds().center).map(|(column, row)| row * grid.width() + column);
        hall.is_some() && cell.map(|cell| rooms.cells[cell]) == hall
    });
    Ok(racks)
}
