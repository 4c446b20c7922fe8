//! Where vehicles must not drive, as polygons for the vector object server of Nav2.
//!
//! Source: Nav2, `nav2_map_server/vo_server`, github.com/ros-navigation/navigation2. The server paints the polygons of its
//! parameters into a mask for the keepout filter, at any resolution and in any frame.
//!
//! Method: a closed polygon of value 100 for each forbidden face, and for what lies outside the decomposed part of the map
//! up to a margin around it; polygons with holes are cut into ones without. Everything else is 0, free. All numbers have a
//! decimal point, because the server takes an integer among them for an error. Cost: O(corners). Limits: the server paints
//! the cells of a border too, so ground beside a forbidden face loses half a cell.

use stillage_core::Point;
use stillage_core::arrangement::FaceId;
use stillage_core::geometry::Bounds;

use super::hole_free::hole_free;
use super::nav2_masks::KeepoutOptions;
use super::source::ExportSource;
use super::yaml::number;
use super::zones::Ground;

/// How far beyond the map the ground outside is told, metres: wider than every vehicle is long.
const MARGIN_M: f64 = 5.0;

/// The parameters of the server as YAML.
#[must_use]
pub fn parameters(source: &ExportSource<'_>, options: KeepoutOptions) -> Vec<u8> {
    let grounds = Ground::of_faces(source);
    let mut shapes: Vec<(String, Vec<Point>)> = Vec::new();
    for (face, ground) in grounds.into_iter().enumerate() {
        if options.forbids(ground) {
            let pieces = hole_free(&rings(source, face)).into_iter().enumerate();
            shapes.extend(pieces.map(|(piece, ring)| (format!("face_{face}_{}", piece + 1), ring)));
        }
    }
    let names: Vec<String> = shapes.iter().map(|(name, _)| format!("\"{name}\"")).collect();
    let mut text = format!(
        "vector_object_server:\n  ros__parameters:\n    global_frame_id: map\n    resolution: {}\n    default_value: 0\n    \
         overlay_type: 0\n    shapes: [{}]\n",
        number(source.grid.resolution()),
        names.join(", "),
    );
    for (name, ring) in shapes {
        let corners: Vec<String> = ring.into_iter().flat_map(|point| source.position(point).map(number)).collect();
        let corners = corners.join(", ");
        let shape = "{type: polygon, frame_id: map, closed: true, value: 100, points: [";
        text.extend(["    ", &name, ": ", shape, &corners, "]}\n"]);
    }
    text.into_bytes()
}

/// The rings of a face, grid frame; the unbounded one ends at a rectangle around the map.
fn rings(source: &ExportSource<'_>, face: usize) -> Vec<Vec<Point>> {
    let mut rings = source.analysis.subdivision.rings(FaceId(face as u32));
    if face == 0 {
        let cell = source.grid.resolution();
        let corner = Point::new(source.grid.width() as f64 * cell, source.grid.height() as f64 * cell);
        let bounds = Bounds::around(rings.iter().flatten().chain(&[Point::origin(), corner]));
        let (low, high) = (bounds.low.map(|low| low - MARGIN_M), bounds.high.map(|high| high + MARGIN_M));
        rings.insert(0, vec![low, Point::new(high.x, low.y), high, Point::new(low.x, high.y)]);
    }
    rings
}
