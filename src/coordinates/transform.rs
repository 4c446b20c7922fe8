//! Changes of coordinates: of a nominal map by the spherical Mercator, of a georeferenced one by its tangent plane.

use stillage_core::Point;

use super::crs::Crs;
use super::georeference::Georeference;

/// Radius of the sphere of EPSG:3857, which is the equatorial radius of WGS 84, metres.
const RADIUS: f64 = 6_378_137.0;
/// Flattening of WGS 84.
const FLATTENING: f64 = 1.0 / 298.257_223_563;
/// The latitude where EPSG:3857 ends, degrees.
const MERCATOR_LATITUDE: f64 = 85.051_128_779_806_59;

/// A change of coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    crs: Crs,
    anchor: Option<Anchor>,
}

/// The tangent plane of a georeferenced map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Anchor {
    /// Longitude and latitude of the map frame's origin, degrees.
    origin: [f64; 2],
    /// Metres eastwards and northwards per degree.
    metres_per_degree: [f64; 2],
    /// Sine and cosine of the heading of the map's y axis, clockwise from north.
    heading: (f64, f64),
}

impl Anchor {
    pub(super) fn new(georeference: Georeference) -> Self {
        let Georeference { lon, lat, heading } = georeference;
        let eccentricity = FLATTENING * (2.0 - FLATTENING);
        let (sine, cosine) = lat.to_radians().sin_cos();
        let flat = 1.0 - eccentricity * sine * sine;
        let northwards = RADIUS * (1.0 - eccentricity) / flat.powf(1.5);
        // At the poles no metre is a degree of longitude; keep the division defined.
        let eastwards = (RADIUS / flat.sqrt() * cosine).max(1.0);
        Self {
            origin: [lon, lat],
            metres_per_degree: [eastwards.to_radians(), northwards.to_radians()],
            heading: heading.to_radians().sin_cos(),
        }
    }

    /// Metres eastwards and northwards of the origin.
    fn eastwards_northwards(self, point: Point) -> Point {
        let (sine, cosine) = self.heading;
        Point::new(point.x * cosine + point.y * sine, point.y * cosine - point.x * sine)
    }

    pub(super) fn to_degrees(self, point: Point) -> [f64; 2] {
        let turned = self.eastwards_northwards(point);
        [self.origin[0] + turned.x / self.metres_per_degree[0], self.origin[1] + turned.y / self.metres_per_degree[1]]
    }

    pub(super) fn to_metres(self, [lon, lat]: [f64; 2]) -> Point {
        let (sine, cosine) = self.heading;
        let east = (lon - self.origin[0]) * self.metres_per_degree[0];
        let north = (lat - self.origin[1]) * self.metres_per_degree[1];
        Point::new(east * cosine - north * sine, east * sine + north * cosine)
    }
}

impl Transform {
    /// From the map frame to a coordinate system.
    #[must_use]
    pub fn new(crs: Crs, georeference: Option<Georeference>) -> Self {
        Self { crs, anchor: georeference.map(Anchor::new) }
    }

    /// The metres of the map frame as they are.
    #[must_use]
    pub const fn map_frame() -> Self {
        Self { crs: Crs::WebMercator, anchor: None }
    }

    /// The coordinate system it leads to.
    #[must_use]
    pub const fn crs(&self) -> Crs {
        self.crs
    }

    /// Map-frame metres -> x and y, or longitude and latitude.
    #[must_use]
    pub fn forward(&self, point: Point) -> [f64; 2] {
        match (self.crs, self.anchor) {
            (Crs::WebMercator, None) => [point.x, point.y],
            (Crs::Crs84, None) => from_mercator([point.x, point.y]),
            (Crs::Crs84, Some(anchor)) => anchor.to_degrees(point),
            (Crs::WebMercator, Some(anchor)) => to_mercator(anchor.to_degrees(point)),
            (Crs::Utm(zone), None) => zone.forward(from_mercator([point.x, point.y])),
            (Crs::Utm(zone), Some(anchor)) => zone.forward(anchor.to_degrees(point)),
        }
    }

    /// The same in as many digits as a place needs: a millimetre, or 1e-8 degrees, which is that at the equator.
    #[must_use]
    pub fn readable(&self, point: Point) -> [f64; 2] {
        let digits = match self.crs {
            Crs::Crs84 => 1e8,
            Crs::WebMercator | Crs::Utm(_) => 1e3,
        };
        self.forward(point).map(|value| (value * digits).round() / digits)
    }

    /// The way back.
    #[must_use]
    pub fn inverse(&self, position: [f64; 2]) -> Point {
        match (self.crs, self.anchor) {
            (Crs::WebMercator, None) => Point::from(position),
            (Crs::Crs84, None) => Point::from(to_mercator(position)),
            (Crs::Crs84, Some(anchor)) => anchor.to_metres(position),
            (Crs::WebMercator, Some(anchor)) => anchor.to_metres(from_mercator(position)),
            (Crs::Utm(zone), None) => Point::from(to_mercator(zone.inverse(position))),
            (Crs::Utm(zone), Some(anchor)) => anchor.to_metres(zone.inverse(position)),
        }
    }

    /// Map-frame metres -> metres of a frame in which a box of coordinates is a rectangle along the axes: for degrees and
    /// Web Mercator that is eastwards and northwards of the map frame's origin, for UTM its own easting and northing.
    #[must_use]
    pub fn upright(&self, point: Point) -> Point {
        match (self.crs, self.anchor) {
            (Crs::Utm(_), _) => Point::from(self.forward(point)),
            (_, Some(anchor)) => anchor.eastwards_northwards(point),
            (_, None) => point,
        }
    }
}

/// Spherical Mercator metres -> longitude and latitude, degrees.
fn from_mercator([x, y]: [f64; 2]) -> [f64; 2] {
    [(x / RADIUS).to_degrees(), (y / RADIUS).sinh().atan().to_degrees()]
}

/// Longitude and latitude, degrees -> spherical Mercator metres.
fn to_mercator([lon, lat]: [f64; 2]) -> [f64; 2] {
    let lat = lat.clamp(-MERCATOR_LATITUDE, MERCATOR_LATITUDE);
    [lon.to_radians() * RADIUS, lat.to_radians().tan().asinh() * RADIUS]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const HALMSTAD: Georeference = Georeference { lon: 12.8572, lat: 56.6745, heading: 30.0 };

    #[test]
    fn a_nominal_map_is_its_metres_in_web_mercator() {
        let point = Point::new(12.05, -7.35);
        assert_eq!(Transform::new(Crs::WebMercator, None).forward(point), [12.05, -7.35]);
        let [lon, lat] = Transform::new(Crs::Crs84, None).forward(Point::new(111_319.490_793, 0.0));
        assert!((lon - 1.0).abs() < 1e-10 && lat == 0.0);
    }

    #[test]
    fn the_y_axis_points_along_the_heading() {
        let transform = |heading| Transform::new(Crs::Crs84, Some(Georeference { heading, ..HALMSTAD }));
        let up = Point::new(0.0, 100.0);
        let [lon, lat] = transform(0.0).forward(up);
        assert!((lon - 12.8572).abs() < 1e-12);
        // A degree of latitude there is 111.35 km.
        assert!((lat - 56.6745 - 100.0 / 111_350.0).abs() < 1e-7);
        let [lon, lat] = transform(90.0).forward(up);
        assert!(lon > 12.8572 && (lat - 56.6745).abs() < 1e-12, "east is up");
    }

    #[test]
    fn a_georeferenced_map_is_metres_of_its_zone() {
        let crs = Crs::of_map(Some(HALMSTAD)).pop().expect("has systems");
        assert_eq!(crs.epsg(), Some(32_633));
        let transform = Transform::new(crs, Some(HALMSTAD));
        let [origin, beside] = [Point::origin(), Point::new(30.0, 40.0)].map(|point| transform.forward(point));
        assert!((origin[0] - 368_707.235_5).abs() < 1e-4 && (origin[1] - 6_283_205.508_5).abs() < 1e-4, "{origin:?}");
        // Two degrees from its middle meridian a zone is some 0.02 % too small.
        let distance = (beside[0] - origin[0]).hypot(beside[1] - origin[1]);
        assert!((distance / 50.0 - 0.9998).abs() < 2e-4, "{distance}");
        assert_eq!(Crs::of_map(None), [Crs::Crs84, Crs::WebMercator]);
    }

    proptest! {
        #[test]
        fn there_and_back(x in -5_000.0..5_000.0, y in -5_000.0..5_000.0, heading in -360.0..360.0) {
            let point = Point::new(x, y);
            for georeference in [None, Some(Georeference { heading, ..HALMSTAD })] {
                for crs in Crs::of_map(georeference) {
                    let transform = Transform::new(crs, georeference);
                    prop_assert!((transform.inverse(transform.forward(point)) - point).norm() < 1e-6);
                }
            }
        }
    }
}
