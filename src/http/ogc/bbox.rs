//! Selection by a bounding box: by the shape of each feature, not by its bounds alone.

use serde::Deserialize;
use stillage_core::Point;

use crate::geojson::{Crs, Feature, Geometry, Transform};

/// A box as a parameter: west, south, east, north.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "String")]
pub struct Bbox([f64; 4]);

impl TryFrom<String> for Bbox {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
        match numbers.as_deref() {
            Some(&[west, south, east, north]) => Ok(Self([west, south, east, north])),
            // Heights do not select: a map lies on the floor.
            Some(&[west, south, low, east, north, high]) if low <= high => Ok(Self([west, south, east, north])),
            _ => Err("must be four or six numbers: west,south[,low],east,north[,high]"),
        }
    }
}

impl std::fmt::Display for Bbox {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [west, south, east, north] = self.0;
        write!(formatter, "{west},{south},{east},{north}")
    }
}

/// A rectangle: smallest x and y, largest x and y.
type Rectangle = [f64; 4];

/// A box in the coordinates that the client gave it in, ready to be compared with features.
#[derive(Debug)]
pub struct Selection {
    transform: Transform,
    /// Two where the box crosses the antimeridian.
    parts: Vec<Part>,
}

#[derive(Debug)]
struct Part {
    /// In the coordinates of the client.
    rectangle: Rectangle,
    /// Around it, in map-frame metres.
    bounds: Rectangle,
}

impl Selection {
    /// A selection by a box.
    ///
    /// # Errors
    /// When the box is inverted. A box of degrees whose west lies east of its east crosses the antimeridian
    /// (OGC API Features part 1, 7.15.3).
    pub fn new(Bbox([west, south, east, north]): Bbox, transform: Transform) -> Result<Self, &'static str> {
        let rectangles = match transform.crs() {
            _ if south > north => return Err("is inverted: south lies above north"),
            _ if west <= east => vec![[west, south, east, north]],
            Crs::Crs84 => vec![[west, south, 180.0, north], [-180.0, south, east, north]],
            Crs::WebMercator => return Err("is inverted: west lies right of east"),
        };
        let part =
            |rectangle| Part { rectangle, bounds: bounds(corners(rectangle).map(|corner| transform.inverse(corner))) };
        Ok(Self { transform, parts: rectangles.into_iter().map(part).collect() })
    }

    /// Whether the shape of a feature meets the box.
    #[must_use]
    pub fn matches(&self, feature: &Feature) -> bool {
        self.parts.iter().any(|part| {
            overlap(feature.bbox, part.bounds) && {
                let within = |corner: [f64; 2]| contains(part.rectangle, self.transform.forward(Point::from(corner)));
                corners(feature.bbox).into_iter().all(within) || self.meets(part.rectangle, &feature.geometry)
            }
        })
    }

    fn meets(&self, rectangle: Rectangle, geometry: &Geometry) -> bool {
        let path = |points: &[Point], closed| {
            let positions: Vec<[f64; 2]> = points.iter().map(|&point| self.transform.forward(point)).collect();
            let closing = positions.first().filter(|_| closed).zip(positions.last());
            positions.windows(2).any(|pair| segment_meets(rectangle, pair[0], pair[1]))
                || closing.is_some_and(|(&first, &last)| segment_meets(rectangle, last, first))
        };
        let polygon = |rings: &[Vec<Point>]| {
            // The box may also lie inside, clear of every ring.
            rings.iter().any(|ring| path(ring, true)) || self.surrounds(rings, [rectangle[0], rectangle[1]])
        };
        match geometry {
            Geometry::Point(point) => contains(rectangle, self.transform.forward(*point)),
            Geometry::LineString(points) => path(points, false),
            Geometry::MultiLineString(paths) => paths.iter().any(|points| path(points, false)),
            Geometry::Polygon(rings) => polygon(rings),
            Geometry::MultiPolygon(polygons) => polygons.iter().any(|rings| polygon(rings)),
        }
    }

    /// Whether a position lies inside a polygon: a ray to the right crosses its rings an odd number of times.
    fn surrounds(&self, rings: &[Vec<Point>], [x, y]: [f64; 2]) -> bool {
        let mut inside = false;
        for ring in rings {
            let positions: Vec<[f64; 2]> = ring.iter().map(|&point| self.transform.forward(point)).collect();
            for (index, &[x1, y1]) in positions.iter().enumerate() {
                let [x2, y2] = positions[(index + 1) % positions.len()];
                if (y1 > y) != (y2 > y) && x < x1 + (y - y1) / (y2 - y1) * (x2 - x1) {
                    inside = !inside;
                }
            }
        }
        inside
    }
}

fn corners([west, south, east, north]: Rectangle) -> [[f64; 2]; 4] {
    [[west, south], [east, south], [east, north], [west, north]]
}

fn bounds(points: [Point; 4]) -> Rectangle {
    let empty = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    points.iter().fold(empty, |[west, south, east, north], point| {
        [west.min(point.x), south.min(point.y), east.max(point.x), north.max(point.y)]
    })
}

fn overlap(first: Rectangle, second: Rectangle) -> bool {
    first[0] <= second[2] && second[0] <= first[2] && first[1] <= second[3] && second[1] <= first[3]
}

fn contains([west, south, east, north]: Rectangle, [x, y]: [f64; 2]) -> bool {
    (west..=east).contains(&x) && (south..=north).contains(&y)
}

/// Whether a segment meets a rectangle: what is left of it between the four sides (Liang and Barsky, 1984,
/// doi 10.1145/357332.357333).
fn segment_meets([west, south, east, north]: Rectangle, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) -> bool {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for (from, step, low, high) in [(x1, x2 - x1, west, east), (y1, y2 - y1, south, north)] {
        if step == 0.0 {
            if !(low..=high).contains(&from) {
                return false;
            }
            continue;
        }
        let (first, second) = ((low - from) / step, (high - from) / step);
        enters = enters.max(first.min(second));
        leaves = leaves.min(first.max(second));
    }
    enters <= leaves
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geojson::{FeatureId, Georeference};

    fn feature(geometry: Geometry) -> Feature {
        let points: Vec<Point> = geometry.points().collect();
        let bbox = points.iter().fold([f64::MAX, f64::MAX, f64::MIN, f64::MIN], |[west, south, east, north], point| {
            [west.min(point.x), south.min(point.y), east.max(point.x), north.max(point.y)]
        });
        Feature { id: FeatureId::Number(1), bbox, geometry, properties: serde_json::Map::new() }
    }

    fn metres(bbox: [f64; 4]) -> Selection {
        Selection::new(Bbox(bbox), Transform::map_frame()).expect("is a box")
    }

    #[test]
    fn boxes_have_four_or_six_numbers() {
        let read = |text: &str| Bbox::try_from(text.to_owned()).ok().map(|bbox| bbox.0);
        assert_eq!(read("1,2,3,4"), Some([1.0, 2.0, 3.0, 4.0]));
        assert_eq!(read("1,2,-9,3,4,9"), Some([1.0, 2.0, 3.0, 4.0]));
        for wrong in ["", "1,2,3", "1,2,3,4,5", "1,2,x,4", "1,2,NaN,4", "1,2,inf,4", "1,2,9,3,4,-9"] {
            assert_eq!(read(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn inverted_boxes_are_refused() {
        let select = |crs, bbox| Selection::new(Bbox(bbox), Transform::new(crs, None)).is_ok();
        assert!(!select(Crs::WebMercator, [3.0, 2.0, 1.0, 4.0]));
        assert!(!select(Crs::WebMercator, [1.0, 4.0, 3.0, 2.0]));
        assert!(!select(Crs::Crs84, [1.0, 4.0, 3.0, 2.0]));
        assert!(select(Crs::Crs84, [179.0, 2.0, -179.0, 4.0]), "across the antimeridian");
    }

    #[test]
    fn the_shape_counts_and_not_its_bounds() {
        let corner = vec![
            Point::new(0.0, 0.0),
            Point::new(10.0, 0.0),
            Point::new(10.0, 1.0),
            Point::new(1.0, 1.0),
            Point::new(1.0, 10.0),
            Point::new(0.0, 10.0),
        ];
        let shape = feature(Geometry::Polygon(vec![corner]));
        assert!(metres([8.0, 0.5, 9.0, 5.0]).matches(&shape));
        assert!(!metres([5.0, 5.0, 9.0, 9.0]).matches(&shape), "in the notch");
        assert!(metres([0.2, 0.2, 0.3, 0.3]).matches(&shape), "inside");
        assert!(metres([-5.0, -5.0, 50.0, 50.0]).matches(&shape), "around");
        let diagonal = feature(Geometry::LineString(vec![Point::new(0.0, 0.0), Point::new(10.0, 10.0)]));
        assert!(metres([4.0, 4.0, 6.0, 6.0]).matches(&diagonal));
        assert!(!metres([6.0, 0.0, 9.0, 3.0]).matches(&diagonal));
        let point = feature(Geometry::Point(Point::new(2.0, 2.0)));
        assert!(metres([2.0, 2.0, 3.0, 3.0]).matches(&point), "on the corner");
        assert!(!metres([2.1, 2.0, 3.0, 3.0]).matches(&point));
    }

    #[test]
    fn a_hole_is_not_inside() {
        let square = |low: f64, high: f64| {
            vec![Point::new(low, low), Point::new(high, low), Point::new(high, high), Point::new(low, high)]
        };
        let mut hole = square(3.0, 7.0);
        hole.reverse();
        let ring = feature(Geometry::Polygon(vec![square(0.0, 10.0), hole]));
        assert!(!metres([4.0, 4.0, 6.0, 6.0]).matches(&ring));
        assert!(metres([1.0, 1.0, 2.0, 2.0]).matches(&ring));
    }

    #[test]
    fn a_turned_map_is_selected_in_degrees() {
        let georeference = Georeference { lon: 12.8, lat: 56.6, heading: 30.0 };
        let transform = Transform::new(Crs::Crs84, Some(georeference));
        let point = Point::new(100.0, 40.0);
        let shape = feature(Geometry::Point(point));
        let [lon, lat] = transform.forward(point);
        let select = |bbox| Selection::new(Bbox(bbox), transform).expect("is a box").matches(&shape);
        assert!(select([lon - 1e-6, lat - 1e-6, lon + 1e-6, lat + 1e-6]));
        assert!(!select([lon + 1e-6, lat - 1e-6, lon + 2e-6, lat + 1e-6]));
        assert!(select([-180.0, -90.0, 180.0, 90.0]));
    }
}
