//! The vehicle that a route is for, and what the route should be like.

use serde::Deserialize;
use stillage_core::arrangement::{EdgeId, FaceId};
use stillage_core::layout::LayoutSpec;
use stillage_core::routing::{Blocked, Preferences, RouteProfile, SpeedProfile};
use utoipa::ToSchema;

use crate::app::MapContext;
use crate::http::problem::Problem;

/// Greatest radius of a vehicle, metres: no aisle of a warehouse is as wide.
const WIDEST_RADIUS_M: f64 = 10.0;

/// What makes a route the best.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum ProfileName {
    /// The least length.
    #[default]
    Shortest,
    /// Distance from obstacles, where that costs no long way around.
    Clearance,
}

/// The radius of the vehicle of a request, metres: given, or that around its outline, or half the width that the analysis
/// was made for.
pub fn radius(context: &MapContext, given: Option<f64>, outline: Option<&Numbers>) -> Result<f64, Problem> {
    let around = outline.map(|outline| outline_radius(&outline.0)).transpose()?;
    if given.is_some() && around.is_some() {
        return Err(Problem::parameter("footprint", "stands beside footprintRadiusM: give one of them"));
    }
    match given.or(around) {
        None => Ok(LayoutSpec::of(&context.analysis.options).vehicle_radius),
        Some(radius) if (0.0..=WIDEST_RADIUS_M).contains(&radius) => Ok(radius),
        Some(radius) => {
            let detail = format!("{radius} is outside 0 to {WIDEST_RADIUS_M} m");
            Err(Problem::parameter(if around.is_some() { "footprint" } else { "footprintRadiusM" }, detail))
        }
    }
}

/// The radius of the circle around an outline: what a vehicle needs to turn on the spot.
fn outline_radius(numbers: &[f64]) -> Result<f64, Problem> {
    if numbers.len() < 6 || !numbers.len().is_multiple_of(2) {
        let detail = "must be x,y of at least three corners in metres, x forwards from the middle of the vehicle";
        return Err(Problem::parameter("footprint", detail));
    }
    Ok(numbers.chunks(2).map(|corner| corner[0].hypot(corner[1])).fold(0.0, f64::max))
}

/// Numbers with commas between them.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(try_from = "String")]
pub struct Numbers(pub Vec<f64>);

impl TryFrom<String> for Numbers {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
        numbers.map(Self).ok_or("must be numbers with commas between them")
    }
}

/// Ids with commas between them.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(try_from = "String")]
pub struct Ids(pub Vec<u32>);

impl TryFrom<String> for Ids {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let ids: Option<Vec<u32>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
        ids.map(Self).ok_or("must be ids with commas between them, like 3,17")
    }
}

/// Factors by label: `label:factor` with commas between them.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(try_from = "String")]
pub struct LabelCosts(pub Vec<(String, f64)>);

impl TryFrom<String> for LabelCosts {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let cost = |part: &str| {
            let (label, factor) = part.split_once(':')?;
            let factor = factor.trim().parse::<f64>().ok().filter(|factor| (1.0..=1000.0).contains(factor))?;
            Some((label.trim().to_owned(), factor))
        };
        let costs: Option<Vec<_>> = text.split(',').map(cost).collect();
        costs.map(Self).ok_or("must be labels with factors from 1 to 1000, like ju:2,ro:5")
    }
}

/// What a route should be like.
pub fn preferences(context: &MapContext, profile: ProfileName, costs: &LabelCosts) -> Result<Preferences, Problem> {
    let rule_set = &context.semantic.rule_set;
    let mut label_costs = vec![1.0; rule_set.labels().len()];
    for (id, factor) in &costs.0 {
        let label = rule_set.find(id).ok_or_else(|| {
            let known: Vec<&str> = rule_set.labels().iter().map(|label| label.id.as_str()).collect();
            Problem::parameter("labelCosts", format!("no label has the id {id}; there are {}", known.join(", ")))
        })?;
        label_costs[usize::from(label.0)] = *factor;
    }
    let profile = match profile {
        ProfileName::Shortest => RouteProfile::Shortest,
        ProfileName::Clearance => RouteProfile::Clearance,
    };
    Ok(Preferences { profile, label_costs })
}

/// What a route must keep off.
pub fn blocked(context: &MapContext, faces: &[u32], edges: &[u32]) -> Result<Blocked, Problem> {
    let subdivision = &context.analysis.subdivision;
    let is_face = |face: &u32| (1..subdivision.face_count()).contains(&(*face as usize));
    if let Some(face) = faces.iter().find(|face| !is_face(face)) {
        return Err(Problem::parameter("blockedFaces", format!("there is no face {face}")));
    }
    if let Some(edge) = edges.iter().find(|&&edge| edge as usize >= subdivision.edge_count()) {
        return Err(Problem::parameter("blockedEdges", format!("there is no edge {edge}")));
    }
    Ok(Blocked {
        faces: faces.iter().copied().map(FaceId).collect(),
        edges: edges.iter().copied().map(EdgeId).collect(),
    })
}

/// How the vehicle drives.
pub fn speeds(
    speed: Option<f64>,
    acceleration: Option<f64>,
    turn_rate_deg: Option<f64>,
) -> Result<SpeedProfile, Problem> {
    let usual = SpeedProfile::default();
    let checked = |name: &str, value: Option<f64>, usual: f64, highest: f64| match value {
        None => Ok(usual),
        Some(value) if value > 0.0 && value <= highest => Ok(value),
        Some(value) => Err(Problem::parameter(name, format!("{value} is not above 0 and up to {highest}"))),
    };
    Ok(SpeedProfile {
        speed: checked("speedMps", speed, usual.speed, 20.0)?,
        acceleration: checked("accelerationMps2", acceleration, usual.acceleration, 20.0)?,
        turn_rate: checked("turnRateDegps", turn_rate_deg, usual.turn_rate.to_degrees(), 720.0)?.to_radians(),
    })
}
