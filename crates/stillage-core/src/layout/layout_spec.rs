//! How locations are cut and numbered.

use super::code_template::CodeTemplate;
use super::layout_options::LayoutOptions;
use crate::geometry::{Point, RigidMotion};
use crate::lane_rule::LaneRule;
use crate::spec::{AnalysisOptions, VehicleWidth};

/// Half the width of a vehicle where nobody says how wide it is, metres: the narrow side of a EUR pallet (0.8 m, EN
/// 13698-1), which pallet trucks and small mobile robots do not exceed.
const VEHICLE_RADIUS_M: f64 = 0.4;

/// How locations are cut, numbered and approached.
#[derive(Debug, Clone, PartialEq)]
pub struct LayoutSpec {
    /// How codes are written.
    pub code: CodeTemplate,
    /// Where people and goods come in, grid frame: aisles are counted from there, and begin at the end that is nearer
    /// to it. Without it, they are counted from the bottom or the left of the map and point right or up.
    pub entrance: Option<Point>,
    /// Width of one load, metres: locations that have room for more are cut into places of about this width.
    pub place_width: Option<f64>,
    /// Half the width of the vehicles that serve the locations, metres.
    pub vehicle_radius: f64,
    /// Rules about the navigation graph, grid frame.
    pub lane_rules: Vec<LaneRule>,
}

impl LayoutSpec {
    /// What holds where nobody asks for anything else.
    #[must_use]
    pub fn of(options: &AnalysisOptions) -> Self {
        let vehicle_radius = match options.decomposition.vehicle_width_m {
            VehicleWidth::Fixed(width) => width / 2.0,
            VehicleWidth::Auto => VEHICLE_RADIUS_M,
        };
        Self {
            code: CodeTemplate::default(),
            entrance: None,
            place_width: None,
            vehicle_radius,
            lane_rules: Vec::new(),
        }
    }

    /// What people wish, and what follows from the analysis where they wish nothing. `to_grid` leads from the frame of the
    /// site to the grid frame.
    #[must_use]
    pub fn wished(wish: &LayoutOptions, options: &AnalysisOptions, to_grid: &RigidMotion) -> Self {
        Self {
            code: wish.code_template.clone(),
            entrance: wish.entrance.map(|entrance| to_grid.apply(entrance)),
            place_width: wish.place_width_m,
            vehicle_radius: wish.vehicle_radius_m.unwrap_or_else(|| Self::of(options).vehicle_radius),
            lane_rules: wish.lane_rules.iter().map(|rule| rule.moved(to_grid)).collect(),
        }
    }
}
