//! Points that lie in the map once they are read in another coordinate reference system.

use crate::app::MapContext;
use crate::coordinates::{Crs, Transform};

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
fn is_inside(context: &MapContext, transform: &Transform, position: [f64; 2]) -> bool {
    let point = context.analysis.frame.to_grid(transform.inverse(position));
    let resolution = context.grid.resolution();
    let [width, height] = [context.grid.width(), context.grid.height()].map(|cells| cells as f64 * resolution);
    (0.0..width).contains(&point.x) && (0.0..height).contains(&point.y)
}
