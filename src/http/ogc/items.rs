//! The features of a collection, page by page, and one by one.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;

use super::collections::CollectionPath;
use super::filter::PropertyParameters;
use super::item_query::{FeaturePath, ItemQuery};
use super::items_answer::Answer;
use super::items_format::Format;
use super::items_query::ItemsQuery;
use crate::app::{App, Caller, MapContext};
use crate::blocking::off_the_runtime;
use crate::features::query::{VanishedFeature, find};
use crate::features::{Collection, CollectionSchema};
use crate::http::docs::binary::Binary;
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{Path, Query};
use crate::http::links::Base;
use crate::http::problem::Problem;
use crate::views::feature::{FeatureCollectionView, FeatureView};

/// Features of a collection
///
/// A page of features, ascending by id unless `sortby` says otherwise. The coordinates are longitude and latitude unless
/// `crs` says otherwise; of a map without georeference those of EPSG:3857 are the metres of the map frame. Pages go on
/// after an id, so that nothing is skipped or repeated when the map changes between them.
#[utoipa::path(get, path = "/v1/maps/{mapId}/collections/{collectionId}/items", tag = "features",
    operation_id = "getFeatures", params(CollectionPath, ItemsQuery, PropertyParameters),
    responses((status = 200, description = "A page of features",
        content((FeatureCollectionView = "application/geo+json"), (FeatureCollectionView = "application/fg+json"),
            (String = "text/html"), (String = "text/csv"), (Binary = "application/flatgeobuf")),
        headers(("ETag" = String, description = "Changes with the map, its analysis and its labels"),
            ("Content-Crs" = Option<String>, description = "System of the coordinates"),
            ("Link" = Option<String>, description = "The profile, and the next page"))),
        NotFound, NotAnalysed))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<CollectionPath>,
    query: ItemsQuery,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let (collection, format) = (path.collection_id.0, Format::wanted(&accept, Format::ALL));
    let context = app.context(&caller, path.map_id.0).await?;
    let georeference = context.record.georeference;
    let question = query.question(collection, format, georeference)?;
    let (properties, crs, transform) = (query.properties(collection)?, query.crs(), query.transform(georeference)?);
    let tag = EntityTag::of_map(&format!("items.{}", format.name()), &context);
    let profile = query.profile(format);
    let answer = Answer { base, context, properties, format, profile, crs, transform };
    tag.answer_computed(&if_none_match, move || {
        let page = question.select(answer.context.features(collection)).map_err(|VanishedFeature| {
            Problem::parameter("after", "is not in the collection any more: begin again with the first page")
        })?;
        Ok(answer.page(&query, &page))
    })
    .await
}

/// A feature
///
/// Locations go by their code.
#[utoipa::path(get, path = "/v1/maps/{mapId}/collections/{collectionId}/items/{featureId}", tag = "features",
    operation_id = "getFeature", params(FeaturePath, ItemQuery),
    responses((status = 200, description = "The feature", 
        content((FeatureView = "application/geo+json"), (FeatureView = "application/fg+json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the map, its analysis and its labels"),
            ("Content-Crs" = Option<String>, description = "System of the coordinates"),
            ("Link" = Option<String>, description = "The profile"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<FeaturePath>,
    Query(parameters): Query<ItemQuery>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let (collection, id) = (path.collection_id.0, path.feature_id);
    let format = Format::wanted(&accept, Format::OF_ONE);
    let context = app.context(&caller, path.map_id.0).await?;
    let tag = tag(&context, format);
    let (properties, crs) = (parameters.properties(collection)?, parameters.crs);
    let transform = parameters.transform(context.record.georeference)?;
    let profile = parameters.profile(format);
    let answer = Answer { base, context, properties, format, profile, crs, transform };
    off_the_runtime(move || {
        let response = feature(&answer, &parameters, &id)?;
        Ok(tag.answer(&if_none_match, || response))
    })
    .await
}

/// The tag of a feature in a format.
pub fn tag(context: &MapContext, format: Format) -> EntityTag {
    EntityTag::of_map(&format!("item.{}", format.name()), context)
}

/// The feature with an id as an answer.
///
/// # Errors
/// 404 where the collection has none.
pub fn feature(answer: &Answer, query: &ItemQuery, id: &str) -> Result<Response, Problem> {
    let collection = answer.properties.collection();
    let wanted = CollectionSchema::of(collection).feature_id(id).ok();
    let found = wanted.and_then(|wanted| find(answer.context.features(collection), &wanted));
    found.map(|feature| answer.feature(feature, query)).ok_or_else(|| missing(collection, id))
}

/// There is no such feature.
pub fn missing(collection: Collection, id: &str) -> Problem {
    Problem::not_found(format!("there is no feature {id} in {}", collection.id()))
}
