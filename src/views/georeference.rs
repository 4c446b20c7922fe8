//! Where a map lies on Earth.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::coordinates::{Georeference, OutOfRange, PointPair, Survey, SurveyProblem};
use crate::features::rounded;

/// Scale errors are told in millionths: a millimetre per kilometre.
const SCALE_STEPS: f64 = 1e6;

/// Where a map lies on Earth: `lon`, `lat` and `heading`, or three or more `pairs` of points to which they are fitted.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = Georeference)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct GeoreferenceView {
    /// Whether somebody surveyed it. A nominal map lies at (0, 0), where metres of EPSG:3857 are those of the map frame.
    #[serde(default)]
    status: GeoreferenceStatus,
    /// Longitude of the map frame's origin, degrees. Not needed, and not read, beside `pairs`.
    #[schema(value_type = f64, required = false, minimum = -180, maximum = 180, example = 12.858)]
    lon: Option<f64>,
    /// Latitude of the map frame's origin, degrees. Not needed, and not read, beside `pairs`.
    #[schema(value_type = f64, required = false, minimum = -85, maximum = 85, example = 56.663)]
    lat: Option<f64>,
    /// Compass heading of the map frame's y axis, degrees clockwise from north. Not read beside `pairs`.
    #[serde(default)]
    #[schema(minimum = -360, maximum = 360, example = 0.0)]
    heading: f64,
    /// Points that are known in the map and on Earth: three or more, far apart, not on one line.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schema(required = false)]
    pairs: Vec<PointPairView>,
    /// Root mean square of the residuals of the pairs, metres. Told, not read.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = f64, required = false)]
    residual_m: Option<f64>,
    /// How much longer distances on Earth are than in the map, as a share. Told, not read.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = f64, required = false)]
    scale_error: Option<f64>,
}

/// A point in the map and on Earth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = PointPair)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct PointPairView {
    /// x and y in the map frame, metres.
    #[schema(example = json!([12.5, 3.0]))]
    map: [f64; 2],
    /// Longitude and latitude, degrees.
    #[schema(example = json!([12.858, 56.663]))]
    lon_lat: [f64; 2],
    /// How far the georeference is off here, metres. Told, not read.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = f64, required = false)]
    residual_m: Option<f64>,
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

/// A member that cannot be used: its pointer below the georeference, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct UnusableMember {
    /// Like `/lat`, `/pairs/2` or nothing.
    pub pointer: String,
    /// What is wrong and what would do.
    pub detail: String,
}

impl From<OutOfRange> for UnusableMember {
    fn from(OutOfRange { member, detail }: OutOfRange) -> Self {
        Self { pointer: format!("/{member}"), detail }
    }
}

impl From<SurveyProblem> for UnusableMember {
    fn from(problem: SurveyProblem) -> Self {
        let pointer = problem.pair().map_or_else(|| "/pairs".to_owned(), |pair| format!("/pairs/{pair}"));
        Self { pointer, detail: problem.to_string() }
    }
}

impl GeoreferenceView {
    /// The georeference of a map, which is nominal when there is none.
    #[must_use]
    pub fn of(georeference: Option<Georeference>, pairs: &[PointPair]) -> Self {
        let Some(georeference) = georeference else {
            let status = GeoreferenceStatus::Nominal;
            return Self { status, lon: Some(0.0), lat: Some(0.0), ..Self::default() };
        };
        let Georeference { lon, lat, heading } = georeference;
        let told = Self { lon: Some(lon), lat: Some(lat), heading, ..Self::default() };
        if pairs.is_empty() {
            return told;
        }
        let fit = Survey { georeference, pairs: pairs.to_vec() }.fit();
        let pair = |(pair, residual): (&PointPair, &f64)| PointPairView {
            map: pair.map,
            lon_lat: pair.lon_lat,
            residual_m: Some(rounded(*residual)),
        };
        Self {
            pairs: pairs.iter().zip(&fit.residuals).map(pair).collect(),
            residual_m: Some(rounded(fit.rms)),
            scale_error: Some((fit.scale_error * SCALE_STEPS).round() / SCALE_STEPS),
            ..told
        }
    }

    /// What is to be stored: nothing for a nominal one.
    ///
    /// # Errors
    /// The member that is no place on Earth, or the pairs that give none.
    pub fn read(self) -> Result<Option<Survey>, UnusableMember> {
        if !self.pairs.is_empty() {
            let pairs = self.pairs.iter().map(|pair| PointPair { map: pair.map, lon_lat: pair.lon_lat }).collect();
            return Ok(Some(Survey::fitted(pairs)?));
        }
        let (Some(lon), Some(lat)) = (self.lon, self.lat) else {
            let detail = "give lon and lat (and heading), or three or more pairs of points".to_owned();
            return Err(UnusableMember { pointer: String::new(), detail });
        };
        let georeference = Georeference { lon, lat, heading: self.heading };
        georeference.check()?;
        Ok((self.status == GeoreferenceStatus::Surveyed).then(|| georeference.into()))
    }
}
