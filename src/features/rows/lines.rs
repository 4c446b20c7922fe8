//! Lines that the subdivision was made from.

use stillage_core::geometry::{direction, normal};
use stillage_core::line::Line;
use stillage_core::segmentation::RegionMap;
use stillage_core::{Point, Vector};

use super::common::ORIENTATION;
use crate::features::geometry::{Geometry, GeometryType};
use crate::features::property::{Kind, Property};
use crate::features::table::{Column, Table};
use crate::features::view::{AnalysedMap, rounded};

/// A line.
#[derive(Debug, Clone, PartialEq)]
pub struct LineRow {
    id: u32,
    orientation: f64,
    offset: f64,
    support: f64,
    region: Option<u8>,
}

/// The collection.
pub const TABLE: Table<LineRow> = Table {
    title: "Lines",
    description: "The straight alignments of obstacles behind the decomposition",
    geometry: GeometryType::PATHS,
    columns: &[
        Column::new(Property::new("id", Kind::Integer, "Id", "Number of the line"), |line| line.id.into()),
        Column::new(ORIENTATION, |line| line.orientation.into()),
        Column::new(
            Property::new(
                "offset",
                Kind::Number,
                "Offset",
                "Distance of the line from the origin of the map frame, along its normal to the left",
            )
            .unit("m"),
            |line| line.offset.into(),
        ),
        Column::new(Property::new("support", Kind::Number, "Support", "How many obstacles lie on it"), |line| {
            line.support.into()
        }),
        Column::new(
            Property::new("region", Kind::Integer, "Region", "Id of the region it divides").nullable(),
            |line| line.region.into(),
        ),
    ],
};

/// The lines of a map, by id.
#[must_use]
pub fn read(view: &AnalysedMap<'_>) -> Vec<(Geometry, LineRow)> {
    let row = |(index, line): (usize, &Line)| {
        let foot = Point::from(normal(line.orientation) * line.offset);
        // The map frame has another origin, and folding may turn the normal around: the offset goes with the
        // orientation as it is written.
        let orientation = view.orientation_degrees(line.orientation);
        let row = LineRow {
            id: index as u32,
            orientation,
            offset: rounded(normal(orientation.to_radians()).dot(&view.position(foot).coords)),
            support: rounded(line.support),
            region: (line.region != RegionMap::NONE).then_some(line.region),
        };
        (shape(view, line, foot), row)
    };
    view.analysis.lines.iter().enumerate().map(row).collect()
}

/// The stretches of a line; a line without any runs through the whole grid.
fn shape(view: &AnalysedMap<'_>, line: &Line, foot: Point) -> Geometry {
    let along = direction(line.orientation);
    let path = |[start, end]: [f64; 2]| [start, end].map(|abscissa| view.position(foot + along * abscissa)).to_vec();
    match line.extents[..] {
        [] => Geometry::LineString(path(grid_range(view, along))),
        [only] => Geometry::LineString(path(only)),
        _ => Geometry::MultiLineString(line.extents.iter().map(|&extent| path(extent)).collect()),
    }
}

/// Smallest and largest abscissa of the grid along a direction.
fn grid_range(view: &AnalysedMap<'_>, along: Vector) -> [f64; 2] {
    let resolution = view.analysis.frame.resolution;
    let (width, height) = (view.analysis.width as f64 * resolution, view.analysis.height as f64 * resolution);
    let corners = [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)];
    corners
        .iter()
        .map(|&(x, y)| along.dot(&Vector::new(x, y)))
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], abscissa| [low.min(abscissa), high.max(abscissa)])
}
