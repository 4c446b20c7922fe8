//! Rows in the bodies between aisles, and their places.
//!
//! | step | module |
//! | --- | --- |
//! | rows of the layers of each body | [`body_rows`], [`rack_row`] |
//! | rows that show what divides their places | [`dividers`], [`divider_lattice`] |
//! | evidence for borders between places, along each row | [`evidence`] |
//! | layers that share their storage lanes are one row | [`storage_lanes`] |
//! | pitch and load template that all rows of a direction have in common, and those of single rows | [`row_set`], [`row_model`], [`load_template`] |
//! | whether the rows are periodic at all | [`periodicity`] |
//! | the best borders of a row | [`comb`] |
//! | the pieces between these borders | [`pieces`] |
//! | rows whose places are known before: those of equal marks | [`placed`] |
//!
//! Rows that are not periodic are walls, shelves or furniture and are not cut into places. Cost: O(cells x pitches).

mod body_rows;
mod comb;
mod direction;
mod divider_lattice;
mod dividers;
mod evidence;
mod load_template;
mod periodicity;
mod pieces;
pub(crate) mod placed;
mod rack_row;
mod reading;
mod row_layout;
mod row_model;
mod row_set;
mod size_hints;
mod storage_lanes;

use crate::decomposition::aisles::AisleCut;
use crate::decomposition::bodies::{Body, depth};
use crate::decomposition::ground::{Axis, RegionFrame};
use crate::plot::PlotKind;
use crate::watch::{Stopped, Watch};

use direction::DirectionRows;

pub(crate) use placed::PlacedRow;
pub(crate) use reading::Reading;
pub(crate) use row_layout::RowLayout;
pub(crate) use size_hints::SizeHints;

/// Lays the bands and bodies of a region out as parcels.
pub(crate) fn lay_out(
    frame: &RegionFrame,
    cut: AisleCut,
    hints: &SizeHints,
    reading: Reading,
    watch: &Watch<'_>,
) -> Result<RowLayout, Stopped> {
    let mut bodies = Vec::with_capacity(cut.bodies.len());
    for area in &cut.bodies {
        watch.check()?;
        bodies.push(Body::of(frame, area));
    }
    let depth = depth::usual(frame, &bodies, hints.depth);
    let [along, across] = Axis::BOTH.map(|axis| DirectionRows::of(frame, &bodies, axis, depth, hints, reading, watch));
    let mut directions = [along?, across?];
    if !directions.iter().any(DirectionRows::is_periodic) {
        for direction in &mut directions {
            direction.judge_each_alone()?;
        }
    }
    let is_periodic = directions.iter().any(DirectionRows::has_repeating_goods);
    let is_storage = directions.iter().any(DirectionRows::is_storage);
    let mut parcels = cut.bands;
    for direction in directions {
        parcels = direction.lay_out(parcels, is_storage)?;
    }
    let lanes = parcels.iter().filter(|parcel| parcel.kind == PlotKind::Place).count();
    Ok(RowLayout { parcels, is_periodic, lanes })
}
