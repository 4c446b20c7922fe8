//! Where a map lies on Earth.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::coordinates::{Georeference, OutOfRange};

/// Where a map lies on Earth.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, ToSchema)]
#[schema(as = Georeference)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct GeoreferenceView {
    /// Whether somebody surveyed it. A nominal map lies at (0, 0), where metres of EPSG:3857 are those of the map frame.
    #[serde(default)]
    status: GeoreferenceStatus,
    /// Longitude of the map frame's origin, degrees.
    #[schema(minimum = -180, maximum = 180, example = 12.858)]
    lon: f64,
    /// Latitude of the map frame's origin, degrees.
    #[schema(minimum = -85, maximum = 85, example = 56.663)]
    lat: f64,
    /// Compass heading of the map frame's y axis, degrees clockwise from north.
    #[serde(default)]
    #[schema(minimum = -360, maximum = 360, example = 0.0)]
    heading: f64,
}

/// Whether somebody surveyed where a map lies.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum GeoreferenceStatus {
    /// Nobody did: the map lies at (0, 0).
    Nominal,
    /// Somebody did.
    #[default]
    Surveyed,
}

impl GeoreferenceView {
    /// The georeference of a map, which is nominal when there is none.
    #[must_use]
    pub fn of(georeference: Option<Georeference>) -> Self {
        match georeference {
            Some(Georeference { lon, lat, heading }) => {
                Self { status: GeoreferenceStatus::Surveyed, lon, lat, heading }
            }
            None => Self { status: GeoreferenceStatus::Nominal, lon: 0.0, lat: 0.0, heading: 0.0 },
        }
    }

    /// What is to be stored: nothing for a nominal one.
    ///
    /// # Errors
    /// The member that is no place on Earth.
    pub fn read(self) -> Result<Option<Georeference>, OutOfRange> {
        let georeference = Georeference { lon: self.lon, lat: self.lat, heading: self.heading };
        georeference.check()?;
        Ok((self.status == GeoreferenceStatus::Surveyed).then_some(georeference))
    }
}
