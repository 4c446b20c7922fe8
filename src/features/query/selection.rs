//! Selection by a bounding box: by the shape of each feature, not by its bounds alone.

use stillage_core::Point;
use stillage_core::geometry::{Bounds, polygon};

use crate::coordinates::{Crs, Transform};
use crate::features::feature::Feature;
use crate::features::geometry::Geometry;

/// A box in the coordinates of a client, ready to be compared with features.
///
/// The box is a rectangle in the frame of [`Transform::upright`]. Features are brought into that frame when they are
/// compared, which costs four multiplications for each point, and a projection where the box is one of UTM.
#[derive(Debug)]
pub struct BoxSelection {
    transform: Transform,
    /// Two where the box crosses the antimeridian.
    parts: Vec<Part>,
}

#[derive(Debug)]
struct Part {
    /// In the upright frame.
    rectangle: Bounds,
    /// Around it, in map-frame metres; none in UTM, whose boxes have bent sides there.
    bounds: Option<Bounds>,
}

impl BoxSelection {
    /// The features that meet the box from `west` to `east` and from `south` to `north`, in the coordinates that
    /// `transform` leads to.
    ///
    /// # Errors
    /// When the box is inverted. A box of degrees whose west lies east of its east crosses the antimeridian
    /// (OGC API Features part 1, 7.15.3).
    pub fn new([west, south, east, north]: [f64; 4], transform: Transform) -> Result<Self, &'static str> {
        let boxes = match transform.crs() {
            _ if south > north => return Err("is inverted: south lies above north"),
            _ if west <= east => vec![[west, south, east, north]],
            Crs::Crs84 => vec![[west, south, 180.0, north], [-180.0, south, east, north]],
            Crs::WebMercator | Crs::Utm(_) => return Err("is inverted: west lies right of east"),
        };
        let part = |[west, south, east, north]: [f64; 4]| {
            if let Crs::Utm(_) = transform.crs() {
                let rectangle = Bounds { low: Point::new(west, south), high: Point::new(east, north) };
                return Part { rectangle, bounds: None };
            }
            let corners = [[west, south], [east, south], [east, north], [west, north]];
            let corners = corners.map(|corner| transform.inverse(corner));
            let rectangle = Bounds::around(&corners.map(|corner| transform.upright(corner)));
            Part { rectangle, bounds: Some(Bounds::around(&corners)) }
        };
        Ok(Self { transform, parts: boxes.into_iter().map(part).collect() })
    }

    /// Whether the shape of a feature has a point in common with the box; its sides count.
    #[must_use]
    pub fn meets(&self, feature: &Feature) -> bool {
        self.meets_geometry(&feature.bounds, &feature.geometry)
    }

    fn meets_geometry(&self, bounds: &Bounds, geometry: &Geometry) -> bool {
        self.parts.iter().any(|part| {
            part.bounds.is_none_or(|around| bounds.meets(&around)) && {
                let is_inside = |corner: Point| part.rectangle.contains(self.transform.upright(corner));
                bounds.corners().into_iter().all(is_inside) || self.meets_shape(part, geometry)
            }
        })
    }

    fn meets_shape(&self, part: &Part, geometry: &Geometry) -> bool {
        let turned =
            |points: &Vec<Point>| -> Vec<Point> { points.iter().map(|&point| self.transform.upright(point)).collect() };
        let path = |points: &Vec<Point>| {
            turned(points).windows(2).any(|pair| part.rectangle.meets_segment([pair[0], pair[1]]))
        };
        let area = |rings: &Vec<Vec<Point>>| {
            let rings: Vec<Vec<Point>> = rings.iter().map(turned).collect();
            // The box may also lie inside, clear of every ring.
            polygon::sides(&rings).any(|side| part.rectangle.meets_segment(side))
                || polygon::contains(&rings, part.rectangle.low)
        };
        match geometry {
            Geometry::Point(point) => part.rectangle.contains(self.transform.upright(*point)),
            Geometry::LineString(points) => path(points),
            Geometry::MultiLineString(paths) => paths.iter().any(path),
            Geometry::Polygon(rings) => area(rings),
            Geometry::MultiPolygon(polygons) => polygons.iter().any(area),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coordinates::Georeference;
    use crate::features::Ring;
    use crate::features::rings::{polygons, raster_outlines};
    use proptest::prelude::*;

    fn metres(bbox: [f64; 4]) -> BoxSelection {
        BoxSelection::new(bbox, Transform::map_frame()).expect("is a box")
    }

    fn meets(selection: &BoxSelection, geometry: &Geometry) -> bool {
        selection.meets_geometry(&geometry.bounds(), geometry)
    }

    #[test]
    fn inverted_boxes_are_refused() {
        let is_box = |crs, bbox| BoxSelection::new(bbox, Transform::new(crs, None)).is_ok();
        assert!(!is_box(Crs::WebMercator, [3.0, 2.0, 1.0, 4.0]));
        assert!(!is_box(Crs::WebMercator, [1.0, 4.0, 3.0, 2.0]));
        assert!(!is_box(Crs::Crs84, [1.0, 4.0, 3.0, 2.0]));
        assert!(is_box(Crs::Crs84, [179.0, 2.0, -179.0, 4.0]), "across the antimeridian");
    }

    #[test]
    fn the_shape_counts_and_not_its_bounds() {
        let corner = [(0.0, 0.0), (10.0, 0.0), (10.0, 1.0), (1.0, 1.0), (1.0, 10.0), (0.0, 10.0)];
        let shape = Geometry::Polygon(vec![corner.map(|(x, y)| Point::new(x, y)).to_vec()]);
        assert!(meets(&metres([8.0, 0.5, 9.0, 5.0]), &shape));
        assert!(!meets(&metres([5.0, 5.0, 9.0, 9.0]), &shape), "in the notch");
        assert!(meets(&metres([0.2, 0.2, 0.3, 0.3]), &shape), "inside");
        assert!(meets(&metres([-5.0, -5.0, 50.0, 50.0]), &shape), "around");
        let diagonal = Geometry::LineString(vec![Point::new(0.0, 0.0), Point::new(10.0, 10.0)]);
        assert!(meets(&metres([4.0, 4.0, 6.0, 6.0]), &diagonal));
        assert!(!meets(&metres([6.0, 0.0, 9.0, 3.0]), &diagonal));
        let point = Geometry::Point(Point::new(2.0, 2.0));
        assert!(meets(&metres([2.0, 2.0, 3.0, 3.0]), &point), "on the corner");
        assert!(!meets(&metres([2.1, 2.0, 3.0, 3.0]), &point));
    }

    #[test]
    fn a_turned_map_is_selected_in_degrees() {
        let georeference = Georeference { lon: 12.8, lat: 56.6, heading: 30.0 };
        let transform = Transform::new(Crs::Crs84, Some(georeference));
        let point = Point::new(100.0, 40.0);
        let [lon, lat] = transform.forward(point);
        let select = |bbox| meets(&BoxSelection::new(bbox, transform).expect("is a box"), &Geometry::Point(point));
        assert!(select([lon - 1e-6, lat - 1e-6, lon + 1e-6, lat + 1e-6]));
        assert!(!select([lon + 1e-6, lat - 1e-6, lon + 2e-6, lat + 1e-6]));
        assert!(select([-180.0, -90.0, 180.0, 90.0]));
    }

    #[test]
    fn a_box_of_utm_selects_along_the_axes_of_its_zone() {
        let georeference = Georeference { lon: 12.8, lat: 56.6, heading: 30.0 };
        let crs = Crs::of_map(Some(georeference)).pop().expect("has systems");
        let transform = Transform::new(crs, Some(georeference));
        let shape = Geometry::LineString(vec![Point::new(100.0, 40.0), Point::new(300.0, 40.0)]);
        let [easting, northing] = transform.forward(Point::new(200.0, 40.0));
        let select = |bbox| meets(&BoxSelection::new(bbox, transform).expect("is a box"), &shape);
        assert!(select([easting - 0.01, northing - 0.01, easting + 0.01, northing + 0.01]));
        assert!(!select([easting + 1.0, northing + 1.0, easting + 2.0, northing + 2.0]));
        assert!(select([0.0, 0.0, 1e6, 1e7]), "the whole zone");
    }

    proptest! {
        // Cells of 1 m, some of them inside the shape; a box that touches no border of a cell. The shape meets the box
        // where some cell inside does.
        #[test]
        fn an_area_is_selected_where_one_of_its_cells_would_be(
            cells in prop::collection::vec(any::<bool>(), 30),
            (west, width) in (-2..8_i32, 0..8_i32),
            (south, height) in (-2..8_i32, 0..8_i32),
            heading in prop::option::of(-180.0..180.0),
            crs in prop::sample::select(vec![Crs::Crs84, Crs::WebMercator]),
        ) {
            let rings = raster_outlines(6, 5, |column, row| cells[row * 6 + column]);
            let [west, south] = [west, south].map(|side| f64::from(side) + 0.25);
            let [east, north] = [west + f64::from(width) + 0.5, south + f64::from(height) + 0.5];
            let expected = (0..30).any(|index| {
                let (x, y) = (f64::from(index % 6), f64::from(index / 6));
                cells[index as usize] && x < east && x + 1.0 > west && y < north && y + 1.0 > south
            });
            // The shape lies askew in its map frame, and upright on Earth.
            let georeference = heading.map(|heading| Georeference { lon: 12.8, lat: 56.6, heading });
            let upright = Transform::new(crs, georeference);
            let (sine, cosine) = heading.unwrap_or(0.0_f64).to_radians().sin_cos();
            let askew = |x: f64, y: f64| Point::new(x * cosine - y * sine, x * sine + y * cosine);
            let ring = |ring: &Vec<(usize, usize)>| -> Ring {
                ring.iter().map(|&(x, y)| askew(x as f64, y as f64)).collect()
            };
            let shape = Geometry::area(polygons(rings.iter().map(ring).collect()));
            let [low, high] = [(west, south), (east, north)].map(|(x, y)| upright.forward(askew(x, y)));
            let selection = BoxSelection::new([low[0], low[1], high[0], high[1]], upright).expect("is a box");
            prop_assert_eq!(meets(&selection, &shape), expected);
        }
    }
}
