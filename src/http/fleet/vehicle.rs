//! The vehicle that a route is for, and what the route should be like.

use serde::Deserialize;
use stillage_core::Point;
use stillage_core::arrangement::{EdgeId, FaceId};
use stillage_core::routing::{Blocked, Preferences, RouteProfile, SpeedProfile, VehicleOutline};
use stillage_core::semantics::Label;
use utoipa::ToSchema;

use crate::app::MapContext;
use crate::features::words;
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

/// What of the vehicle must not touch anything.
#[derive(Debug, Clone)]
pub enum Footprint {
    /// A disc around its middle, by its radius in metres.
    Disc(f64),
    /// Its outline.
    Outline(VehicleOutline),
}

impl Footprint {
    /// The footprint of a request: as given, or that of the layout in force: half the width that the
    /// analysis was made for, unless people wish another.
    pub fn of(context: &MapContext, radius: Option<f64>, outline: Option<&Numbers>) -> Result<Self, Problem> {
        let checked = |name: &str, radius: f64| {
            let is_known = (0.0..=WIDEST_RADIUS_M).contains(&radius);
            let detail = || format!("{radius} is outside 0 to {WIDEST_RADIUS_M} m");
            if is_known { Ok(radius) } else { Err(Problem::parameter(name, detail())) }
        };
        match (radius, outline) {
            (Some(_), Some(_)) => {
                Err(Problem::parameter("footprint", "stands beside footprintRadiusM: give one of them"))
            }
            (Some(radius), None) => checked("footprintRadiusM", radius).map(Self::Disc),
            (None, Some(numbers)) => {
                let outline = outline_of(&numbers.0)?;
                checked("footprint", outline.turning_radius())?;
                Ok(Self::Outline(outline))
            }
            (None, None) => Ok(Self::Disc(context.layout_spec.vehicle_radius)),
        }
    }

    /// The radius of the circle around it, metres: what the vehicle needs to turn anywhere.
    pub fn turning_radius(&self) -> f64 {
        match self {
            Self::Disc(radius) => *radius,
            Self::Outline(outline) => outline.turning_radius(),
        }
    }
}

fn outline_of(numbers: &[f64]) -> Result<VehicleOutline, Problem> {
    let corners: Vec<Point> = numbers.chunks_exact(2).map(|corner| Point::new(corner[0], corner[1])).collect();
    let outline = numbers.len().is_multiple_of(2).then(|| VehicleOutline::new(&corners)).flatten();
    outline.ok_or_else(|| {
        let detail =
            "must be x,y of at least three corners in metres, x forwards, around the middle of the vehicle (0,0)";
        Problem::parameter("footprint", detail)
    })
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
    for (name, factor) in &costs.0 {
        let known = |label: &Label| {
            label.id == *name || label.functionality.iter().any(|one| words::functionality(*one) == name)
        };
        let mut is_known = false;
        for (cost, _) in label_costs.iter_mut().zip(rule_set.labels()).filter(|(_, label)| known(label)) {
            (*cost, is_known) = (f64::max(*cost, *factor), true);
        }
        if !is_known {
            let ids: Vec<&str> = rule_set.labels().iter().map(|label| label.id.as_str()).collect();
            let detail = format!("no label has the id or the functionality {name}; there are {}", ids.join(", "));
            return Err(Problem::parameter("labelCosts", detail));
        }
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
