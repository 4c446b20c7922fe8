//! Decomposition of a map into places: aisles first, then rows, then the places of each row.
//!
//! | step | module | what comes out |
//! | --- | --- | --- |
//! | 1 | [`ground`] | each region in cells along its first direction, and where a vehicle finds room |
//! | 2 | [`aisles`] | straight drivable bands, and the bodies between them |
//! | 3 | [`bodies`] | the direction, the depth and the layers of each body |
//! | 4 | [`rows`] | rows, cut into places where they are periodic |
//! | 5 | [`trim`] | rows, passages and aisles that end where their evidence ends: the parcels |
//! | 6 | [`lines`], [`parcel`] | the borders of the parcels as lines, and the parcels in metres |
//!
//! The paper (II-B) cuts a region by infinite lines through the peaks of its radiograms. Peaks lie on goods and racks
//! drift, so few pallet cells of such a decomposition are right. Here every line is bounded and follows from the evidence
//! beside it.
//!
//! The result does not depend on the number of threads. Cost: O(cells + cells of rows x pitches).

mod aisles;
mod bodies;
mod ground;
mod likelihood;
mod lines;
mod parcel;
mod rows;
mod trim;

#[cfg(test)]
mod tests;

use rayon::prelude::*;

use crate::grid::OccupancyGrid;
use crate::line::Line;
use crate::marks::MarkedRow;
use crate::plot::Plot;
use crate::segmentation::RegionMap;
use crate::site_ground::SiteGround;
use crate::spec::{DecompositionOptions, VehicleWidth};
use crate::watch::{Stage, Stopped, Watch};

use aisles::AisleContent;
use ground::{RegionFrame, drivable};
use rows::{Reading, RowLayout, SizeHints};

/// Widths of vehicles that are tried, metres, the usual one first: counterbalanced and reach trucks, narrow-aisle trucks, pallet jacks and carts,
/// robots that carry pods.
const VEHICLES_M: [f64; 4] = [1.7, 1.25, 1.0, 0.8];

/// Lines, and what they enclose.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Decomposition {
    /// The borders of the plots.
    pub lines: Vec<Line>,
    /// The plots, by region.
    pub plots: Vec<Plot>,
    /// By region: the width of the vehicles that its aisles were cut for, metres; none where no rows have places.
    pub vehicles_m: Vec<Option<f64>>,
    /// Whether places were cut by goods that repeat.
    pub has_repeating_goods: bool,
}

/// Decomposes a grid, region by region.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn decompose(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    options: &DecompositionOptions,
    watch: &Watch<'_>,
) -> Result<Decomposition, Stopped> {
    decompose_around(grid, regions, &[], options, watch)
}

/// The same around rows of equal marks, which are laid out as they are.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub(crate) fn decompose_around(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    marked: &[MarkedRow],
    options: &DecompositionOptions,
    watch: &Watch<'_>,
) -> Result<Decomposition, Stopped> {
    let site = SiteGround::of(grid, regions, watch)?;
    let steps = watch.steps(Stage::Rows, regions.regions.len());
    let of_region: Vec<Decomposition> = (0..regions.regions.len() as u8)
        .into_par_iter()
        .map(|region| {
            let found = decompose_region(grid, regions, (region, marked), &site, options, watch)?;
            steps.count_one();
            Ok(found)
        })
        .collect::<Result<_, _>>()?;
    let mut whole = Decomposition::default();
    for part in of_region {
        whole.lines.extend(part.lines);
        whole.plots.extend(part.plots);
        whole.has_repeating_goods |= part.has_repeating_goods;
        whole.vehicles_m.push(part.vehicles_m.into_iter().flatten().next());
    }
    Ok(whole)
}

fn decompose_region(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    (region, marked): (u8, &[MarkedRow]),
    site: &SiteGround,
    options: &DecompositionOptions,
    watch: &Watch<'_>,
) -> Result<Decomposition, Stopped> {
    let Some(&angle) = regions.regions[usize::from(region)].orientations.first() else {
        return Ok(Decomposition::default());
    };
    let mut frame = RegionFrame::new(grid, regions, region, angle, site, watch)?;
    let hints = SizeHints::of(options);
    let of_region: Vec<&MarkedRow> = marked.iter().filter(|row| row.frame.region == region).collect();
    let layout = layout(&mut frame, &of_region, &hints, options.vehicle_width_m, watch)?;
    let has_repeating_goods = layout.is_periodic;
    let parcels = trim::trimmed(&frame, layout.parcels, watch)?;
    let lines = lines::of_parcels(&frame, region, &parcels, watch)?;
    let plots = parcels.iter().map(|parcel| parcel::plot(&frame, region, parcel)).collect();
    Ok(Decomposition {
        lines,
        plots,
        vehicles_m: vec![(layout.lanes > 0).then_some(frame.vehicle_m)],
        has_repeating_goods,
    })
}

/// Lays a region out by the goods in its rows, if these repeat, or else by what divides the places, if there are such rows.
///
/// Where the width of vehicles is not given, goods are looked for along the aisles of the usual vehicle, and otherwise the
/// one of [`VEHICLES_M`] is taken for which most places can be reached between what divides them; of equals the widest.
/// Narrower vehicles find aisles everywhere, so goods are no evidence there.
fn layout(
    frame: &mut RegionFrame,
    marked: &[&MarkedRow],
    hints: &SizeHints,
    vehicle: VehicleWidth,
    watch: &Watch<'_>,
) -> Result<RowLayout, Stopped> {
    let widths_m = match vehicle {
        VehicleWidth::Auto => VEHICLES_M.to_vec(),
        VehicleWidth::Fixed(width_m) => vec![width_m],
    };
    let marked: Vec<rows::PlacedRow> = marked.iter().filter_map(|row| rows::PlacedRow::of(frame, row)).collect();
    if !marked.is_empty() {
        return rows::placed::layout(frame, &marked, &widths_m, watch);
    }
    drivable::mark(frame, widths_m[0], watch)?;
    let usual = rows::lay_out(frame, aisles::cut(frame, AisleContent::Things, watch)?, hints, Reading::Goods, watch)?;
    if usual.is_periodic {
        return Ok(usual);
    }
    let mut best = (usual, widths_m[0]);
    for width_m in widths_m {
        drivable::mark(frame, width_m, watch)?;
        for content in [AisleContent::Things, AisleContent::Nothing] {
            let layout = rows::lay_out(frame, aisles::cut(frame, content, watch)?, hints, Reading::Dividers, watch)?;
            if layout.lanes > best.0.lanes {
                best = (layout, width_m);
            }
        }
    }
    drivable::mark(frame, best.1, watch)?;
    Ok(best.0)
}
