//! How locations are to be cut and numbered.

use serde::{Deserialize, Serialize};
use stillage_core::Point;
use stillage_core::geometry::RigidMotion;
use stillage_core::lane_rule::LaneRule;
use stillage_core::layout::{CodeTemplate, LayoutOptions};
use utoipa::ToSchema;

use crate::features::rounded;

/// Rules about the navigation graph at most.
const MOST_RULES: usize = 1_000;

/// How locations are cut and numbered. What is absent follows from the analysis.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = LayoutOptions)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct LayoutView {
    /// How codes are written: text with `{aisle}`, `{bay}`, `{row}`, `{depth}` and `{side}` (`L` or `R`), numbers with their
    /// least width after a colon. It names the bay, and the aisle or the row. Codes have at most 18 characters.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(example = "{aisle:02}-{bay:03}")]
    code_template: Option<String>,
    /// Where people and goods come in, x and y, metres of the map frame: aisles are counted from there, and begin at the
    /// end that is nearer to it. From the bottom or the left of the map when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    entrance: Option<[f64; 2]>,
    /// Width of one load, metres: locations that have room for more are cut into places of about this width.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(minimum = 0.1, maximum = 20)]
    place_width_m: Option<f64>,
    /// Half the width of the vehicles that serve the locations, metres; half the vehicle width of the analysis when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(minimum = 0.05, maximum = 10)]
    vehicle_radius_m: Option<f64>,
    /// Rules about the navigation graph. Nodes and lanes are named by where they lie, so rules outlive analyses and scans.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(max_items = 1000)]
    lane_rules: Option<Vec<LaneRuleView>>,
}

/// A rule about a node or a lane of the navigation graph. Places are x and y, metres of the map frame, within
/// 1 m of the node or the lane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = LaneRule)]
#[serde(tag = "rule", deny_unknown_fields, rename_all = "kebab-case")]
pub enum LaneRuleView {
    /// No vehicle drives over a node.
    #[schema(title = "NoNode")]
    NoNode {
        /// Where it lies.
        #[schema(example = json!([3.5, 4.0]))]
        at: [f64; 2],
    },
    /// No vehicle drives over a lane.
    #[schema(title = "NoLane")]
    NoLane {
        /// A place on it.
        #[schema(example = json!([3.5, 4.0]))]
        from: [f64; 2],
        /// Another one.
        #[schema(example = json!([5.0, 4.0]))]
        to: [f64; 2],
    },
    /// Vehicles drive over a lane in one direction only.
    #[schema(title = "OneWay")]
    OneWay {
        /// A place on it.
        #[schema(example = json!([3.5, 4.0]))]
        from: [f64; 2],
        /// A place further on.
        #[schema(example = json!([5.0, 4.0]))]
        to: [f64; 2],
    },
}

impl LaneRuleView {
    fn new(rule: &LaneRule, to_site: &RigidMotion) -> Self {
        let at = |point: Point| seen(point, to_site);
        match *rule {
            LaneRule::NoNode { at: place } => Self::NoNode { at: at(place) },
            LaneRule::NoLane { from, to } => Self::NoLane { from: at(from), to: at(to) },
            LaneRule::OneWay { from, to } => Self::OneWay { from: at(from), to: at(to) },
        }
    }

    fn read(&self, to_site: &RigidMotion) -> LaneRule {
        let at = |place: [f64; 2]| to_site.apply(Point::from(place));
        match *self {
            Self::NoNode { at: place } => LaneRule::NoNode { at: at(place) },
            Self::NoLane { from, to } => LaneRule::NoLane { from: at(from), to: at(to) },
            Self::OneWay { from, to } => LaneRule::OneWay { from: at(from), to: at(to) },
        }
    }
}

/// A member that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnusableLayout {
    /// JSON pointer into the layout.
    pub pointer: &'static str,
    /// What is wrong, and what would do.
    pub detail: String,
}

impl LayoutView {
    /// A layout as people see it, in the frame of a map that `to_site` carries to that of its site.
    #[must_use]
    pub fn new(options: &LayoutOptions, to_site: &RigidMotion) -> Self {
        let lane_rules: Vec<LaneRuleView> =
            options.lane_rules.iter().map(|rule| LaneRuleView::new(rule, to_site)).collect();
        Self {
            code_template: Some(options.code_template.as_str().to_owned()),
            entrance: options.entrance.map(|entrance| seen(entrance, to_site)),
            place_width_m: options.place_width_m,
            vehicle_radius_m: options.vehicle_radius_m,
            lane_rules: Some(lane_rules).filter(|rules| !rules.is_empty()),
        }
    }

    /// The entrance, metres of the map frame.
    #[must_use]
    pub const fn entrance(&self) -> Option<[f64; 2]> {
        self.entrance
    }

    /// The rules that are wished. Those that were read from the ones in force stay exactly what they were.
    fn lane_rules(&self, in_force: &LayoutOptions, to_site: &RigidMotion) -> Result<Vec<LaneRule>, UnusableLayout> {
        let rules = self.lane_rules.as_deref().unwrap_or_default();
        if rules.len() > MOST_RULES {
            let detail = format!("{} rules: give {MOST_RULES} at most", rules.len());
            return Err(UnusableLayout { pointer: "/laneRules", detail });
        }
        let kept =
            |given: &LaneRuleView| in_force.lane_rules.iter().find(|rule| LaneRuleView::new(rule, to_site) == *given);
        Ok(rules.iter().map(|given| kept(given).copied().unwrap_or_else(|| given.read(to_site))).collect())
    }

    /// The layout that is wished. An entrance that was read from the one in force stays exactly what it was.
    ///
    /// # Errors
    /// The first member that cannot be used.
    pub fn read(&self, in_force: &LayoutOptions, to_site: &RigidMotion) -> Result<LayoutOptions, UnusableLayout> {
        let code_template =
            self.code_template.as_deref().map_or_else(|| Ok(CodeTemplate::default()), CodeTemplate::parse);
        let code_template = code_template.map_err(|problem| UnusableLayout {
            pointer: "/codeTemplate",
            detail: format!(
                "{problem}. A template is text with {{aisle}}, {{bay}}, {{row}}, {{depth}} or {{side}} in it, for example \
                 {{aisle:02}}-{{bay:03}}"
            ),
        })?;
        let entrance = self.entrance.map(|given| {
            let kept = in_force.entrance.filter(|&kept| seen(kept, to_site) == given);
            kept.unwrap_or_else(|| to_site.apply(Point::from(given)))
        });
        let options = LayoutOptions {
            code_template,
            entrance,
            place_width_m: self.place_width_m,
            vehicle_radius_m: self.vehicle_radius_m,
            lane_rules: self.lane_rules(in_force, to_site)?,
        };
        let first = options.check().err().and_then(|problems| problems.into_iter().next());
        match first {
            None => Ok(options),
            Some(problem) => Err(UnusableLayout { pointer: problem.pointer, detail: problem.message }),
        }
    }
}

/// A place in the map frame, as it is told.
fn seen(place: Point, to_site: &RigidMotion) -> [f64; 2] {
    let place = to_site.inverse().apply(place);
    [rounded(place.x), rounded(place.y)]
}
