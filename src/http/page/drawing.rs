//! Shapes of features -> a small map in SVG, in map-frame metres.

use std::fmt::Write as _;

use stillage_core::Point;
use stillage_core::geometry::Bounds;

use super::markup::{Markup, text};
use crate::features::{Feature, Geometry};

/// Room around the shapes, as a share of the longer side.
const MARGIN: f64 = 0.03;
/// Radius of a point, likewise.
const POINT_RADIUS: f64 = 0.006;
/// Shortest side of the map, metres: a single point has none.
const SHORTEST_M: f64 = 1.0;

/// What a drawing shows: a feature and its address.
#[derive(Debug)]
pub struct LinkedFeature<'a> {
    /// The feature.
    pub feature: &'a Feature,
    /// Where its page is.
    pub href: String,
}

/// A small map of features, each with a link to its page. Nothing where no feature has a shape.
#[must_use]
pub fn drawing(features: &[LinkedFeature<'_>]) -> Markup {
    let points: Vec<&Point> = features.iter().flat_map(|drawn| drawn.feature.geometry.points()).collect();
    let bounds = Bounds::around(points);
    if bounds.is_empty() {
        return Markup::default();
    }
    let [width, height] = [bounds.high.x - bounds.low.x, bounds.high.y - bounds.low.y];
    let size = width.max(height).max(SHORTEST_M);
    let margin = size * MARGIN;
    // Down is positive in a drawing.
    let view = format!(
        "{:.3} {:.3} {:.3} {:.3}",
        bounds.low.x - margin,
        -bounds.high.y - margin,
        width + 2.0 * margin,
        height + 2.0 * margin
    );
    let linked = |drawn: &LinkedFeature<'_>| {
        let name = Markup::element("title", &[], [text(&drawn.feature.id.to_string())]);
        let shape = shape(&drawn.feature.geometry, size * POINT_RADIUS, name);
        Markup::element("a", &[("href", &drawn.href)], [shape])
    };
    Markup::element("svg", &[("viewBox", &view), ("role", "img")], features.iter().map(linked))
}

fn shape(geometry: &Geometry, radius: f64, name: Markup) -> Markup {
    let path = |class: &'static str, steps: String| {
        Markup::element("path", &[("class", class), ("d", &steps)], [name.clone()])
    };
    match geometry {
        Geometry::Point(point) => {
            let [x, y, radius] = [point.x, -point.y, radius].map(|number| format!("{number:.3}"));
            Markup::element("circle", &[("cx", &x), ("cy", &y), ("r", &radius)], [name])
        }
        Geometry::LineString(points) => path("line", steps(points, "")),
        Geometry::MultiLineString(paths) => path("line", paths.iter().map(|points| steps(points, "")).collect()),
        Geometry::Polygon(rings) => path("area", rings.iter().map(|ring| steps(ring, "Z")).collect()),
        Geometry::MultiPolygon(polygons) => {
            path("area", polygons.iter().flatten().map(|ring| steps(ring, "Z")).collect())
        }
    }
}

/// A path in the words of SVG.
fn steps(points: &[Point], end: &str) -> String {
    let mut steps = String::new();
    for (index, point) in points.iter().enumerate() {
        let step = if index == 0 { 'M' } else { 'L' };
        // Writing to a string cannot fail.
        let _ = write!(steps, "{step}{:.3} {:.3}", point.x, -point.y);
    }
    steps + end
}
