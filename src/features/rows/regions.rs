//! Regions of one pattern.

use stillage_core::Point;
use stillage_core::segmentation::Region;

use crate::features::geometry::{Geometry, GeometryType};
use crate::features::property::{Kind, Property};
use crate::features::rings::{polygons, raster_outlines};
use crate::features::table::{Column, Table};
use crate::features::value::BoxValue;
use crate::features::view::{AnalysedMap, rounded};

/// A region.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionRow {
    id: u32,
    orientations: Vec<f64>,
    share: f64,
    bounds: BoxValue,
}

/// The collection.
pub const TABLE: Table<RegionRow> = Table {
    title: "Regions",
    description: "Blocks of the map with a pattern of their own",
    geometry: GeometryType::AREAS,
    columns: &[
        Column::new(Property::new("id", Kind::Integer, "Id", "Number of the region"), |region| region.id.into()),
        Column::new(
            Property::new(
                "orientations",
                Kind::Numbers,
                "Orientations",
                "Its dominant directions, counter-clockwise from the map's x axis, from -90 to 90, ascending",
            )
            .unit("deg"),
            |region| region.orientations.as_slice().into(),
        ),
        Column::new(
            Property::new("share", Kind::Number, "Share", "Its share of the known cells of the map"),
            |region| region.share.into(),
        ),
        Column::new(
            Property::new("box", Kind::Box, "Box", "The box along its first direction around its known cells"),
            |region| region.bounds.into(),
        ),
    ],
};

/// The regions of a map, by id.
#[must_use]
pub fn read(view: &AnalysedMap<'_>) -> Vec<(Geometry, RegionRow)> {
    let row = |(index, region): (usize, &Region)| {
        let mut orientations: Vec<f64> =
            region.orientations.iter().map(|&angle| view.orientation_degrees(angle)).collect();
        orientations.sort_by(f64::total_cmp);
        let bounds = &region.bounds;
        let row = RegionRow {
            id: index as u32,
            orientations,
            share: rounded(region.share),
            bounds: BoxValue {
                center: view.rounded_position(bounds.center),
                length_m: rounded(bounds.half_extents[0] * 2.0),
                width_m: rounded(bounds.half_extents[1] * 2.0),
                orientation: view.orientation_degrees(bounds.angle),
            },
        };
        (shape(view, index), row)
    };
    view.analysis.regions.regions.iter().enumerate().map(row).collect()
}

/// The tiles of a region, merged.
fn shape(view: &AnalysedMap<'_>, index: usize) -> Geometry {
    let map = &view.analysis.regions;
    let resolution = view.analysis.frame.resolution;
    // The last tiles may reach beyond the grid.
    let metres = |tiles: usize, cells: usize| (tiles * map.tile_cells).min(cells) as f64 * resolution;
    let is_inside = |column, row| usize::from(map.tiles[row * map.columns + column]) == index;
    let corner = |&(column, row): &(usize, usize)| {
        view.position(Point::new(metres(column, view.analysis.width), metres(row, view.analysis.height)))
    };
    let rings = raster_outlines(map.columns, map.rows, is_inside);
    Geometry::area(polygons(rings.iter().map(|ring| ring.iter().map(corner).collect()).collect()))
}
