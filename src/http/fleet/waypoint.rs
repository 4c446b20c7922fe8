//! Ends of routes as clients name them.

use serde::Deserialize;
use stillage_core::Point;
use stillage_core::arrangement::FaceId;
use stillage_core::routing::Waypoint;
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{ObjectBuilder, Schema, Type};
use utoipa::{PartialSchema, ToSchema};

use crate::app::MapContext;
use crate::coordinates::Transform;
use crate::http::problem::Problem;

/// What an end looks like.
const PATTERN: &str =
    "^(face:[0-9]{1,9}|place:[0-9]{1,9}|location:.+|-?[0-9]{1,9}([.][0-9]+)?,-?[0-9]{1,9}([.][0-9]+)?)$";

/// `x,y`, `face:ID`, `place:ID` or `location:CODE`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "String")]
pub enum End {
    /// x and y in the coordinates of the request.
    Position([f64; 2]),
    /// A face by its id.
    Face(u32),
    /// A place by its id: its largest drivable face.
    Place(u32),
    /// A location by its code.
    Location(String),
}

impl PartialSchema for End {
    fn schema() -> RefOr<Schema> {
        ObjectBuilder::new().schema_type(Type::String).pattern(Some(PATTERN)).examples(["location:01-002"]).into()
    }
}

impl ToSchema for End {}

impl TryFrom<String> for End {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        if let Some(code) = text.strip_prefix("location:") {
            return Ok(Self::Location(code.to_owned()));
        }
        if let Some(face) = text.strip_prefix("face:") {
            return face.parse().map(Self::Face).map_err(|_| "must name a face by its number, like face:3");
        }
        if let Some(place) = text.strip_prefix("place:") {
            return place.parse().map(Self::Place).map_err(|_| "must name a place by its number, like place:3");
        }
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let position = text.split_once(',').and_then(|(x, y)| Some([number(x)?, number(y)?]));
        position.map(Self::Position).ok_or("must be x,y or face:ID or place:ID or location:CODE")
    }
}

impl End {
    /// The waypoint in the map.
    pub fn waypoint<'a>(&self, context: &'a MapContext, transform: &Transform) -> Result<Waypoint<'a>, Problem> {
        match self {
            Self::Position(position) => Ok(Waypoint::Point(grid_point(context, transform, *position))),
            Self::Face(face) if (1..context.analysis.subdivision.face_count()).contains(&(*face as usize)) => {
                Ok(Waypoint::Face(FaceId(*face)))
            }
            Self::Face(face) => Err(Problem::not_found(format!("there is no face {face}"))),
            Self::Place(place) => place_of(context, *place).map(Waypoint::Face),
            Self::Location(code) => {
                let locations = &context.layout.locations;
                let found = locations.iter().find(|location| location.code == *code);
                found.map(Waypoint::Location).ok_or_else(|| no_location(context, code))
            }
        }
    }
}

/// A position of a request in the grid frame.
fn grid_point(context: &MapContext, transform: &Transform, position: [f64; 2]) -> Point {
    context.analysis.frame.to_grid(transform.inverse(position))
}

/// The largest drivable face of a place; the largest of all where none is drivable.
fn place_of(context: &MapContext, place: u32) -> Result<FaceId, Problem> {
    let found = context.semantic.places.get(place as usize);
    let faces = found.map(|place| place.faces.as_slice()).unwrap_or_default();
    let rank = |face: &FaceId| (context.semantic.label(*face).is_drivable(), context.analysis.faces[face.index()].area);
    let largest = faces.iter().max_by(|one, other| {
        let (one, other) = (rank(one), rank(other));
        one.0.cmp(&other.0).then(one.1.total_cmp(&other.1))
    });
    largest.copied().ok_or_else(|| Problem::not_found(format!("there is no place {place}")))
}

/// There is no such code; the one that begins most alike is named.
fn no_location(context: &MapContext, code: &str) -> Problem {
    let alike = |other: &str| other.chars().zip(code.chars()).take_while(|(one, other)| one == other).count();
    let codes = context.layout.locations.iter().map(|location| location.code.as_str());
    let nearest = codes.max_by_key(|other| alike(other));
    Problem::not_found(match nearest {
        Some(nearest) => format!("there is no location {code}; there is {nearest}, for example"),
        None => format!("there is no location {code}: the map has no storage locations"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_positions_faces_places_or_locations() {
        let end = |text: &str| End::try_from(text.to_owned()).ok();
        assert_eq!(end("1.5,-2"), Some(End::Position([1.5, -2.0])));
        assert_eq!(end("face:3"), Some(End::Face(3)));
        assert_eq!(end("place:0"), Some(End::Place(0)));
        assert_eq!(end("location:01-002"), Some(End::Location("01-002".to_owned())));
        for wrong in ["", "1", "1,2,3", "x,y", "NaN,0", "face:x", "face:-1", "room:3"] {
            assert_eq!(end(wrong), None, "{wrong}");
        }
    }
}
