//! What handlers take from a request, typed; what cannot be taken is a problem.

pub mod bbox;
mod caller;
pub mod coding;
pub mod conditional;
pub mod crs;
pub mod datetime;
pub mod form;
pub mod format;
mod json;
pub mod negotiation;
mod plain_words;
pub mod prefer;
mod whole_body;

use axum::extract::FromRequestParts;
use axum::http::Uri;
use axum::http::request::Parts;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use utoipa::IntoParams;

use crate::http::problem::{Problem, ProblemType};
use crate::views::id::Id;

pub use json::{JsonBody, is_json, parse_json, pointer_step, present};
pub use whole_body::{body, broken_body, content_type};

/// Typed path parameters: an id that cannot be valid names nothing, so it is a 404.
#[derive(Debug)]
pub struct Path<T>(pub T);

impl<S: Send + Sync, T: DeserializeOwned + Send> FromRequestParts<S> for Path<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let path = axum::extract::Path::from_request_parts(parts, state).await;
        let axum::extract::Path(value) =
            path.map_err(|_| Problem::not_found(format!("there is nothing at {}", parts.uri.path())))?;
        Ok(Self(value))
    }
}

/// `/v1/maps/{mapId}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
pub struct MapPath {
    /// The map.
    pub map_id: Id,
}

/// Typed query parameters. Which names exist at all is checked before, by [`crate::http::guard::known_parameters`].
#[derive(Debug)]
pub struct Query<T>(pub T);

impl<S: Sync, T: DeserializeOwned> FromRequestParts<S> for Query<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Problem> {
        Self::read(&parts.uri)
    }
}

impl<T: DeserializeOwned> Query<T> {
    /// Reads the query of an address.
    pub fn read(uri: &Uri) -> Result<Self, Problem> {
        match axum::extract::Query::try_from_uri(uri) {
            Ok(axum::extract::Query(value)) => Ok(Self(value)),
            Err(rejection) => {
                let (path, message) = json::path_and_message(&rejection);
                Err(match path.as_str() {
                    "" => Problem::new(ProblemType::BadParameter, message),
                    name => Problem::parameter(name, message),
                })
            }
        }
    }
}

/// How many entries a list may hold; `DEFAULT` when nothing is said. Whoever asks for more than `MAX` gets `MAX` (OGC API
/// Features part 1, requirement 22).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Limit<const DEFAULT: u32, const MAX: u32>(pub u32);

impl<const DEFAULT: u32, const MAX: u32> Default for Limit<DEFAULT, MAX> {
    fn default() -> Self {
        Self(DEFAULT)
    }
}

impl<const DEFAULT: u32, const MAX: u32> TryFrom<String> for Limit<DEFAULT, MAX> {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let is_number = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        // More digits than fit are more than the most.
        let limit = is_number.then(|| text.parse().unwrap_or(MAX)).filter(|limit| *limit > 0);
        limit
            .map(|limit| Self(limit.min(MAX)))
            .ok_or_else(|| format!("must be a whole number from 1 (at most {MAX} are answered)"))
    }
}

/// Limit of the lists of maps and jobs.
pub type ListLimit = Limit<100, 1_000>;

/// Paging of a list.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct Paging {
    /// Most entries of the answer, and never more than 1,000.
    #[serde(default)]
    #[param(value_type = Option<u32>, minimum = 1, default = 100)]
    pub limit: ListLimit,
    /// Id of the last entry of the page before: taken from the `next` link.
    pub after: Option<Id>,
}

#[cfg(test)]
mod tests {
    use axum::extract::Request;

    use super::*;

    #[tokio::test]
    async fn errors_in_the_query_name_the_parameter() {
        let paging = |query: &str| {
            let request = Request::builder().uri(format!("/v1/maps?{query}")).body(()).expect("is a request");
            let mut parts = request.into_parts().0;
            async move { Query::<Paging>::from_request_parts(&mut parts, &()).await }
        };
        assert_eq!(paging("").await.expect("is right").0.limit.0, 100);
        assert_eq!(paging("limit=7").await.expect("is right").0.limit.0, 7);
        for many in ["limit=1001", "limit=99999999999999999999"] {
            assert_eq!(paging(many).await.expect("is right").0.limit.0, 1000, "{many}");
        }
        for wrong in [
            "limit=0",
            "limit=-1",
            "limit=+1",
            "limit=1.5",
            "limit=x",
            "limit=",
            "after=1",
            "limit=1&limit=2",
            "bogus=1",
        ] {
            let problem = paging(wrong).await.expect_err(wrong);
            assert_eq!(problem.kind(), ProblemType::BadParameter, "{wrong}");
        }
        let problem = paging("limit=0").await.expect_err("is refused");
        assert_eq!(problem.errors()[0].parameter.as_deref(), Some("limit"));
        assert_eq!(problem.errors()[0].detail, "must be a whole number from 1 (at most 1000 are answered)");
    }
}
