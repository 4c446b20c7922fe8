//! What people wish of a layout.

use serde::{Deserialize, Serialize};

use super::code_template::CodeTemplate;
use crate::geometry::Point;
use crate::lane_rule::LaneRule;
use crate::spec::OptionProblem;

/// Widths of a load, metres: from a small bin to a long pallet of several loads.
const PLACE_WIDTHS_M: [f64; 2] = [0.1, 20.0];
/// Radii of a vehicle, metres: no aisle of a warehouse is as wide as the greatest.
const VEHICLE_RADII_M: [f64; 2] = [0.05, 10.0];

/// How the locations of a site are to be cut and numbered. What is absent follows from the analysis.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct LayoutOptions {
    /// How codes are written.
    pub code_template: CodeTemplate,
    /// Where people and goods come in, in the frame of the site, metres.
    pub entrance: Option<Point>,
    /// Width of one load, metres.
    pub place_width_m: Option<f64>,
    /// Half the width of the vehicles that serve the locations, metres.
    pub vehicle_radius_m: Option<f64>,
    /// Rules about the navigation graph, in the frame of the site.
    pub lane_rules: Vec<LaneRule>,
}

impl LayoutOptions {
    /// Checks every option against its range.
    ///
    /// # Errors
    /// One problem for each option out of range, with its JSON pointer.
    pub fn check(&self) -> Result<(), Vec<OptionProblem>> {
        let within = |pointer, value: Option<f64>, [low, high]: [f64; 2]| {
            let value = value.filter(|value| !(low..=high).contains(value))?;
            Some(OptionProblem { pointer, message: format!("{value} is outside {low} to {high} m") })
        };
        let is_number = self.entrance.is_none_or(|entrance| entrance.iter().all(|value| value.is_finite()));
        let problems: Vec<OptionProblem> = [
            (!is_number)
                .then(|| OptionProblem { pointer: "/entrance", message: "must be x and y in metres".to_owned() }),
            within("/placeWidthM", self.place_width_m, PLACE_WIDTHS_M),
            within("/vehicleRadiusM", self.vehicle_radius_m, VEHICLE_RADII_M),
        ]
        .into_iter()
        .flatten()
        .collect();
        if problems.is_empty() { Ok(()) } else { Err(problems) }
    }

    /// What decides how places are counted, as a text; empty for the defaults. A site whose numbering changes gets new
    /// codes.
    #[must_use]
    pub fn numbering(&self) -> String {
        let Self { code_template, entrance, place_width_m, vehicle_radius_m: _, lane_rules: _ } = self;
        if (code_template, entrance, place_width_m) == (&CodeTemplate::default(), &None, &None) {
            return String::new();
        }
        let entrance = entrance.map_or_else(String::new, |entrance| format!(" from {},{}", entrance.x, entrance.y));
        let width = place_width_m.map_or_else(String::new, |width| format!(" each {width}"));
        format!("{}{entrance}{width}", code_template.as_str())
    }
}
