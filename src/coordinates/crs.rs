//! The coordinate systems of answers.

use super::georeference::Georeference;
use super::transverse_mercator::UtmZone;

/// Coordinates of an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Crs {
    /// Longitude, latitude.
    #[default]
    Crs84,
    /// EPSG:3857; for a map without georeference these are the metres of the map frame.
    WebMercator,
    /// EPSG:326xx or EPSG:327xx: metres of the zone in which a georeferenced map lies.
    Utm(UtmZone),
}

impl Crs {
    /// The systems in which a map answers. The first is the default; in the last nothing is lost: for a map without
    /// georeference that is Web Mercator, for others their zone of UTM. Maps near a pole have no zone.
    #[must_use]
    pub fn of_map(georeference: Option<Georeference>) -> Vec<Self> {
        let zone = georeference.and_then(|place| UtmZone::of(place.lon, place.lat));
        [Self::Crs84, Self::WebMercator].into_iter().chain(zone.map(Self::Utm)).collect()
    }

    /// Its code in the EPSG registry; none for CRS84, which is EPSG:4326 with the longitude first.
    #[must_use]
    pub const fn epsg(self) -> Option<u32> {
        match self {
            Self::Crs84 => None,
            Self::WebMercator => Some(3857),
            Self::Utm(zone) => Some(zone.epsg()),
        }
    }
}
