//! Where a map lies on Earth, in three numbers.

use serde::{Deserialize, Serialize};

/// Where the map frame lies on Earth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Georeference {
    /// Longitude of the map frame's origin, degrees.
    pub lon: f64,
    /// Latitude of the map frame's origin, degrees.
    pub lat: f64,
    /// Compass heading of the map frame's y axis, degrees clockwise from north.
    #[serde(default)]
    pub heading: f64,
}

/// A number of a [`Georeference`] that is no place on Earth.
#[derive(Debug, Clone, PartialEq)]
pub struct OutOfRange {
    /// The member: `lon`, `lat` or `heading`.
    pub member: &'static str,
    /// What it is, and what it may be.
    pub detail: String,
}

impl Georeference {
    /// Checks the ranges of its numbers, degrees.
    ///
    /// # Errors
    /// The first member outside its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        // Beyond 85 degrees the Web Mercator plane in which maps are drawn ends.
        for (member, value, limit) in
            [("lon", self.lon, 180.0), ("lat", self.lat, 85.0), ("heading", self.heading, 360.0)]
        {
            if !(-limit..=limit).contains(&value) {
                return Err(OutOfRange { member, detail: format!("{value} is outside -{limit} to {limit} degrees") });
            }
        }
        Ok(())
    }
}
