//! The features of a collection, page by page, and one by one.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;
use serde::Deserialize;
use utoipa::IntoParams;

use super::collections::{CollectionId, CollectionPath};
use super::filter::PropertyParameters;
use super::items_answer::Answer;
use super::items_format::Format;
use super::items_query::ItemsQuery;
use crate::app::{App, Caller, MapContext};
use crate::blocking::off_the_runtime;
use crate::coordinates::{Georeference, Transform};
use crate::features::query::{self, VanishedFeature};
use crate::features::{Collection, CollectionSchema};
use crate::http::docs::binary::Binary;
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::crs::CrsName;
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{Path, Query};
use crate::http::links::Base;
use crate::http::problem::Problem;
use crate::views::feature::{FeatureCollectionView, FeatureView};
use crate::views::id::Id;

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
            ("Link" = Option<String>, description = "The next page"))),
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
    let (crs, transform) = (query.crs(), query.transform(georeference)?);
    let tag = EntityTag::of_map(&format!("items.{}", format.name()), &context);
    let answer = Answer { base, context, collection, format, crs, transform };
    tag.answer_computed(&if_none_match, move || {
        let page = question.select(answer.context.features(collection)).map_err(|VanishedFeature| {
            Problem::parameter("after", "is not in the collection any more: begin again with the first page")
        })?;
        Ok(answer.page(&query, &page))
    })
    .await
}

/// `/v1/maps/{mapId}/collections/{collectionId}/items/{featureId}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
#[allow(clippy::struct_field_names, reason = "they are the names in the path")]
pub struct FeaturePath {
    /// The map.
    pub map_id: Id,
    /// The collection.
    pub collection_id: CollectionId,
    /// The feature: a number, or the code of a location.
    #[param(example = "5")]
    pub feature_id: String,
}

/// How to write a feature.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct ItemQuery {
    /// System of the coordinates of the answer; CRS84 when absent.
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    pub crs: CrsName,
}

impl ItemQuery {
    /// From the map frame to the coordinates of the answer.
    ///
    /// # Errors
    /// 400 where the map does not answer in them.
    pub fn transform(&self, georeference: Option<Georeference>) -> Result<Transform, Problem> {
        self.crs.transform(georeference).map_err(|detail| Problem::parameter("crs", detail))
    }
}

/// A feature
///
/// Locations go by their code.
#[utoipa::path(get, path = "/v1/maps/{mapId}/collections/{collectionId}/items/{featureId}", tag = "features",
    operation_id = "getFeature", params(FeaturePath, ItemQuery),
    responses((status = 200, description = "The feature", 
        content((FeatureView = "application/geo+json"), (FeatureView = "application/fg+json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the map, its analysis and its labels"),
            ("Content-Crs" = Option<String>, description = "System of the coordinates"))),
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
    let (crs, transform) = (parameters.crs, parameters.transform(context.record.georeference)?);
    let tag = tag(&context, format);
    let answer = Answer { base, context, collection, format, crs, transform };
    off_the_runtime(move || {
        let response = feature(&answer, &id)?;
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
pub fn feature(answer: &Answer, id: &str) -> Result<Response, Problem> {
    let wanted = CollectionSchema::of(answer.collection).feature_id(id).ok();
    let found = wanted.and_then(|wanted| query::find(answer.context.features(answer.collection), &wanted));
    found.map(|feature| answer.feature(feature)).ok_or_else(|| missing(answer.collection, id))
}

/// There is no such feature.
pub fn missing(collection: Collection, id: &str) -> Problem {
    Problem::not_found(format!("there is no feature {id} in {}", collection.id()))
}
