//! The ids of features.

use std::fmt;

use serde::Serialize;

use super::property::Kind;

/// Longest id that is a text, bytes: codes of locations are far shorter.
const MAX_TEXT: usize = 64;

/// The id of a feature. Numbers come before texts, texts in the order of their bytes.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(untagged)]
pub enum FeatureId {
    /// Faces, edges and all else.
    Number(u64),
    /// The code of a location.
    Text(String),
}

impl FeatureId {
    /// Reads an id of this kind. A number has one spelling: no sign, no zeros in front.
    ///
    /// # Errors
    /// What is wrong with the text, to be put after its name.
    pub fn read(text: &str, kind: Kind) -> Result<Self, &'static str> {
        if kind == Kind::Text {
            let fits = (1..=MAX_TEXT).contains(&text.len());
            return if fits { Ok(Self::Text(text.to_owned())) } else { Err("is not the code of a location") };
        }
        let number = text.parse().ok().filter(|number: &u64| number.to_string() == text);
        number.map(Self::Number).ok_or("is not the id of a feature")
    }
}

impl fmt::Display for FeatureId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(formatter),
            Self::Text(text) => text.fmt(formatter),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_of_features_have_one_spelling() {
        assert_eq!(FeatureId::read("12", Kind::Integer), Ok(FeatureId::Number(12)));
        for wrong in ["", "012", "+12", "-1", "x", "99999999999999999999"] {
            assert!(FeatureId::read(wrong, Kind::Integer).is_err(), "{wrong}");
        }
        assert_eq!(FeatureId::read("03-012", Kind::Text), Ok(FeatureId::Text("03-012".to_owned())));
    }
}
