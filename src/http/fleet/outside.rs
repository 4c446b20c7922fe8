//! Points outside the map: what lies nearest to them, and in which coordinates they lie in it.

use stillage_core::Point;

use crate::app::MapContext;
use crate::coordinates::{Crs, Transform};
use crate::http::problem::{Problem, ProblemType};

/// A hint where a position is outside the map in the coordinates of the request and inside in the others: metres sent
/// without `crs=EPSG:3857`, or degrees with it.
pub fn did_you_mean_crs(context: &MapContext, transform: &Transform, position: [f64; 2]) -> Option<&'static str> {
    let (other, hint) = match transform.crs() {
        Crs::Crs84 => (Crs::WebMercator, "did you mean crs=EPSG:3857?"),
        Crs::WebMercator | Crs::Utm(_) => (Crs::Crs84, "did you mean crs=CRS84?"),
    };
    let other = Transform::new(other, context.record.georeference);
    let systems = [(transform, false), (&other, true)];
    systems.into_iter().all(|(system, inside)| is_inside(context, system, position) == inside).then_some(hint)
}

/// Whether a position lies in the map.
pub fn is_inside(context: &MapContext, transform: &Transform, position: [f64; 2]) -> bool {
    let point = context.analysis.frame.to_grid(transform.inverse(position));
    let resolution = context.grid.resolution();
    let [width, height] = [context.grid.width(), context.grid.height()].map(|cells| cells as f64 * resolution);
    (0.0..width).contains(&point.x) && (0.0..height).contains(&point.y)
}

/// The point lies outside the map; the nearest one inside is named.
pub fn refusal(context: &MapContext, transform: &Transform, at: [f64; 2]) -> Problem {
    let point = context.analysis.frame.to_grid(transform.inverse(at));
    let grid = &context.grid;
    let within = |place: f64, cells: usize| {
        let half = grid.resolution() / 2.0;
        place.clamp(half, (cells as f64 * grid.resolution() - half).max(half))
    };
    let nearest = Point::new(within(point.x, grid.width()), within(point.y, grid.height()));
    let [x, y] = transform.readable(context.analysis.frame.to_map(nearest));
    let away = (nearest - point).norm();
    let hint = did_you_mean_crs(context, transform, at).map(|hint| format!("; {hint}")).unwrap_or_default();
    let detail = format!("the point lies {away:.2} m outside the map: the nearest in it is {x},{y}{hint}");
    Problem::new(ProblemType::OutsideMap, detail)
}
