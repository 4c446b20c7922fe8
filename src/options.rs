//! The options of an analysis as a client writes them, the same for the API and the command line.
//!
//! A client writes what differs from a preset, or from the defaults. [`RequestedOptions`] puts the two together; from
//! there on options are whole.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};
use stillage_core::AnalysisOptions;
use stillage_core::spec::Preset;

/// Options read from JSON: the preset that `preset` names, or the defaults, with the other members put over them.
///
/// An error begins with the path to its culprit, as in `categorization.k: invalid type`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RequestedOptions(pub AnalysisOptions);

/// The member that names a preset. No result has it: there, all options are written out.
const PRESET: &str = "preset";

impl<'de> Deserialize<'de> for RequestedOptions {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Value::Object(mut members) = UniqueMembers::deserialize(deserializer)?.0 else {
            return Err(D::Error::custom("must be an object"));
        };
        let preset = Option::<Preset>::deserialize(members.remove(PRESET).unwrap_or_default())
            .map_err(|error| D::Error::custom(format!("{PRESET}: {error}")))?;
        let base = preset.map_or_else(AnalysisOptions::default, Preset::options);
        let mut whole = serde_json::to_value(base).map_err(D::Error::custom)?;
        put_over(&mut whole, Value::Object(members));
        serde_path_to_error::deserialize(whole).map(Self).map_err(D::Error::custom)
    }
}

/// JSON in which no object names a member twice: a typing error would otherwise hide behind the last one.
struct UniqueMembers(Value);

impl<'de> Deserialize<'de> for UniqueMembers {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(UniqueMembersVisitor).map(Self)
    }
}

struct UniqueMembersVisitor;

impl<'de> Visitor<'de> for UniqueMembersVisitor {
    type Value = Value;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("JSON")
    }

    fn visit_unit<E: Error>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        while let Some(UniqueMembers(item)) = items.next_element()? {
            list.push(item);
        }
        Ok(list.into())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut members: A) -> Result<Value, A::Error> {
        let mut object = Map::new();
        while let Some((name, UniqueMembers(value))) = members.next_entry::<String, _>()? {
            if object.contains_key(&name) {
                return Err(A::Error::custom(format!("duplicate field `{name}`")));
            }
            object.insert(name, value);
        }
        Ok(object.into())
    }
}

/// Puts the members of an object over those of another, group by group.
fn put_over(base: &mut Value, over: Value) {
    match (base, over) {
        (Value::Object(base), Value::Object(over)) => {
            for (name, value) in over {
                put_over(base.entry(name).or_insert(Value::Null), value);
            }
        }
        (base, over) => *base = over,
    }
}

#[cfg(test)]
mod tests {
    use stillage_core::spec::{
        CategoryCount, DeclutterMethod, DecompositionMethod, FeatureProfile, RegionMethod, RelaxationOptions,
    };

    use super::*;

    fn read(json: &str) -> Result<AnalysisOptions, String> {
        serde_json::from_str(json).map(|RequestedOptions(options)| options).map_err(|error| error.to_string())
    }

    #[test]
    fn without_a_preset_the_defaults_fill_the_gaps() {
        assert_eq!(read("{}"), Ok(AnalysisOptions::default()));
        let options = read(r#"{"categorization": {"k": 3}}"#).unwrap();
        let mut expected = AnalysisOptions::default();
        expected.categorization.k = CategoryCount::Fixed(3);
        assert_eq!(options, expected);
    }

    #[test]
    fn options_beside_a_preset_override_it() {
        let options = read(
            r#"{"preset": "paper", "regions": {"method": "single"},
                "categorization": {"profile": "halmstad2017", "relaxation": {}, "maxRangeM": null}}"#,
        )
        .unwrap();
        assert_eq!(options.declutter.method, DeclutterMethod::None);
        assert_eq!(options.decomposition.method, DecompositionMethod::Paper);
        assert_eq!(options.regions.method, RegionMethod::Single);
        assert_eq!(options.categorization.profile, FeatureProfile::Halmstad2017);
        assert_eq!(options.categorization.relaxation, Some(RelaxationOptions::default()));
        assert_eq!(options.categorization.restarts, 20);
    }

    #[test]
    fn options_that_are_whole_already_stay_as_they_are() {
        let whole = Preset::Halmstad2017.options();
        assert_eq!(read(&serde_json::to_string(&whole).unwrap()), Ok(whole));
    }

    #[test]
    fn errors_name_the_culprit() {
        let errors: String = [
            r#"{"preset": "papr"}"#,
            r#"{"preset": 1}"#,
            r#"{"preset": "paper", "regions": {"method": "tiles"}}"#,
            r#"{"categorisation": {}}"#,
            r#"{"categorization": 5}"#,
            r#"{"seed": 1, "seed": 2}"#,
            r#"{"categorization": {"k": 2, "k": 3}}"#,
            r#"{"seed": 1"#,
            "[]",
        ]
        .iter()
        .map(|json| format!("{json} -> {}\n", read(json).unwrap_err()))
        .collect();
        expect_test::expect![[r#"
            {"preset": "papr"} -> preset: unknown variant `papr`, expected `paper` or `halmstad2017`
            {"preset": 1} -> preset: invalid type: integer `1`, expected string or map
            {"preset": "paper", "regions": {"method": "tiles"}} -> regions.method: unknown variant `tiles`, expected one of `energy`, `single`, `gabor`
            {"categorisation": {}} -> categorisation: unknown field `categorisation`, expected one of `seed`, `grid`, `categorization`, `orientation`, `regions`, `decomposition`, `annotation`, `declutter`
            {"categorization": 5} -> categorization: invalid type: integer `5`, expected struct CategorizationOptions
            {"seed": 1, "seed": 2} -> duplicate field `seed` at line 1 column 22
            {"categorization": {"k": 2, "k": 3}} -> duplicate field `k` at line 1 column 35
            {"seed": 1 -> EOF while parsing an object at line 1 column 10
            [] -> must be an object
        "#]].assert_eq(&errors);
    }
}
