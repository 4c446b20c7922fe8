//! Ends of routes as clients name them.

use serde::Deserialize;
use stillage_core::Point;
use stillage_core::arrangement::FaceId;
use stillage_core::registry::AreaKind;
use stillage_core::routing::Waypoint;
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{ObjectBuilder, Schema, Type};
use utoipa::{PartialSchema, ToSchema};

use super::outside::did_you_mean_crs;
use crate::app::{MapContext, Nameable};
use crate::coordinates::Transform;
use crate::did_you_mean::did_you_mean;
use crate::http::problem::{Problem, ProblemType};

/// What an end looks like.
const PATTERN: &str =
    "^(face:[0-9]{1,9}|place:[0-9]{1,9}|location:.+|name:.+|-?[0-9]{1,9}([.][0-9]+)?,-?[0-9]{1,9}([.][0-9]+)?)$";

/// `x,y`, `face:ID`, `place:ID`, `location:CODE` or `name:NAME`.
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
    /// A location, place, aisle or row by the name that people gave it.
    Name(String),
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
        if let Some(name) = text.strip_prefix("name:") {
            return Ok(Self::Name(name.trim().to_owned()));
        }
        if let Some(face) = text.strip_prefix("face:") {
            return face.parse().map(Self::Face).map_err(|_| "must name a face by its number, like face:3");
        }
        if let Some(place) = text.strip_prefix("place:") {
            return place.parse().map(Self::Place).map_err(|_| "must name a place by its number, like place:3");
        }
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let position = text.split_once(',').and_then(|(x, y)| Some([number(x)?, number(y)?]));
        position.map(Self::Position).ok_or("must be x,y or face:ID or place:ID or location:CODE or name:NAME")
    }
}

impl End {
    /// The waypoint in the map.
    pub fn waypoint<'a>(&self, context: &'a MapContext, transform: &Transform) -> Result<Waypoint<'a>, Problem> {
        match self {
            Self::Position([x, y]) => match did_you_mean_crs(context, transform, [*x, *y]) {
                None => Ok(Waypoint::Point(grid_point(context, transform, [*x, *y]))),
                Some(hint) => {
                    Err(Problem::new(ProblemType::RouteOutside, format!("{x},{y} is outside the map; {hint}")))
                }
            },
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
            Self::Name(name) => named(context, name),
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

/// There is no such code; those most like it are named.
fn no_location(context: &MapContext, code: &str) -> Problem {
    let codes = context.layout.locations.iter().map(|location| location.code.as_str());
    Problem::not_found(match did_you_mean(code, codes) {
        Some(near) => format!("there is no location {code}: did you mean {near}?"),
        None => format!("there is no location {code}: the map has no storage locations"),
    })
}

/// What has a name, if only one thing has it.
fn named<'a>(context: &'a MapContext, name: &str) -> Result<Waypoint<'a>, Problem> {
    let found = context.find_name(name);
    let &[what] = found.as_slice() else {
        let names = context.names.all().map(|(_, naming)| naming).filter_map(|naming| naming.name.as_deref());
        return Err(Problem::not_found(match found.as_slice() {
            [] => match did_you_mean(name, names) {
                Some(near) => format!("nothing is named {name}: did you mean {near}?"),
                None => format!("nothing is named {name}: nothing in the map has a name yet"),
            },
            several => {
                let ends = several.iter().map(|&what| end_of(context, what)).collect::<Vec<_>>();
                format!("{} things are named {name}: choose one of {}", several.len(), ends.join(", "))
            }
        }));
    };
    let layout = &context.layout;
    Ok(match what {
        Nameable::Location(index) => Waypoint::Location(&layout.locations[index]),
        Nameable::Area(AreaKind::Place, index) => Waypoint::Face(place_of(context, index as u32)?),
        Nameable::Area(AreaKind::Aisle, index) => {
            let [start, end] = layout.aisles[index].center_line;
            Waypoint::Point(middle(start, end))
        }
        Nameable::Area(AreaKind::Row, index) => {
            let locations = &layout.rows[index].locations;
            Waypoint::Location(&layout.locations[locations[locations.len() / 2]])
        }
    })
}

/// The middle between two points.
fn middle(start: Point, end: Point) -> Point {
    start + (end - start) / 2.0
}

/// How an end names something without its name: places by their id, the rest by a location of it.
fn end_of(context: &MapContext, what: Nameable) -> String {
    let locations = &context.layout.locations;
    let first = |indices: &[usize]| indices.first().map(|&index| format!("location:{}", locations[index].code));
    let end = match what {
        Nameable::Location(index) => first(&[index]),
        Nameable::Area(AreaKind::Place, index) => Some(format!("place:{index}")),
        Nameable::Area(AreaKind::Aisle, index) => {
            let aisle = &context.layout.aisles[index];
            first(&aisle.left).or_else(|| first(&aisle.right))
        }
        Nameable::Area(AreaKind::Row, index) => first(&context.layout.rows[index].locations),
    };
    end.unwrap_or_default()
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
        assert_eq!(end("name:Gate, left"), Some(End::Name("Gate, left".to_owned())));
        for wrong in ["", "1", "1,2,3", "x,y", "NaN,0", "face:x", "face:-1", "room:3"] {
            assert_eq!(end(wrong), None, "{wrong}");
        }
    }
}
