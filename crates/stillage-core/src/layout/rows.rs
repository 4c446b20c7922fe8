//! The course of aisles, and the rows along them.
//!
//! Method: an aisle runs in the middle between the fronts on its two sides; with one side only, between those and where
//! the drivable ground ends. A row is cut where a vehicle could drive through. Cost: O(n) for n locations, and a walk over
//! the ground for each front of aisles with one side. Limits: the width is that between the fronts, goods may stand in it.

use super::aisle::{Aisle, Row};
use super::aisles::{AisleFront, FrontLine};
use super::draft::Draft;
use super::location::Side;
use crate::geometry::{Point, Vector, direction, normal};
use crate::grid::Occupancy;
use crate::site_map::SiteMap;

/// Greatest width looked for on the open side of an aisle, metres: a hall without a wall in sight is no aisle.
const WIDEST_M: f64 = 6.0;

/// Where an aisle runs, without its locations.
pub(super) fn course(map: &SiteMap<'_>, number: u32, line: &FrontLine, drafts: &[Draft]) -> Aisle {
    let offset = |front: &AisleFront| normal(line.angle).dot(&front.middle.coords);
    let mean = |side: Side| {
        let fronts = line.side(side);
        (!fronts.is_empty()).then(|| fronts.iter().map(offset).sum::<f64>() / fronts.len() as f64)
    };
    let (right, left) = match (mean(Side::Right), mean(Side::Left)) {
        (Some(right), Some(left)) => (right, left),
        (Some(right), None) => (right, right + open_width(map, line)),
        (None, Some(left)) => (left - open_width(map, line), left),
        (None, None) => (0.0, 0.0),
    };
    let half = |front: &AisleFront| drafts[front.location].width / 2.0;
    let ends = line.fronts.iter().map(|front| (line.abscissa(front) - half(front), line.abscissa(front) + half(front)));
    let low = ends.clone().map(|end| end.0).fold(f64::INFINITY, f64::min);
    let high = ends.map(|end| end.1).fold(f64::NEG_INFINITY, f64::max);
    let at =
        |abscissa: f64| Point::from(direction(line.angle) * abscissa + normal(line.angle) * f64::midpoint(right, left));
    Aisle {
        number,
        center_line: [at(low), at(high)],
        width: (left - right).max(0.0),
        corridor: line.place,
        left: Vec::new(),
        right: Vec::new(),
    }
}

/// Width of the free drivable ground before the fronts of an aisle with one side, metres: the median.
fn open_width(map: &SiteMap<'_>, line: &FrontLine) -> f64 {
    let mut widths: Vec<f64> =
        line.fronts.iter().map(|front| free_ahead(map, front.middle, -direction(front.heading))).collect();
    widths.sort_by(f64::total_cmp);
    widths.get(widths.len() / 2).copied().unwrap_or(0.0)
}

/// How far free drivable ground reaches from a point, metres.
fn free_ahead(map: &SiteMap<'_>, from: Point, ahead: Vector) -> f64 {
    let step = map.grid.resolution();
    // The cells of the front itself may hold goods.
    let mut steps = 1..=(WIDEST_M / step).ceil() as usize;
    let is_free = |steps: &usize| {
        let point = from + ahead * (*steps as f64 * step);
        let Some((column, row)) = map.grid.cell_at(point) else { return false };
        let is_near = (*steps as f64) * step < WIDEST_M / 20.0;
        is_near || map.grid.row(row)[column] == Occupancy::Free && map.is_drivable(map.cells.at(column, row))
    };
    steps.find(|steps| !is_free(steps)).map_or(WIDEST_M, |steps| (steps - 1) as f64 * step)
}

/// Cuts one side of an aisle into rows: lists of its fronts.
pub(super) fn cut_rows(line: &FrontLine, side: Side, drafts: &[Draft], vehicle: f64) -> Vec<Vec<AisleFront>> {
    let mut rows: Vec<Vec<AisleFront>> = Vec::new();
    let mut end = f64::NEG_INFINITY;
    for front in line.side(side) {
        let half = drafts[front.location].width / 2.0;
        let at = line.abscissa(&front);
        match rows.last_mut() {
            Some(row) if at - half - end <= vehicle => row.push(front),
            _ => rows.push(vec![front]),
        }
        end = end.max(at + half);
    }
    rows
}

/// A row from its locations: those at the aisle first, then those behind them.
pub(super) fn row(
    number: u32,
    aisle: u32,
    side: Side,
    angle: f64,
    members: Vec<usize>,
    layers: u32,
    drafts: &[Draft],
) -> Row {
    let (along, across) = (direction(angle), normal(angle));
    let corners = || members.iter().flat_map(|&member| drafts[member].outline.iter());
    let extent = |axis: Vector| {
        let places = corners().map(|corner| axis.dot(&corner.coords));
        [places.clone().fold(f64::INFINITY, f64::min), places.fold(f64::NEG_INFINITY, f64::max)]
    };
    let ([start, end], [low, high]) = (extent(along), extent(across));
    let at = |abscissa: f64| Point::from(along * abscissa + across * f64::midpoint(low, high));
    Row { number, aisle, side, center_line: [at(start), at(end)], depth: high - low, layers, locations: members }
}
