//! Universal Transverse Mercator: longitude and latitude -> metres of a zone, and back.
//!
//! Source: C. F. F. Karney, "Transverse Mercator with an accuracy of a few nanometers", J. Geodesy 85 (2011), doi
//! 10.1007/s00190-011-0445-3, equations 7 to 36: the series of Krüger (1912) in the third flattening, to its sixth order.
//! Ellipsoid: WGS 84. Within 3,900 km of the middle meridian the series is right to 5 nm. Cost: some twenty trigonometric
//! functions for a point.

/// Equatorial radius of WGS 84, metres.
const RADIUS: f64 = 6_378_137.0;
/// Flattening of WGS 84.
const FLATTENING: f64 = 1.0 / 298.257_223_563;
/// Third flattening.
const N: f64 = FLATTENING / (2.0 - FLATTENING);
/// Scale on the middle meridian of a zone.
const SCALE: f64 = 0.9996;
/// Easting of the middle meridian, metres.
const FALSE_EASTING: f64 = 500_000.0;
/// Northing of the equator in zones of the south, metres.
const FALSE_NORTHING_SOUTH: f64 = 10_000_000.0;
/// Radius of the circle whose circumference is that of a meridian, metres (equation 14).
const MERIDIAN_RADIUS: f64 =
    RADIUS / (1.0 + N) * (1.0 + N * N / 4.0 + N * N * N * N / 64.0 + N * N * N * N * N * N / 256.0);
/// Latitudes of UTM, degrees; beyond them lie the polar caps.
const LATITUDES: std::ops::RangeInclusive<f64> = -80.0..=84.0;
/// Steps of Newton's method for the latitude: the second is exact to rounding, the third is for certainty.
const NEWTON_STEPS: usize = 3;

/// The terms of a series in the third flattening: coefficients of `N` to the power of 1 to 6.
type SeriesTerms = [[f64; 6]; 6];

/// From the sphere to the ellipsoid (equation 35).
#[rustfmt::skip]
const ALPHA: SeriesTerms = [
    [1.0 / 2.0, -2.0 / 3.0, 5.0 / 16.0, 41.0 / 180.0, -127.0 / 288.0, 7_891.0 / 37_800.0],
    [0.0, 13.0 / 48.0, -3.0 / 5.0, 557.0 / 1_440.0, 281.0 / 630.0, -1_983_433.0 / 1_935_360.0],
    [0.0, 0.0, 61.0 / 240.0, -103.0 / 140.0, 15_061.0 / 26_880.0, 167_603.0 / 181_440.0],
    [0.0, 0.0, 0.0, 49_561.0 / 161_280.0, -179.0 / 168.0, 6_601_661.0 / 7_257_600.0],
    [0.0, 0.0, 0.0, 0.0, 34_729.0 / 80_640.0, -3_418_889.0 / 1_995_840.0],
    [0.0, 0.0, 0.0, 0.0, 0.0, 212_378_941.0 / 319_334_400.0],
];

/// From the ellipsoid to the sphere (equation 36).
#[rustfmt::skip]
const BETA: SeriesTerms = [
    [1.0 / 2.0, -2.0 / 3.0, 37.0 / 96.0, -1.0 / 360.0, -81.0 / 512.0, 96_199.0 / 604_800.0],
    [0.0, 1.0 / 48.0, 1.0 / 15.0, -437.0 / 1_440.0, 46.0 / 105.0, -1_118_711.0 / 3_870_720.0],
    [0.0, 0.0, 17.0 / 480.0, -37.0 / 840.0, -209.0 / 4_480.0, 5_569.0 / 90_720.0],
    [0.0, 0.0, 0.0, 4_397.0 / 161_280.0, -11.0 / 504.0, -830_251.0 / 7_257_600.0],
    [0.0, 0.0, 0.0, 0.0, 4_583.0 / 161_280.0, -108_847.0 / 3_991_680.0],
    [0.0, 0.0, 0.0, 0.0, 0.0, 20_648_693.0 / 638_668_800.0],
];

/// A zone of UTM: a strip of six degrees of longitude, north or south of the equator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UtmZone {
    /// 1 to 60, from the antimeridian eastwards.
    number: u8,
    is_south: bool,
}

impl UtmZone {
    /// The zone of a place in degrees; none in the polar caps. The wider zones of Norway and Svalbard are not known here:
    /// a place there gets the regular one.
    #[must_use]
    pub fn of(lon: f64, lat: f64) -> Option<Self> {
        let number = ((lon + 180.0) / 6.0).floor().rem_euclid(60.0) as u8 + 1;
        LATITUDES.contains(&lat).then_some(Self { number, is_south: lat < 0.0 })
    }

    /// The zone with an EPSG code, 32601 to 32660 and 32701 to 32760.
    #[must_use]
    pub const fn of_epsg(code: u32) -> Option<Self> {
        match code {
            32_601..=32_660 => Some(Self { number: (code - 32_600) as u8, is_south: false }),
            32_701..=32_760 => Some(Self { number: (code - 32_700) as u8, is_south: true }),
            _ => None,
        }
    }

    /// Its EPSG code.
    #[must_use]
    pub const fn epsg(self) -> u32 {
        (if self.is_south { 32_700 } else { 32_600 }) + self.number as u32
    }

    /// Longitude of its middle meridian, degrees.
    fn middle(self) -> f64 {
        f64::from(self.number) * 6.0 - 183.0
    }

    fn false_northing(self) -> f64 {
        if self.is_south { FALSE_NORTHING_SOUTH } else { 0.0 }
    }

    /// Longitude and latitude, degrees -> easting and northing, metres.
    #[must_use]
    pub fn forward(self, [lon, lat]: [f64; 2]) -> [f64; 2] {
        let (sine, cosine) = (lon - self.middle()).to_radians().sin_cos();
        let tangent = conformal(lat.to_radians().tan());
        let sphere = [tangent.atan2(cosine), (sine / tangent.hypot(cosine)).asinh()];
        let [along, across] = series(&ALPHA, 1.0, sphere);
        let metres = SCALE * MERIDIAN_RADIUS;
        [FALSE_EASTING + metres * across, self.false_northing() + metres * along]
    }

    /// Easting and northing, metres -> longitude and latitude, degrees.
    #[must_use]
    pub fn inverse(self, [easting, northing]: [f64; 2]) -> [f64; 2] {
        let metres = SCALE * MERIDIAN_RADIUS;
        let ellipsoid = [(northing - self.false_northing()) / metres, (easting - FALSE_EASTING) / metres];
        let [along, across] = series(&BETA, -1.0, ellipsoid);
        let (sine, cosine) = along.sin_cos();
        let tangent = of_conformal(sine / across.sinh().hypot(cosine));
        [self.middle() + across.sinh().atan2(cosine).to_degrees(), tangent.atan().to_degrees()]
    }
}

/// Adds the terms of a series to a point along and across the middle meridian, radians (equations 11 and 13).
fn series(terms: &SeriesTerms, sign: f64, [along, across]: [f64; 2]) -> [f64; 2] {
    let mut sum = [along, across];
    for (index, term) in terms.iter().enumerate() {
        let coefficient = sign * term.iter().rev().fold(0.0, |sum, coefficient| (sum + coefficient) * N);
        let multiple = 2.0 * (index + 1) as f64;
        let (sine, cosine) = (multiple * along).sin_cos();
        sum[0] += coefficient * sine * (multiple * across).cosh();
        sum[1] += coefficient * cosine * (multiple * across).sinh();
    }
    sum
}

/// Tangent of a latitude -> tangent of its conformal latitude (equations 7 to 9).
fn conformal(tangent: f64) -> f64 {
    let eccentricity = (FLATTENING * (2.0 - FLATTENING)).sqrt();
    let secant = tangent.hypot(1.0);
    let sigma = (eccentricity * (eccentricity * tangent / secant).atanh()).sinh();
    tangent * sigma.hypot(1.0) - sigma * secant
}

/// The way back, by Newton's method (equations 19 to 21).
fn of_conformal(wanted: f64) -> f64 {
    let squared = FLATTENING * (2.0 - FLATTENING);
    let mut tangent = wanted / (1.0 - squared);
    for _ in 0..NEWTON_STEPS {
        let found = conformal(tangent);
        let slope =
            (1.0 - squared) * found.hypot(1.0) * tangent.hypot(1.0) / (1.0 + (1.0 - squared) * tangent * tangent);
        tangent += (wanted - found) / slope;
    }
    tangent
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn metres_are_those_of_proj() {
        // pyproj 3.7.2 (PROJ 9.5.1): Transformer.from_crs(4326, zone, always_xy=True).
        let cases = [
            ([12.8572, 56.6745], 32_633, [368_707.235_452_8, 6_283_205.508_482_9]),
            ([9.5, 47.3], 32_632, [537_799.454_675_7, 5_238_624.111_181_4]),
            ([-58.3816, -34.6037], 32_721, [373_317.502_254_6, 6_170_036.171_295_1]),
            ([151.2093, -33.8688], 32_756, [334_368.633_648_1, 6_250_948.345_385_0]),
            ([0.1, 0.05], 32_631, [177_163.928_271_9, 5_533.636_719_4]),
            ([-179.95, 83.5], 32_601, [462_732.432_471_8, 9_273_229.321_474_7]),
        ];
        for (degrees, code, metres) in cases {
            let zone = UtmZone::of(degrees[0], degrees[1]).expect("lies in a zone");
            assert_eq!(zone.epsg(), code);
            let [easting, northing] = zone.forward(degrees);
            assert!((easting - metres[0]).abs() < 1e-6 && (northing - metres[1]).abs() < 1e-6, "{easting} {northing}");
            let [lon, lat] = zone.inverse(metres);
            assert!((lon - degrees[0]).abs() < 1e-11 && (lat - degrees[1]).abs() < 1e-11, "{lon} {lat}");
        }
    }

    #[test]
    fn zones_have_codes_and_the_poles_have_none() {
        assert_eq!(UtmZone::of(180.0, 0.0), UtmZone::of_epsg(32_601));
        assert_eq!(UtmZone::of(-180.0, -1.0), UtmZone::of_epsg(32_701));
        assert_eq!(UtmZone::of(179.9, 84.0).map(UtmZone::epsg), Some(32_660));
        assert_eq!(UtmZone::of(12.0, 84.1), None);
        assert_eq!((UtmZone::of_epsg(32_600), UtmZone::of_epsg(32_661), UtmZone::of_epsg(3857)), (None, None, None));
    }

    proptest! {
        #[test]
        fn there_and_back(lon in -180.0..180.0, lat in -80.0..84.0, east in -4.0..4.0) {
            let zone = UtmZone::of(lon, lat).expect("lies in a zone");
            let degrees = [zone.middle() + east, lat];
            let back = zone.inverse(zone.forward(degrees));
            prop_assert!((back[0] - degrees[0]).abs() < 1e-11 && (back[1] - lat).abs() < 1e-11, "{back:?}");
        }
    }
}
