//! Names for people, and codes and groups of what they name.

use serde::Deserialize;
use stillage_core::layout::check_code;
use stillage_core::registry::{checked_group, checked_groups, checked_name};
use utoipa::ToSchema;

/// A name for people: 1 to 200 characters, no control characters.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(try_from = "String")]
#[schema(value_type = String, min_length = 1, max_length = 200, pattern = r"^[^\x00-\x1f\x7f-\x9f]{1,200}$", example = "Hall 3")]
pub struct Name(pub String);

impl TryFrom<String> for Name {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        checked_name(&text).map(Self)
    }
}

/// The code of a location: 1 to 18 characters, no comma, no control characters, no space at its ends.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(try_from = "String")]
#[schema(value_type = String, min_length = 1, max_length = 18, example = "A-07-12")]
pub struct Code(pub String);

impl TryFrom<String> for Code {
    type Error = String;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        check_code(&text).map(|()| Self(text)).map_err(|problem| problem.to_string())
    }
}

/// A group: 1 to 50 characters, no control characters, no `|`.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(try_from = "String")]
#[schema(value_type = String, min_length = 1, max_length = 50, example = "cold store")]
pub struct Group(pub String);

impl TryFrom<String> for Group {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        checked_group(&text).map(Self)
    }
}

/// The groups of one thing: 20 at most, each once.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "Vec<Group>")]
pub struct Groups(pub Vec<String>);

impl TryFrom<Vec<Group>> for Groups {
    type Error = &'static str;

    fn try_from(groups: Vec<Group>) -> Result<Self, Self::Error> {
        checked_groups(groups.into_iter().map(|group| group.0)).map(Self)
    }
}
