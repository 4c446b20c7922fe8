//! What a request says of corrections.

use axum::http::HeaderMap;
use serde_json::{Map, Value};
use stillage_core::corrections::Correction;
use stillage_core::semantics::RuleSet;

use crate::app::{AppError, CorrectionId, FieldProblem, MapContext, WantedCorrection, check_corrections};
use crate::coordinates::Transform;
use crate::http::extract::{is_json, parse_json};
use crate::http::problem::{Problem, ProblemType};
use crate::ingest::{self, CorrectionFeature, IngestError};

/// What a read adds to a correction: it may be sent back and is ignored.
const READ_ONLY: [&str; 4] = ["id", "isApplied", "faces", "reason"];
/// What a read adds to the list, likewise.
const READ_ONLY_OF_LIST: [&str; 3] = ["version", "lost", "links"];
/// Problems that are told at most.
const MOST_TOLD: usize = 100;

/// New corrections of a request.
#[derive(Debug)]
pub struct NewCorrectionsBody {
    /// The corrections.
    pub corrections: Vec<Correction>,
    /// Where each stands in the request.
    places: Vec<CorrectionPlace>,
}

/// Where a correction stands in a request.
#[derive(Debug, Clone)]
enum CorrectionPlace {
    /// JSON pointer to the correction.
    Correction(String),
    /// JSON pointer to the feature that it was read from.
    Feature(String),
}

impl CorrectionPlace {
    /// A pointer into the correction, as one into the request.
    fn pointer(&self, within: &str) -> String {
        match self {
            Self::Correction(pointer) => format!("{pointer}{within}"),
            Self::Feature(pointer) => match within.split('/').nth(1) {
                None => pointer.clone(),
                Some("ring" | "line" | "at" | "rectangle") => format!("{pointer}/geometry"),
                Some(_) => format!("{pointer}/properties{within}"),
            },
        }
    }
}

impl NewCorrectionsBody {
    /// Reads one correction, `{"corrections": [...]}`, or GeoJSON.
    ///
    /// # Errors
    /// All that is wrong, with pointers into the body.
    pub fn read(bytes: &[u8], rule_set: &RuleSet, transform: &Transform) -> Result<Self, Problem> {
        let mut body: Map<String, Value> = parse_json("", bytes)?;
        if matches!(body.get("type").and_then(Value::as_str), Some("Feature" | "FeatureCollection")) {
            return Self::of_geojson(&Value::Object(body), rule_set, transform);
        }
        let Some(list) = body.remove("corrections") else {
            let corrections = vec![read_correction("", body)?];
            return Ok(Self { corrections, places: vec![CorrectionPlace::Correction(String::new())] });
        };
        if let Some(other) = body.keys().find(|name| !READ_ONLY_OF_LIST.contains(&name.as_str())) {
            return Err(Problem::invalid(format!("/{other}"), "is not known beside corrections"));
        }
        let list = objects(list)?;
        if list.is_empty() {
            return Err(Problem::invalid("/corrections", "name one correction or more"));
        }
        let places =
            (0..list.len()).map(|index| CorrectionPlace::Correction(format!("/corrections/{index}"))).collect();
        let corrections = all(list
            .into_iter()
            .enumerate()
            .map(|(index, correction)| read_correction(&format!("/corrections/{index}"), correction)))?;
        Ok(Self { corrections, places })
    }

    fn of_geojson(document: &Value, rule_set: &RuleSet, transform: &Transform) -> Result<Self, Problem> {
        let mut storage = rule_set.labels().iter().filter(|label| label.is_storage());
        let drawn_label = match (storage.next(), storage.next()) {
            (Some(label), None) => Some(label.id.as_str()),
            _ => None,
        };
        let features = ingest::correction_features(document, drawn_label, &|position| transform.inverse(position));
        let features = features.map_err(|errors| Problem::from(unreadable(errors)))?;
        let read = |CorrectionFeature { pointer, correction }: CorrectionFeature| {
            let place = CorrectionPlace::Feature(pointer);
            let correction = read_correction("", correction);
            let correction = correction.map_err(|problem| problem.map_pointers(|within| place.pointer(within)))?;
            Ok((correction, place))
        };
        let (corrections, places) = all(features.into_iter().map(read))?.into_iter().unzip();
        Ok(Self { corrections, places })
    }

    /// The list of a map with these at its end.
    pub fn after(self, context: &MapContext) -> (Vec<WantedCorrection>, impl Fn(&str) -> String + use<>) {
        let mut wanted = context.wanted_corrections();
        let known = wanted.len();
        wanted.extend(self.corrections.into_iter().map(|correction| (None, correction)));
        (wanted, in_request(self.places, known))
    }

    /// The corrections by themselves, as they would be the whole list of a map under a rule set.
    ///
    /// # Errors
    /// What makes no sense on any map, with pointers into the body.
    pub fn checked(self, rule_set: &RuleSet) -> Result<Vec<Correction>, Problem> {
        let Self { corrections, places } = self;
        let checked = check_corrections(corrections.iter().enumerate(), rule_set, usize::MAX);
        checked.map_err(|error| Problem::from(error).map_pointers(in_request(places, 0)))?;
        Ok(corrections)
    }
}

/// Leads a pointer into a list of corrections, of which so many were `known`, back to the request that named the others.
fn in_request(places: Vec<CorrectionPlace>, known: usize) -> impl Fn(&str) -> String {
    move |pointer| {
        let step = pointer.strip_prefix("/corrections/").map(|rest| rest.split_once('/').unwrap_or((rest, "")));
        let Some((index, within)) = step else { return pointer.to_owned() };
        let place = index.parse::<usize>().ok().and_then(|index| places.get(index.checked_sub(known)?));
        let within = if within.is_empty() { String::new() } else { format!("/{within}") };
        place.map_or_else(|| pointer.to_owned(), |place| place.pointer(&within))
    }
}

/// Whether a body can hold corrections.
///
/// # Errors
/// 415 where it is no JSON.
pub fn check_media_type(headers: &HeaderMap) -> Result<(), Problem> {
    if is_json(headers) {
        return Ok(());
    }
    let detail = "send application/json (corrections) or application/geo+json (shapes)";
    Err(Problem::new(ProblemType::UnsupportedMediaType, detail))
}

/// Reads the whole list of a map: corrections with an id are those that it has, the others are new.
///
/// # Errors
/// All that is wrong, with pointers into the body.
pub fn whole_list(list: Value) -> Result<Vec<WantedCorrection>, Problem> {
    let read = |(index, correction): (usize, Map<String, Value>)| {
        let pointer = format!("/corrections/{index}");
        let id = match correction.get("id") {
            None | Some(Value::Null) => None,
            Some(id) => Some(read_id(id).map_err(|detail| Problem::invalid(format!("{pointer}/id"), detail))?),
        };
        Ok((id, read_correction(&pointer, correction)?))
    };
    all(objects(list)?.into_iter().enumerate().map(read))
}

fn read_id(id: &Value) -> Result<CorrectionId, String> {
    id.as_str().unwrap_or_default().parse().map_err(|error| format!("{error}"))
}

/// A correction with the members of a merge patch (RFC 7396).
///
/// # Errors
/// What is wrong, with its pointer in the patch.
pub fn patched(correction: &Correction, patch: Map<String, Value>) -> Result<Correction, Problem> {
    let Ok(Value::Object(mut members)) = serde_json::to_value(correction) else { return Ok(correction.clone()) };
    for (name, value) in patch {
        if value.is_null() {
            members.remove(&name);
        } else {
            members.insert(name, value);
        }
    }
    read_correction("", members)
}

/// Reads a correction.
fn read_correction(pointer: &str, mut members: Map<String, Value>) -> Result<Correction, Problem> {
    members.retain(|name, _| !READ_ONLY.contains(&name.as_str()));
    for (name, value) in &members {
        if let Some((within, detail)) = misfit(name, value) {
            return Err(Problem::invalid(format!("{pointer}/{name}{within}"), detail));
        }
    }
    parse_json(pointer, Value::Object(members).to_string().as_bytes())
}

/// Where a member is none of its kind, and what it must be. The reader of a correction as a whole does not tell where.
fn misfit(name: &str, value: &Value) -> Option<(String, &'static str)> {
    const POINT: &str = "must be x and y in metres of the map frame: [x, y]";
    let is_point = |value: &Value| value.as_array().is_some_and(|xy| xy.len() == 2 && xy.iter().all(Value::is_number));
    let wrong = |detail| Some((String::new(), detail));
    match (name, value) {
        ("ring" | "line" | "rectangle", Value::Array(points)) => {
            let index = points.iter().position(|point| !is_point(point))?;
            Some((format!("/{index}"), POINT))
        }
        ("ring" | "line" | "rectangle", _) => {
            wrong("must be a list of points in metres of the map frame: [[x, y], ...]")
        }
        ("at", value) if is_point(value) => None,
        ("at", Value::Array(points)) if points.first().is_some_and(Value::is_array) => {
            let index = points.iter().position(|point| !is_point(point))?;
            Some((format!("/{index}"), POINT))
        }
        ("at", _) => wrong(POINT),
        ("kind" | "label" | "name", value) if !value.is_string() => wrong("must be a text"),
        ("isOpen", value) if !value.is_boolean() => wrong("must be true or false"),
        ("pitchM", value) if !value.is_number() => wrong("must be a number of metres"),
        ("places" | "layers", value) if value.as_u64().is_none() => wrong("must be a whole number"),
        _ => None,
    }
}

/// The objects of a list.
fn objects(list: Value) -> Result<Vec<Map<String, Value>>, Problem> {
    let Value::Array(list) = list else {
        return Err(Problem::invalid("/corrections", "must be a list of corrections"));
    };
    let object = |(index, value): (usize, Value)| match value {
        Value::Object(members) => Ok(members),
        _ => Err(Problem::invalid(format!("/corrections/{index}"), "must be an object")),
    };
    all(list.into_iter().enumerate().map(object))
}

/// All values, or the first problem.
fn all<T>(values: impl Iterator<Item = Result<T, Problem>>) -> Result<Vec<T>, Problem> {
    values.collect()
}

fn unreadable(errors: Vec<IngestError>) -> AppError {
    let detail = match errors.as_slice() {
        [error] => error.message.clone(),
        _ => format!("{} features cannot be read: nothing was changed", errors.len()),
    };
    let field = |error: IngestError| FieldProblem { pointer: error.pointer, detail: error.message };
    AppError::Invalid { detail, fields: errors.into_iter().take(MOST_TOLD).map(field).collect() }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    /// Pointer and detail of the refusal of a correction.
    fn refusal(correction: Value) -> (String, String) {
        let Value::Object(members) = correction else { panic!("is an object") };
        let problem = read_correction("/corrections/3", members).expect_err("is refused");
        let item = &problem.errors()[0];
        (item.pointer.clone().expect("a pointer"), item.detail.clone())
    }

    #[test]
    fn what_is_wrong_is_told_in_its_member() {
        let cases = [
            (json!({"kind": "draw", "ring": [[0, 0], [1, "x"], [1, 1]], "label": "pc"}), "/ring/1"),
            (json!({"kind": "draw", "ring": "x", "label": "pc"}), "/ring"),
            (json!({"kind": "merge", "at": [[0, 0], [1]]}), "/at/1"),
            (json!({"kind": "label", "at": {}, "label": "pc"}), "/at"),
            (json!({"kind": "label", "at": [0, 0], "label": 7}), "/label"),
            (json!({"kind": "row", "rectangle": [[0, 0], [1, 0], [1, 1], [0, 1]], "places": -1}), "/places"),
        ];
        for (correction, within) in cases {
            assert_eq!(refusal(correction.clone()).0, format!("/corrections/3{within}"), "{correction}");
        }
        let (pointer, detail) = refusal(json!({"kind": "draw", "ring": [[0, 0], [1, 0], [1, 1]]}));
        assert_eq!((pointer.as_str(), detail.as_str()), ("/corrections/3", "needs the member label"));
        let (_, detail) = refusal(json!({"kind": "paint"}));
        assert!(detail.starts_with("may not be paint: it is draw, split, merge"), "{detail}");
        let (_, detail) = refusal(json!({"kind": "name", "at": [0, 0], "name": "x", "colour": 1}));
        assert!(detail.starts_with("colour is not known here"), "{detail}");
    }

    #[test]
    fn what_was_read_may_be_sent_back() {
        let list = json!([{"id": "c7", "kind": "name", "at": [1, 2], "name": "x", "isApplied": false, "reason": "no face"},
            {"kind": "name", "at": [1, 2], "name": "y"}]);
        let ids: Vec<_> = whole_list(list).expect("is a list").into_iter().map(|(id, _)| id).collect();
        assert_eq!(ids, [Some(CorrectionId(7)), None]);
        let problem =
            whole_list(json!([{"id": 7, "kind": "name", "at": [1, 2], "name": "x"}])).expect_err("is refused");
        assert_eq!(problem.errors()[0].pointer.as_deref(), Some("/corrections/0/id"));
    }
}
