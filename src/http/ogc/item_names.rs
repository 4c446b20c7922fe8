//! Features that people name: OGC API Features part 4, as far as names go.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::State;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use stillage_core::registry::Given;
use utoipa::ToSchema;

use super::items::{self, FeaturePath, ItemQuery};
use super::items_answer::Answer;
use super::items_format::Format;
use crate::app::{App, AppError, Caller, area_kind};
use crate::blocking::off_the_runtime;
use crate::features::{Collection, CollectionSchema};
use crate::http::docs::refusals::{Conflict, MethodNotAllowed, NotFound, PreconditionRequired};
use crate::http::extract::conditional::IfMatch;
use crate::http::extract::{JsonBody, Path, Query, present};
use crate::http::links::Base;
use crate::http::problem::{Problem, ProblemType};
use crate::views::feature::FeatureView;
use crate::views::name::{Code, Group, Groups, Name};

/// What people say of a feature, as a JSON merge patch (RFC 7396). Null takes away a name or the groups.
#[derive(Debug, Deserialize, ToSchema)]
#[schema(as = FeaturePatch)]
#[serde(deny_unknown_fields)]
pub struct FeaturePatchBody {
    /// Its name.
    #[serde(default, deserialize_with = "present")]
    #[schema(value_type = Option<Name>)]
    #[allow(clippy::option_option, reason = "a merge patch tells absent from null")]
    name: Option<Option<Name>>,
    /// Its code; of locations only.
    code: Option<Code>,
    /// Its groups.
    #[serde(default, deserialize_with = "present")]
    #[schema(value_type = Option<Vec<Group>>)]
    #[allow(clippy::option_option, reason = "a merge patch tells absent from null")]
    groups: Option<Option<Groups>>,
}

impl From<FeaturePatchBody> for Given {
    fn from(body: FeaturePatchBody) -> Self {
        Self {
            code: body.code.map(|code| code.0),
            name: body.name.map(|name| name.map(|name| name.0)),
            groups: body.groups.map(|groups| groups.map(|groups| groups.0).unwrap_or_default()),
        }
    }
}

/// Whether people may write something of the features of a collection.
pub const fn is_writable(collection: Collection) -> bool {
    matches!(collection, Collection::Locations) || area_kind(collection).is_some()
}

/// The methods of a feature.
const fn methods(collection: Collection) -> &'static str {
    if is_writable(collection) { "GET,HEAD,PATCH" } else { "GET,HEAD" }
}

/// Name a feature
///
/// Names and groups of `locations`, `places`, `aisles` and `rows`, and codes of locations. They belong to the site: they
/// stay with their ground through relabelling, another analysis and a new scan. `OPTIONS` tells whether a feature may be
/// written. The answer is the feature as it is now, at the address that its link `self` names.
#[utoipa::path(patch, path = "/v1/maps/{mapId}/collections/{collectionId}/items/{featureId}", tag = "features",
    operation_id = "nameFeature", params(FeaturePath, ItemQuery,
        ("If-Match" = Option<String>, Header, description = "The ETag that was read; 428 without it")),
    request_body(content((FeaturePatchBody = "application/merge-patch+json"), (FeaturePatchBody = "application/json"))),
    responses((status = 200, description = "The feature as it is now", body = FeatureView,
        content_type = "application/geo+json",
        headers(("ETag" = String, description = "Changes with the map, its analysis, its labels and its names"),
            ("Content-Crs" = String, description = "System of the coordinates"))),
        NotFound, MethodNotAllowed, Conflict, PreconditionRequired))]
pub async fn update(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<FeaturePath>,
    Query(parameters): Query<ItemQuery>,
    if_match: IfMatch,
    JsonBody(body): JsonBody<FeaturePatchBody>,
) -> Result<Response, Problem> {
    let collection = path.collection_id.0;
    let context = app.context(&caller, path.map_id.0).await?;
    if !is_writable(collection) {
        let detail = "only locations, places, aisles and rows can be named";
        let mut response = Problem::new(ProblemType::MethodNotAllowed, detail).into_response();
        response.headers_mut().insert(header::ALLOW, HeaderValue::from_static(methods(collection)));
        return Ok(response);
    }
    let missing = || items::missing(collection, &path.feature_id);
    let id = CollectionSchema::of(collection).feature_id(&path.feature_id).map_err(|_| missing())?;
    context.nameable(collection, &id).ok_or_else(missing)?;
    let transform = parameters.transform(context.record.georeference)?;
    if_match
        .against(&items::tag(&context, Format::GeoJson), context.record.version)?
        .ok_or(AppError::PreconditionRequired)?;
    let (context, id) = app.name_feature(&caller, &context, (collection, id), body.into()).await?;
    let tag = items::tag(&context, Format::GeoJson);
    let answer = Answer { base, context, collection, format: Format::GeoJson, crs: parameters.crs, transform };
    off_the_runtime(move || Ok(tag.on(items::feature(&answer, &id.to_string())?))).await
}

/// `OPTIONS` of a feature: what may be done with it.
pub async fn options(Path(path): Path<FeaturePath>) -> Response {
    let collection = path.collection_id.0;
    let mut headers = HeaderMap::new();
    headers.insert(header::ALLOW, HeaderValue::from_static(methods(collection)));
    if is_writable(collection) {
        let patch = HeaderValue::from_static("application/merge-patch+json, application/json");
        headers.insert("accept-patch", patch);
    }
    (StatusCode::NO_CONTENT, headers, Body::empty()).into_response()
}
