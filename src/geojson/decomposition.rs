//! Lines and regions: what the subdivision was made from.

use serde_json::json;
use stillage_core::geometry::{direction, normal};
use stillage_core::line::Line;
use stillage_core::segmentation::RegionMap;
use stillage_core::{Point, Vector};

use super::feature::{Feature, Geometry};
use super::rings::{polygons, raster_outlines};
use super::subdivision::{map_position, number_id, position_value, properties};
use super::{MapView, orientation_degrees, rounded};

pub(super) fn lines(view: &MapView<'_>) -> Vec<Feature> {
    let feature = |(index, line): (usize, &Line)| {
        let foot = Point::from(normal(line.orientation) * line.offset);
        // The map frame has another origin, and folding may turn the normal around: the offset goes with the
        // orientation as it is written.
        let orientation = orientation_degrees(view, line.orientation);
        let offset = normal(orientation.to_radians()).dot(&map_position(view, foot).coords);
        let properties = properties([
            ("id", json!(index)),
            ("orientation", json!(orientation)),
            ("offset", json!(rounded(offset))),
            ("support", json!(rounded(line.support))),
            ("region", json!((line.region != RegionMap::NONE).then_some(line.region))),
        ]);
        let along = direction(line.orientation);
        let path =
            |[start, end]: [f64; 2]| [start, end].map(|abscissa| map_position(view, foot + along * abscissa)).to_vec();
        let mut paths: Vec<Vec<Point>> = line.extents.iter().map(|&extent| path(extent)).collect();
        let geometry = match paths.len() {
            // A line without stretches runs through the whole grid.
            0 => Geometry::LineString(path(grid_range(view, along))),
            1 => Geometry::LineString(paths.remove(0)),
            _ => Geometry::MultiLineString(paths),
        };
        Feature::new(number_id(index), geometry, properties)
    };
    view.analysis.lines.iter().enumerate().map(feature).collect()
}

/// Smallest and largest abscissa of the grid along a direction.
fn grid_range(view: &MapView<'_>, along: Vector) -> [f64; 2] {
    let resolution = view.analysis.frame.resolution;
    let (width, height) = (view.analysis.width as f64 * resolution, view.analysis.height as f64 * resolution);
    let corners = [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)];
    corners
        .iter()
        .map(|&(x, y)| along.dot(&Vector::new(x, y)))
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], abscissa| [low.min(abscissa), high.max(abscissa)])
}

pub(super) fn regions(view: &MapView<'_>) -> Vec<Feature> {
    let map = &view.analysis.regions;
    let resolution = view.analysis.frame.resolution;
    // The last tiles may reach beyond the grid.
    let metres = |tiles: usize, cells: usize| (tiles * map.tile_cells).min(cells) as f64 * resolution;
    map.regions
        .iter()
        .enumerate()
        .map(|(index, region)| {
            let is_inside = |column, row| usize::from(map.tiles[row * map.columns + column]) == index;
            let corner = |&(column, row): &(usize, usize)| {
                let point = Point::new(metres(column, view.analysis.width), metres(row, view.analysis.height));
                map_position(view, point)
            };
            let rings = raster_outlines(map.columns, map.rows, is_inside);
            let rings = rings.iter().map(|ring| ring.iter().map(corner).collect()).collect();
            let mut orientations: Vec<f64> =
                region.orientations.iter().map(|&angle| orientation_degrees(view, angle)).collect();
            orientations.sort_by(f64::total_cmp);
            let bounds = &region.bounds;
            let properties = properties([
                ("id", json!(index)),
                ("orientations", json!(orientations)),
                ("share", json!(rounded(region.share))),
                (
                    "box",
                    json!({
                        "center": position_value(view, bounds.center),
                        "lengthM": rounded(bounds.half_extents[0] * 2.0),
                        "widthM": rounded(bounds.half_extents[1] * 2.0),
                        "orientation": orientation_degrees(view, bounds.angle),
                    }),
                ),
            ]);
            Feature::new(number_id(index), Geometry::area(polygons(rings)), properties)
        })
        .collect()
}
