//! Shapes that several resources share.

use serde::{Deserialize, Serialize};
use stillage_core::analysis::Diagnostic;
use utoipa::ToSchema;

use crate::app::StageReport;
use crate::coordinates::Georeference;
use crate::http::problem::Problem;

/// A remark on something that is valid but may surprise.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Diagnostic)]
pub struct DiagnosticView {
    /// Stable, for programs.
    #[schema(example = "no-orientation")]
    code: String,
    /// For people: what it is, and how to mend it.
    message: String,
}

impl From<&Diagnostic> for DiagnosticView {
    fn from(diagnostic: &Diagnostic) -> Self {
        Self { code: diagnostic.code.clone(), message: diagnostic.message.clone() }
    }
}

/// What a stage of an analysis cost.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = StageReport)]
#[serde(rename_all = "camelCase")]
pub struct StageView {
    /// Name of the stage.
    #[schema(example = "radiography")]
    name: String,
    /// Wall-clock seconds.
    wall_s: f64,
    /// CPU seconds of the process.
    cpu_s: f64,
}

impl From<&StageReport> for StageView {
    fn from(report: &StageReport) -> Self {
        Self { name: report.name.clone(), wall_s: report.wall_s, cpu_s: report.cpu_s }
    }
}

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
    /// 422 for numbers that are no place on Earth; the pointers start at `pointer`.
    pub fn check(self, pointer: &str) -> Result<Option<Georeference>, Problem> {
        // Web Mercator ends at 85.05 degrees.
        for (name, value, limit) in
            [("lon", self.lon, 180.0), ("lat", self.lat, 85.0), ("heading", self.heading, 360.0)]
        {
            if !(-limit..=limit).contains(&value) {
                let detail = format!("{value} is outside -{limit} to {limit}");
                return Err(Problem::invalid(format!("{pointer}/{name}"), detail));
            }
        }
        let surveyed = self.status == GeoreferenceStatus::Surveyed;
        Ok(surveyed.then_some(Georeference { lon: self.lon, lat: self.lat, heading: self.heading }))
    }
}

/// Cuts a list that was asked for with one entry more than the page holds; the last entry left is where the next page
/// begins.
#[must_use]
pub fn cut<T>(mut entries: Vec<T>, limit: u32) -> (Vec<T>, bool) {
    let more = entries.len() > limit as usize;
    entries.truncate(limit as usize);
    (entries, more)
}
