//! Features that people write: OGC API Features part 4, as far as labels and names go.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::State;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde_json::{Map, Value};

use super::collections::CollectionPath;
use super::feature_body::{self, FeaturePatchBody, FeatureWriteBody, Written, writable};
use super::item_query::{FeaturePath, ItemQuery};
use super::items;
use super::items_answer::Answer;
use super::items_format::Format;
use crate::app::{App, AppError, Caller, MapContext};
use crate::blocking::off_the_runtime;
use crate::coordinates::Transform;
use crate::features::query::{self, PropertySelection};
use crate::features::{Collection, CollectionSchema, FeatureId};
use crate::formats::geojson;
use crate::http::docs::refusals::{Conflict, MethodNotAllowed, NotFound, PreconditionRequired};
use crate::http::extract::conditional::IfMatch;
use crate::http::extract::{JsonBody, Path, Query};
use crate::http::links::Base;
use crate::http::problem::{Problem, ProblemType};
use crate::views::feature::FeatureView;

/// Media types of what is written.
const ACCEPTED: &str = "application/merge-patch+json, application/geo+json, application/json";

/// Whether people may write something of the features of a collection.
pub const fn is_writable(collection: Collection) -> bool {
    !writable(collection).is_empty()
}

/// The methods of the features of a collection as a whole. QGIS lets people change a feature only where `POST` is among them
/// (its `qgsoapifprovider.cpp`, `computeCapabilities`), so that it is, and is refused by itself.
const fn methods_of_all(collection: Collection) -> &'static str {
    if is_writable(collection) { "GET,HEAD,POST" } else { "GET,HEAD" }
}

/// The methods of a feature.
const fn methods(collection: Collection) -> &'static str {
    if is_writable(collection) { "GET,HEAD,PUT,PATCH" } else { "GET,HEAD" }
}

/// Add a feature
///
/// Features are made by the analysis and not by hand: always refused. The method is there for the sake of GIS, which let people
/// change features only where they might add some.
#[utoipa::path(
    post,
    path = "/v1/maps/{mapId}/collections/{collectionId}/items",
    tag = "features",
    operation_id = "addFeature",
    params(CollectionPath),
    responses(NotFound, MethodNotAllowed)
)]
pub async fn add(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<CollectionPath>,
) -> Result<Response, Problem> {
    app.map(&caller, path.map_id.0).await?;
    let collection = path.collection_id.0;
    if !is_writable(collection) {
        return Ok(not_allowed(methods_of_all(collection)));
    }
    let detail = "features are made by the analysis: PATCH changes the label of a face, and names, codes and groups";
    Err(Problem::new(ProblemType::ReadOnly, detail))
}

/// Write members of a feature
///
/// The label of a face, stronger than that of its category; null takes it away. Names and groups of `locations`, `places`,
/// `aisles` and `rows`, and codes of locations: they belong to the site and stay with their ground through relabelling,
/// another analysis and a new scan. `OPTIONS` tells whether a feature may be written. The answer is the feature as it is
/// now, at the address that its link `self` names.
///
/// A body with `properties`, as QGIS sends it, goes without `If-Match`, which a GIS cannot send: then the last write holds.
#[utoipa::path(patch, path = "/v1/maps/{mapId}/collections/{collectionId}/items/{featureId}", tag = "features",
    operation_id = "updateFeature", params(FeaturePath, ItemQuery,
        ("If-Match" = Option<String>, Header, description = "The ETag that was read; 428 without it, unless the body is a feature")),
    request_body(content((FeaturePatchBody = "application/merge-patch+json"), (FeatureWriteBody = "application/geo+json"),
        (FeaturePatchBody = "application/json"))),
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
    JsonBody(body): JsonBody<Map<String, Value>>,
) -> Result<Response, Problem> {
    write(&app, &caller, (base, path, parameters), &if_match, body).await
}

/// Write a feature
///
/// The feature as it was read, with another label, name, code or groups. What else differs is refused; what is left out stays.
/// Clients that write single properties send `PATCH`.
#[utoipa::path(put, path = "/v1/maps/{mapId}/collections/{collectionId}/items/{featureId}", tag = "features",
    operation_id = "replaceFeature", params(FeaturePath, ItemQuery,
        ("If-Match" = Option<String>, Header, description = "The ETag that was read; without it the last write holds")),
    request_body(content((FeatureWriteBody = "application/geo+json"), (FeatureWriteBody = "application/json"))),
    responses((status = 200, description = "The feature as it is now", body = FeatureView,
        content_type = "application/geo+json",
        headers(("ETag" = String, description = "Changes with the map, its analysis, its labels and its names"),
            ("Content-Crs" = String, description = "System of the coordinates"))),
        NotFound, MethodNotAllowed, Conflict))]
pub async fn replace(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<FeaturePath>,
    Query(parameters): Query<ItemQuery>,
    if_match: IfMatch,
    JsonBody(body): JsonBody<Map<String, Value>>,
) -> Result<Response, Problem> {
    if is_writable(path.collection_id.0) && !feature_body::is_feature(&body) {
        return Err(Problem::invalid("", "must be a feature with properties: PATCH takes the members themselves"));
    }
    write(&app, &caller, (base, path, parameters), &if_match, body).await
}

async fn write(
    app: &App,
    caller: &Caller,
    (base, path, parameters): (Base, FeaturePath, ItemQuery),
    if_match: &IfMatch,
    body: Map<String, Value>,
) -> Result<Response, Problem> {
    let collection = path.collection_id.0;
    let context = app.context(caller, path.map_id.0).await?;
    if !is_writable(collection) {
        return Ok(not_allowed(methods(collection)));
    }
    let (properties, crs) = (parameters.properties(collection)?, parameters.crs);
    let transform = parameters.transform(context.record.georeference)?;
    let is_feature = feature_body::is_feature(&body);
    let (seen, feature_id) = (Arc::clone(&context), path.feature_id);
    let (id, written) = off_the_runtime(move || read(&seen, (collection, &feature_id), body, &transform)).await?;
    let known = if_match.against(&items::tag(&context, Format::GeoJson), context.record.version)?;
    if known.is_none() && !is_feature {
        return Err(AppError::PreconditionRequired.into());
    }
    let pointer = written.pointer;
    let changed = match (&id, written.patch.label.clone()) {
        (FeatureId::Number(face), Some(label)) => {
            let face = u32::try_from(*face).unwrap_or(u32::MAX);
            app.label_face(caller, &context, face, label).await.map(|context| (context, id))
        }
        _ if collection == Collection::Faces => Ok((context, id)),
        _ => app.name_feature(caller, &context, (collection, id), written.patch.into()).await,
    };
    let in_body = |at: &str| format!("{pointer}{at}");
    let (context, id) = changed.map_err(|error| Problem::from(error).map_pointers(in_body))?;
    let tag = items::tag(&context, Format::GeoJson);
    let (format, profile) = (Format::GeoJson, parameters.profile(Format::GeoJson));
    let answer = Answer { base, context, properties, format, profile, crs, transform };
    off_the_runtime(move || Ok(tag.on(items::feature(&answer, &parameters, &id.to_string())?))).await
}

/// The refusal of a method of a collection that nobody writes to.
fn not_allowed(methods: &'static str) -> Response {
    let detail = "only faces, locations, places, aisles and rows can be written";
    let mut response = Problem::new(ProblemType::MethodNotAllowed, detail).into_response();
    response.headers_mut().insert(header::ALLOW, HeaderValue::from_static(methods));
    response
}

/// The feature that is written, and what is written of it.
fn read(
    context: &MapContext,
    (collection, feature_id): (Collection, &str),
    body: Map<String, Value>,
    transform: &Transform,
) -> Result<(FeatureId, Written), Problem> {
    let missing = || items::missing(collection, feature_id);
    let id = CollectionSchema::of(collection).feature_id(feature_id).map_err(|_| missing())?;
    let current = query::find(context.features(collection), &id).ok_or_else(missing)?;
    let written = if feature_body::is_feature(&body) {
        let current = geojson::feature(current, &PropertySelection::all(collection), transform, &[]);
        feature_body::feature(collection, body, &serde_json::from_slice(&current).unwrap_or_default())?
    } else {
        feature_body::members(collection, body)?
    };
    Ok((id, written))
}

/// `OPTIONS` of the features of a collection: what may be done with them.
pub async fn options_of_all(Path(path): Path<CollectionPath>) -> Response {
    let allow = HeaderValue::from_static(methods_of_all(path.collection_id.0));
    (StatusCode::NO_CONTENT, [(header::ALLOW, allow)], Body::empty()).into_response()
}

/// `OPTIONS` of a feature: what may be done with it.
pub async fn options(Path(path): Path<FeaturePath>) -> Response {
    let collection = path.collection_id.0;
    let mut headers = HeaderMap::new();
    headers.insert(header::ALLOW, HeaderValue::from_static(methods(collection)));
    if is_writable(collection) {
        headers.insert("accept-patch", HeaderValue::from_static(ACCEPTED));
    }
    (StatusCode::NO_CONTENT, headers, Body::empty()).into_response()
}
