//! Names for people, and codes and groups of what they name.

use serde::Deserialize;
use stillage_core::layout::check_code;
use utoipa::ToSchema;

/// A name for people: 1 to 200 characters, no control characters.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(try_from = "String")]
#[schema(value_type = String, min_length = 1, max_length = 200, pattern = r"^[^\x00-\x1f\x7f-\x9f]{1,200}$", example = "Hall 3")]
pub struct Name(pub String);

impl TryFrom<String> for Name {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let fits = !text.trim().is_empty() && text.chars().count() <= 200 && !text.chars().any(char::is_control);
        if fits { Ok(Self(text)) } else { Err("must have 1 to 200 characters, none of them a control character") }
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
        let text = text.trim();
        let is_plain = !text.chars().any(|character| character.is_control() || character == '|');
        let fits = (1..=50).contains(&text.chars().count()) && is_plain;
        if fits {
            Ok(Self(text.to_owned()))
        } else {
            Err("must have 1 to 50 characters, no `|` and no control character")
        }
    }
}

/// The groups of one thing: 20 at most, each once.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "Vec<Group>")]
pub struct Groups(pub Vec<String>);

impl TryFrom<Vec<Group>> for Groups {
    type Error = &'static str;

    fn try_from(groups: Vec<Group>) -> Result<Self, Self::Error> {
        let mut texts: Vec<String> = Vec::new();
        for Group(text) in groups {
            if !texts.contains(&text) {
                texts.push(text);
            }
        }
        if texts.len() <= 20 { Ok(Self(texts)) } else { Err("must be 20 groups at most") }
    }
}
