//! The default method: directions along which the occupied cells are aligned best.
//!
//! Racks may be turned against their hall, and its walls have far more energy, so cells that are no wall are searched
//! by themselves as well, and then blocks of the map ([`blocks`]). Each direction is fitted to the points of its lines
//! ([`slope`]). Cost: that of four scans of [`super::energy`].

use std::f64::consts::PI;

use super::energy::{EnergyScan, OccupiedSample, SAMPLE_CELLS};
use super::orientations::Orientations;
use super::refine::refine;
use super::{blocks, slope};
use crate::geometry::{fold_half_turn, line_angle_between};
use crate::grid::OccupancyGrid;
use crate::spec::OrientationOptions;
use crate::walls;
use crate::watch::{Stage, Stopped, Watch};

/// Two directions count as perpendicular within this, degrees: no direction is known better before the fit.
const SQUARE_DEG: f64 = 0.3;

/// Fewest cells that are no wall and are searched by themselves: about a dozen pallets.
const LEAST_GOODS: usize = 500;

/// Finds the dominant orientations by radiogram energy.
pub(super) fn by_energy(
    grid: &OccupancyGrid,
    options: &OrientationOptions,
    watch: &Watch<'_>,
) -> Result<Orientations, Stopped> {
    let is_wall = walls::find(grid, watch)?;
    watch.progress(Stage::Orientation, 0.1);
    let all = OccupiedSample::of_parts(grid, 1, |_, _| Some(0), SAMPLE_CELLS, watch)?.swap_remove(0);
    let unless_wall = |column: usize, row: usize| (!is_wall[row * grid.width() + column]).then_some(0);
    let goods = OccupiedSample::of_parts(grid, 1, unless_wall, SAMPLE_CELLS, watch)?.swap_remove(0);
    watch.progress(Stage::Orientation, 0.2);
    let histogram = EnergyScan::new(&all, watch)?.normalized_contrasts();
    watch.progress(Stage::Orientation, 0.3);
    let separation = options.min_separation_deg.to_radians();
    let mut angles = refine(&all, &[], options, watch)?;
    watch.progress(Stage::Orientation, 0.4);
    let enough = goods.len() >= LEAST_GOODS;
    for angle in if enough { refine(&goods, &[], options, watch)? } else { Vec::new() } {
        if angles.iter().all(|&other| line_angle_between(angle, other) >= separation) {
            angles.push(angle);
        }
    }
    watch.progress(Stage::Orientation, 0.5);
    for pair in blocks::pairs(grid, if enough { &goods } else { &all }, &angles, watch)? {
        let both = [pair, pair + PI / 2.0].map(fold_half_turn);
        angles.extend(both);
    }
    watch.progress(Stage::Orientation, 0.6);
    if angles.is_empty() {
        return Ok(Orientations::default());
    }
    let is_square =
        |angle: f64| angles.iter().any(|&other| PI / 2.0 - line_angle_between(angle, other) <= SQUARE_DEG.to_radians());
    let fit = |&angle: &f64| slope::fit(&all, angle, is_square(angle), watch).map(fold_half_turn);
    let mut angles: Vec<f64> = angles.iter().map(fit).collect::<Result<_, _>>()?;
    angles.sort_by(f64::total_cmp);
    Ok(Orientations { angles, histogram, mixture: Vec::new() })
}
