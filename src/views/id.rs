//! Ids in documents and addresses.

use std::fmt;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use uuid::Uuid;

/// The id of a map, analysis or job.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(try_from = "String", into = "String")]
#[schema(value_type = String, format = "uuid", example = "019ab3c2-5d10-7c41-9a53-0242ac120002")]
pub struct Id(pub Uuid);

impl TryFrom<String> for Id {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        // Only the hyphenated form: each resource has one address.
        let id = Uuid::try_parse(&text).ok().filter(|_| text.len() == 36);
        id.map(Self).ok_or("must be a UUID")
    }
}

impl From<Id> for String {
    fn from(id: Id) -> Self {
        id.0.to_string()
    }
}

impl fmt::Display for Id {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_has_one_spelling() {
        assert!(Id::try_from("019ab3c2-5d10-7c41-9a53-0242ac120002".to_owned()).is_ok());
        assert!(Id::try_from("019ab3c25d107c419a530242ac120002".to_owned()).is_err());
        assert!(Id::try_from("{019ab3c2-5d10-7c41-9a53-0242ac120002}".to_owned()).is_err());
    }
}
