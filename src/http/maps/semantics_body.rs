//! What a request says of labels, as a change of those in force.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};
use stillage_core::Point;
use stillage_core::layout::LayoutOptions;
use utoipa::ToSchema;

use super::corrections_body;
use crate::app::{MapContext, RuleSetChoice, SemanticsChange, Unnamed};
use crate::http::extract::{parse_json, pointer_step, present};
use crate::http::problem::Problem;
use crate::views::correction::CorrectionView;
use crate::views::layout::LayoutView;
use crate::views::rule_set::RuleSetBody;
use crate::views::semantics::{OverrideView, SemanticsBody};

/// Changes to the labels and corrections of a map, as a JSON merge patch (RFC 7396): what is not named stays. What a read adds
/// (`version`, `origin`, `carried`, `correctionCount`, `restores`, `created`) may be sent back and is ignored.
#[derive(Debug, Deserialize, ToSchema)]
#[schema(as = SemanticsPatch)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct SemanticsPatchBody {
    /// Another rule set, by its id; a preview takes a rule set that is not stored, too.
    #[schema(value_type = Option<String>, example = "site")]
    rule_set: Option<RuleSetChoiceBody>,
    /// Label by category; null gives a category its suggested label, and instead of the object gives it to all of them.
    #[serde(default, deserialize_with = "present")]
    #[schema(value_type = Option<BTreeMap<String, Option<String>>>, example = json!({"0": "co", "1": null}))]
    #[allow(clippy::option_option, reason = "a merge patch tells absent from null")]
    assignment: Option<Option<BTreeMap<String, Option<String>>>>,
    /// Labels of single faces: an object by face changes those that it names, and null takes one away; a list, as reads
    /// have it, replaces all of them, and null instead takes all away.
    #[serde(default, deserialize_with = "present")]
    #[schema(value_type = Option<OverridesPatch>, example = json!({"12": "ju", "13": null}))]
    #[allow(clippy::option_option, reason = "a merge patch tells absent from null")]
    overrides: Option<Option<OverridesPatch>>,
    /// How locations are cut and numbered, likewise: null gives a member its default.
    #[serde(default, deserialize_with = "present")]
    #[schema(value_type = Option<LayoutView>)]
    #[allow(clippy::option_option, reason = "a merge patch tells absent from null")]
    layout: Option<Option<Map<String, Value>>>,
    /// All corrections, in their order, as `…/corrections` lists them: with an id those that there are, as they are or
    /// changed, and new ones without. Null takes all away. The faces that `overrides` names are those before.
    #[serde(default, deserialize_with = "present")]
    #[schema(value_type = Option<Vec<CorrectionView>>)]
    #[allow(clippy::option_option, reason = "a merge patch tells absent from null")]
    corrections: Option<Option<Value>>,
    #[serde(default, rename = "correctionCount")]
    #[schema(read_only, value_type = serde_json::Value)]
    _correction_count: IgnoredAny,
    #[serde(default, rename = "restores")]
    #[schema(read_only, value_type = serde_json::Value)]
    _restores: IgnoredAny,
    #[serde(default, rename = "version")]
    #[schema(read_only, value_type = serde_json::Value)]
    _version: IgnoredAny,
    #[serde(default, rename = "origin")]
    #[schema(read_only, value_type = serde_json::Value)]
    _origin: IgnoredAny,
    #[serde(default, rename = "carried")]
    #[schema(read_only, value_type = serde_json::Value)]
    _carried: IgnoredAny,
    #[serde(default, rename = "created")]
    #[schema(read_only, value_type = serde_json::Value)]
    _created: IgnoredAny,
}

impl SemanticsPatchBody {
    /// The faces of a list of overrides, in its order.
    pub fn listed_faces(&self) -> Vec<u32> {
        match &self.overrides {
            Some(Some(OverridesPatch::All(list))) => list.iter().map(|entry| entry.face).collect(),
            _ => Vec::new(),
        }
    }
}

/// A rule set.
#[derive(Debug)]
pub enum RuleSetChoiceBody {
    /// The id of a stored one.
    Stored(String),
    /// One that is not stored: for previews only.
    Unsaved(RuleSetBody),
}

impl<'de> Deserialize<'de> for RuleSetChoiceBody {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct IdOrRuleSet;
        impl<'de> Visitor<'de> for IdOrRuleSet {
            type Value = RuleSetChoiceBody;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("the id of a rule set, or a rule set")
            }

            fn visit_str<E: Error>(self, id: &str) -> Result<RuleSetChoiceBody, E> {
                Ok(RuleSetChoiceBody::Stored(id.to_owned()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<RuleSetChoiceBody, A::Error> {
                Deserialize::deserialize(MapAccessDeserializer::new(map)).map(RuleSetChoiceBody::Unsaved)
            }
        }
        deserializer.deserialize_any(IdOrRuleSet)
    }
}

impl RuleSetChoiceBody {
    fn into_choice(self) -> RuleSetChoice {
        match self {
            Self::Stored(id) => RuleSetChoice::Stored(id),
            Self::Unsaved(rule_set) => RuleSetChoice::Unsaved(rule_set.into_draft()),
        }
    }
}

/// Changes to the labels of single faces.
#[derive(Debug, ToSchema)]
#[schema(as = LabelOverridesPatch)]
#[serde(untagged)]
pub enum OverridesPatch {
    /// Label by face; null takes it away.
    ByFace(BTreeMap<String, Option<String>>),
    /// All of them.
    All(Vec<OverrideView>),
}

impl<'de> Deserialize<'de> for OverridesPatch {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = OverridesPatch;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("labels by face, or a list of faces with their labels")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<OverridesPatch, A::Error> {
                Deserialize::deserialize(MapAccessDeserializer::new(map)).map(OverridesPatch::ByFace)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<OverridesPatch, A::Error> {
                Deserialize::deserialize(SeqAccessDeserializer::new(list)).map(OverridesPatch::All)
            }
        }
        deserializer.deserialize_any(Either)
    }
}

/// The change that a `PUT` asks for.
pub fn of_put(body: SemanticsBody, context: &MapContext) -> Result<SemanticsChange, Problem> {
    let other_overrides = if body.overrides.is_some() { Unnamed::IsForgotten } else { Unnamed::Stays };
    Ok(SemanticsChange {
        rule_set: body.rule_set.map(RuleSetChoice::Stored),
        categories: categories(body.assignment.into_iter().map(|(category, label)| (category, Some(label))))?,
        other_categories: Unnamed::Stays,
        overrides: all_overrides(body.overrides.unwrap_or_default())?,
        other_overrides,
        layout: body.layout.map(|layout| read_layout(&layout, context)).transpose()?,
        corrections: None,
    })
}

/// The change that a `PATCH` asks for.
pub fn of_patch(body: SemanticsPatchBody, context: &MapContext) -> Result<SemanticsChange, Problem> {
    let (assignment, other_categories) = parts(body.assignment, Unnamed::Stays);
    let is_list = matches!(body.overrides, Some(Some(OverridesPatch::All(_))));
    let (overrides, other_overrides) =
        parts(body.overrides, if is_list { Unnamed::IsForgotten } else { Unnamed::Stays });
    Ok(SemanticsChange {
        rule_set: body.rule_set.map(RuleSetChoiceBody::into_choice),
        categories: categories(assignment.unwrap_or_default())?,
        other_categories,
        overrides: match overrides {
            None => BTreeMap::new(),
            Some(OverridesPatch::All(list)) => all_overrides(list)?,
            Some(OverridesPatch::ByFace(labels)) => overrides_by_face(labels)?,
        },
        other_overrides,
        layout: body.layout.map(|layout| patched_layout(layout, context)).transpose()?,
        corrections: match body.corrections {
            None => None,
            Some(None) => Some(Vec::new()),
            Some(Some(list)) => Some(corrections_body::whole_list(list)?),
        },
    })
}

/// The value of a member of a patch, and what becomes of what it does not name: null forgets all.
#[allow(clippy::option_option, reason = "a merge patch tells absent from null")]
fn parts<T>(member: Option<Option<T>>, others: Unnamed) -> (Option<T>, Unnamed) {
    match member {
        Some(None) => (None, Unnamed::IsForgotten),
        Some(Some(value)) => (Some(value), others),
        None => (None, Unnamed::Stays),
    }
}

fn categories(
    labels: impl IntoIterator<Item = (String, Option<String>)>,
) -> Result<BTreeMap<u8, Option<String>>, Problem> {
    let read = |(category, label): (String, Option<String>)| {
        let number = category.parse().ok().filter(|number: &u8| number.to_string() == category);
        let unknown =
            || Problem::invalid(format!("/assignment/{}", pointer_step(&category)), "there is no such category");
        Ok((number.ok_or_else(unknown)?, label))
    };
    labels.into_iter().map(read).collect()
}

fn overrides_by_face(labels: BTreeMap<String, Option<String>>) -> Result<BTreeMap<u32, Option<String>>, Problem> {
    let read = |(face, label): (String, Option<String>)| {
        let number = face.parse().ok().filter(|number: &u32| number.to_string() == face);
        let unknown = || Problem::invalid(format!("/overrides/{}", pointer_step(&face)), "there is no such face");
        Ok((number.ok_or_else(unknown)?, label))
    };
    labels.into_iter().map(read).collect()
}

fn all_overrides(list: Vec<OverrideView>) -> Result<BTreeMap<u32, Option<String>>, Problem> {
    let mut overrides = BTreeMap::new();
    for (index, OverrideView { face, label }) in list.into_iter().enumerate() {
        if overrides.insert(face, Some(label)).is_some() {
            return Err(Problem::invalid(format!("/overrides/{index}/face"), format!("face {face} is named twice")));
        }
    }
    Ok(overrides)
}

/// The layout in force with the members of a patch.
fn patched_layout(patch: Option<Map<String, Value>>, context: &MapContext) -> Result<LayoutOptions, Problem> {
    let Some(patch) = patch else { return read_layout(&LayoutView::default(), context) };
    let in_force = LayoutView::new(&context.semantics.layout, &context.record.to_site());
    let mut members: Map<String, Value> =
        serde_json::to_value(in_force).ok().and_then(|value| value.as_object().cloned()).unwrap_or_default();
    for (name, value) in patch {
        if value.is_null() {
            members.remove(&name);
        } else {
            members.insert(name, value);
        }
    }
    let layout: LayoutView = parse_json("/layout", Value::Object(members).to_string().as_bytes())?;
    read_layout(&layout, context)
}

/// The layout that is wished. The entrance lies in the map, or just outside it.
fn read_layout(body: &LayoutView, context: &MapContext) -> Result<LayoutOptions, Problem> {
    /// How far outside the grid an entrance may lie, metres: a map may end before the door.
    const OUTSIDE_M: f64 = 10.0;
    let wrong = |pointer: &str, detail: String| Problem::invalid(format!("/layout{pointer}"), detail);
    let layout = body.read(&context.semantics.layout, &context.record.to_site());
    let layout = layout.map_err(|unusable| wrong(unusable.pointer, unusable.detail))?;
    if let Some(entrance) = body.entrance() {
        let (grid, at) = (&context.grid, context.grid.frame().to_grid(Point::from(entrance)));
        let is_near =
            |place: f64, cells: usize| (-OUTSIDE_M..=cells as f64 * grid.resolution() + OUTSIDE_M).contains(&place);
        if !(is_near(at.x, grid.width()) && is_near(at.y, grid.height())) {
            let detail =
                format!("lies more than {OUTSIDE_M} m outside the map: give x and y in metres of the map frame");
            return Err(wrong("/entrance", detail));
        }
    }
    Ok(layout)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_is_overridden_once() {
        let body: SemanticsBody = serde_json::from_str(
            r#"{"overrides": [{"face": 3, "label": "co"}, {"face": 3, "label": "ju"}], "version": 4, "origin": "assigned"}"#,
        )
        .expect("is a body");
        let problem = all_overrides(body.overrides.expect("a list")).expect_err("is refused");
        assert_eq!(problem.errors()[0].pointer.as_deref(), Some("/overrides/1/face"));
    }

    #[test]
    fn a_patch_tells_what_it_names_from_what_it_takes_away() {
        let body = |text: &str| serde_json::from_str::<SemanticsPatchBody>(text).expect("is a patch");
        assert!(body("{}").overrides.is_none());
        assert!(matches!(body(r#"{"overrides": null}"#).overrides, Some(None)));
        let by_face = body(r#"{"overrides": {"12": "ju", "13": null}}"#).overrides;
        assert!(matches!(by_face, Some(Some(OverridesPatch::ByFace(labels))) if labels["13"].is_none()));
        let all = body(r#"{"overrides": [{"face": 12, "label": "ju"}]}"#).overrides;
        assert!(matches!(all, Some(Some(OverridesPatch::All(list))) if list[0].face == 12));
    }
}
