//! What can be asked of a collection, and what its features are, as JSON Schemas.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};

use super::collections::CollectionPath;
use crate::app::{App, Caller, MapContext};
use crate::features::CollectionSchema;
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::Path;
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::negotiation::Accept;
use crate::http::links::{Base, JSON_SCHEMA};
use crate::http::page;
use crate::http::problem::Problem;
use crate::views::feature_schema::FeatureSchemaView;

/// Queryables of a collection
///
/// What filters may use, as a JSON Schema. Each one whose values are no arrays is a parameter of the items, too.
#[utoipa::path(get, path = "/v1/maps/{mapId}/collections/{collectionId}/queryables", tag = "features",
    operation_id = "getQueryables", params(CollectionPath),
    responses((status = 200, description = "The queryables",
        content((FeatureSchemaView = "application/schema+json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the map, its analysis and its labels"))),
        NotFound, NotAnalysed))]
pub async fn queryables(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<CollectionPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    Ok(answer("queryables", FeatureSchemaView::of_queryables, &path, &base, &context, &accept, &if_none_match))
}

/// Schema of a collection
///
/// The properties of its features, as a JSON Schema.
#[utoipa::path(get, path = "/v1/maps/{mapId}/collections/{collectionId}/schema", tag = "features",
    operation_id = "getSchema", params(CollectionPath),
    responses((status = 200, description = "The schema",
        content((FeatureSchemaView = "application/schema+json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the map, its analysis and its labels"))),
        NotFound, NotAnalysed))]
pub async fn schema(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<CollectionPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    Ok(answer("schema", FeatureSchemaView::of_features, &path, &base, &context, &accept, &if_none_match))
}

/// A schema as JSON or as a page.
fn answer(
    name: &'static str,
    view: fn(&CollectionSchema, String) -> FeatureSchemaView,
    path: &CollectionPath,
    base: &Base,
    context: &MapContext,
    accept: &Accept,
    if_none_match: &IfNoneMatch,
) -> Response {
    let collection = path.collection_id.0;
    EntityTag::of_map(&page::kind(name, accept), context).answer(if_none_match, || {
        let address = format!("/v1/maps/{}/collections/{}/{name}", path.map_id, collection.id());
        let schema = CollectionSchema::of(collection);
        let view = view(schema, base.link("self", &address, JSON_SCHEMA).href);
        if page::is_wanted(accept) {
            return page::answer(accept, schema.title, &view);
        }
        let media_type = HeaderValue::from_static(JSON_SCHEMA);
        ([(header::CONTENT_TYPE, media_type)], Json(view)).into_response()
    })
}
