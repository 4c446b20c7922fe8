//! Links between resources.

use serde::Serialize;
use utoipa::ToSchema;

/// A link to another resource.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct Link {
    /// Where it leads.
    #[schema(format = "uri")]
    pub href: String,
    /// How the target relates to this resource.
    #[schema(example = "self")]
    pub rel: &'static str,
    /// Media type of the target.
    #[schema(example = "application/json")]
    pub r#type: &'static str,
    /// The target, for people.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<&'static str>,
}

impl Link {
    /// Names the target for people.
    #[must_use]
    pub const fn titled(mut self, title: &'static str) -> Self {
        self.title = Some(title);
        self
    }
}
