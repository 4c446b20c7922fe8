//! Why there is no route, as a problem detail: what, where, and what would do.

use stillage_core::Point;
use stillage_core::routing::{EndGround, NoRoute};

use crate::app::MapContext;
use crate::coordinates::Transform;
use crate::http::problem::{Problem, ProblemType};

/// Where the reason lies, or what would do instead, in the grid frame.
fn position(reason: &NoRoute) -> Option<Point> {
    match reason {
        NoRoute::CannotStand { nearest, .. } | NoRoute::NotDrivable { nearest, .. } => *nearest,
        NoRoute::TooNarrow { at, .. } | NoRoute::CannotTurn { at, .. } => Some(*at),
        NoRoute::NoApproach { .. } | NoRoute::EndBlocked { .. } | NoRoute::CutOff | NoRoute::Disconnected { .. } => {
            None
        }
    }
}

/// The problem detail; points are told in the coordinates of the request. `radius` is that of the vehicle, metres.
pub fn problem(reason: &NoRoute, context: &MapContext, transform: &Transform, radius: f64) -> Problem {
    let place = |point: Point| {
        let [x, y] = transform.readable(context.analysis.frame.to_map(point));
        format!("{x},{y}")
    };
    let instead = |nearest: &Option<Point>| match nearest {
        Some(point) => format!("; {} would do", place(*point)),
        None => "; no point within 5 m would do".to_owned(),
    };
    let (kind, detail) = match reason {
        NoRoute::CannotStand { end, ground, nearest } => {
            let instead = instead(nearest);
            match ground {
                EndGround::Outside => (ProblemType::RouteOutside, format!("the {end} lies outside the map{instead}")),
                EndGround::Occupied => (ProblemType::RouteBlocked, format!("the {end} lies on an obstacle{instead}")),
                EndGround::Unknown => {
                    (ProblemType::RouteBlocked, format!("the {end} lies on ground that was never seen{instead}"))
                }
                EndGround::Narrow(clearance) => (
                    ProblemType::RouteTooNarrow,
                    format!(
                        "at the {end} an obstacle is {clearance:.2} m away, and the vehicle needs {radius:.2} m{instead}"
                    ),
                ),
            }
        }
        NoRoute::NotDrivable { end, face, label, nearest } => (
            ProblemType::RouteNotDrivable,
            format!("the {end} lies in face {face}, which is labelled {label} and not drivable{}", instead(nearest)),
        ),
        NoRoute::NoApproach { end, code } => (
            ProblemType::RouteNoAccess,
            format!("a vehicle that needs {radius:.2} m to each side cannot stand before location {code}, the {end}"),
        ),
        NoRoute::EndBlocked { end, face } => {
            (ProblemType::RouteCutOff, format!("the {end} lies in face {face}, which the request blocks"))
        }
        NoRoute::CutOff => {
            (ProblemType::RouteCutOff, "what the request blocks leaves no way; without it there is one".to_owned())
        }
        NoRoute::TooNarrow { clearance, at } => (
            ProblemType::RouteTooNarrow,
            format!(
                "the widest way is {:.2} m wide at {}, and the vehicle needs {:.2} m",
                2.0 * clearance,
                place(*at),
                2.0 * radius
            ),
        ),
        NoRoute::CannotTurn { at, clearance } => (
            ProblemType::RouteTooNarrow,
            format!(
                "the outline of the vehicle touches an obstacle at {}, which is {clearance:.2} m from its middle; it turns \
                 anywhere with {radius:.2} m",
                place(*at)
            ),
        ),
        NoRoute::Disconnected { from, to } if from == to => {
            (ProblemType::RouteDisconnected, format!("obstacles divide face {from} between the ends"))
        }
        NoRoute::Disconnected { from, to } => {
            (ProblemType::RouteDisconnected, format!("no drivable ground joins face {from} and face {to}"))
        }
    };
    Problem::new(kind, detail)
        .on_map(position(reason).map(|point| transform.readable(context.analysis.frame.to_map(point))))
}
