//! The features of a collection, page by page, as GeoJSON; the locations as a table too.

use std::sync::Arc;

use axum::extract::State;
use axum::http::{HeaderMap, HeaderName, HeaderValue, header};
use axum::response::{IntoResponse, Response};
use jiff::Timestamp;
use serde::Deserialize;
use utoipa::IntoParams;

use super::collections::{CollectionId, CollectionPath};
use super::items_query::{Format, ItemsQuery};
use crate::app::{App, Caller, MapContext};
use crate::blocking::off_the_runtime;
use crate::coordinates::Transform;
use crate::features::query::{self, FeatureQuery, Page, VanishedFeature};
use crate::features::{Collection, CollectionSchema};
use crate::formats::{csv, geojson};
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::crs::CrsName;
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{Path, Query};
use crate::http::links::{Base, CSV, GEO_JSON, JSON, encode, header as link_header};
use crate::http::problem::Problem;
use crate::views::feature::{FeatureCollectionView, FeatureView};
use crate::views::id::Id;
use crate::views::link::Link;

/// The header of OGC API Features part 2.
pub const CONTENT_CRS: HeaderName = HeaderName::from_static("content-crs");

/// Features of a collection
///
/// A page of features, ascending by id unless `sortby` says otherwise. The coordinates are longitude and latitude unless
/// `crs` says otherwise; of a map without georeference those of EPSG:3857 are the metres of the map frame. Pages go on
/// after an id, so that nothing is skipped or repeated when the map changes between them.
#[utoipa::path(get, path = "/v1/maps/{mapId}/collections/{collectionId}/items", tag = "features",
    operation_id = "getFeatures", params(CollectionPath, ItemsQuery),
    responses((status = 200, description = "A page of features",
        content((FeatureCollectionView = "application/geo+json"), (String = "text/csv")),
        headers(("ETag" = String, description = "Changes with the map, its analysis and its labels"),
            ("Content-Crs" = String, description = "System of the coordinates"),
            ("Link" = Option<String>, description = "The next page"))),
        NotFound, NotAnalysed))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<CollectionPath>,
    Query(query): Query<ItemsQuery>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let collection = path.collection_id.0;
    let format = query.format(collection, &accept)?;
    let context = app.context(&caller, path.map_id.0).await?;
    let question = query.question(collection, format, context.record.georeference)?;
    let kind = if format == Format::Csv { "items.csv" } else { "items" };
    let answer = Answer { base, context: Arc::clone(&context), collection, query, format };
    let tag = EntityTag::of_map(kind, &context);
    tag.answer_computed(&if_none_match, move || answer.write(&question)).await
}

/// A page on its way to the client.
struct Answer {
    base: Base,
    context: Arc<MapContext>,
    collection: Collection,
    query: ItemsQuery,
    format: Format,
}

impl Answer {
    fn write(&self, question: &FeatureQuery) -> Result<Response, Problem> {
        let page = question.select(self.context.features(self.collection)).map_err(|VanishedFeature| {
            Problem::parameter("after", "is not in the collection any more: begin again with the first page")
        })?;
        Ok(match self.format {
            Format::Json => self.geojson(&page),
            Format::Csv => self.csv(&page),
        })
    }

    fn geojson(&self, page: &Page<'_>) -> Response {
        let next = self.next(page);
        let collection_path = collection_path(&self.context, self.collection);
        let mut links = vec![
            self.base.link("self", &self.page_path(self.query.after()), GEO_JSON),
            self.base.link("collection", &collection_path, JSON),
        ];
        if self.collection == Collection::Locations {
            links.push(self.base.link("alternate", &format!("{collection_path}/items?f=csv"), CSV));
        }
        links.extend(next.clone());
        let transform = Transform::new(self.query.crs(), self.context.record.georeference);
        let body = geojson::feature_collection(
            page.features.iter().copied(),
            &transform,
            &[
                ("numberMatched", &page.matched),
                ("numberReturned", &page.features.len()),
                ("timeStamp", &Timestamp::now()),
                ("links", &links),
            ],
        );
        let mut headers = headers(CrsName(self.query.crs()));
        headers.extend(next.iter().map(|link| (header::LINK, link_header(link))));
        (headers, body).into_response()
    }

    /// The positions of the table are map-frame metres, whatever the request says of coordinates.
    fn csv(&self, page: &Page<'_>) -> Response {
        let mut headers = HeaderMap::new();
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static("text/csv; charset=utf-8"));
        let name = HeaderValue::from_static("attachment; filename=\"locations.csv\"");
        headers.insert(header::CONTENT_DISPOSITION, name);
        headers.extend(self.next(page).iter().map(|link| (header::LINK, link_header(link))));
        (headers, csv::locations(page.features.iter().copied())).into_response()
    }

    /// The page after this one, in the same format.
    fn next(&self, page: &Page<'_>) -> Option<Link> {
        let last = page.features.last().filter(|_| page.has_more)?;
        let media_type = if self.format == Format::Csv { CSV } else { GEO_JSON };
        Some(self.base.link("next", &self.page_path(Some(&last.id.to_string())), media_type).titled("The next page"))
    }

    /// The address of a page of the same selection.
    fn page_path(&self, after: Option<&str>) -> String {
        format!(
            "{}/items?{}",
            collection_path(&self.context, self.collection),
            self.query.parameters(self.format, after)
        )
    }
}

fn collection_path(context: &MapContext, collection: Collection) -> String {
    format!("/v1/maps/{}/collections/{}", context.record.id, collection.id())
}

fn headers(crs: CrsName) -> HeaderMap {
    [(header::CONTENT_TYPE, HeaderValue::from_static(GEO_JSON)), (CONTENT_CRS, crs.header())].into_iter().collect()
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

/// A feature
///
/// Locations go by their code.
#[utoipa::path(get, path = "/v1/maps/{mapId}/collections/{collectionId}/items/{featureId}", tag = "features",
    operation_id = "getFeature", params(FeaturePath, ItemQuery),
    responses((status = 200, description = "The feature", body = FeatureView, content_type = "application/geo+json",
        headers(("ETag" = String, description = "Changes with the map, its analysis and its labels"),
            ("Content-Crs" = String, description = "System of the coordinates"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<FeaturePath>,
    Query(parameters): Query<ItemQuery>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let (collection, id) = (path.collection_id.0, path.feature_id);
    let context = app.context(&caller, path.map_id.0).await?;
    off_the_runtime(move || {
        let answer = feature_answer(&base, &context, collection, &id, parameters.crs)?;
        Ok(EntityTag::of_map("item", &context).answer(&if_none_match, || answer))
    })
    .await
}

/// A feature as an answer.
pub fn feature_answer(
    base: &Base,
    context: &MapContext,
    collection: Collection,
    id: &str,
    crs: CrsName,
) -> Result<Response, Problem> {
    let wanted = CollectionSchema::of(collection).feature_id(id).ok();
    let found = wanted.and_then(|wanted| query::find(context.features(collection), &wanted));
    let feature = found.ok_or_else(|| missing(collection, id))?;
    let path = collection_path(context, collection);
    let links =
        [base.link("self", &format!("{path}/items/{}", encode(id)), GEO_JSON), base.link("collection", &path, JSON)];
    let transform = Transform::new(crs.0, context.record.georeference);
    let body = geojson::feature(feature, &transform, &[("links", &links)]);
    Ok((headers(crs), body).into_response())
}

/// There is no such feature.
pub fn missing(collection: Collection, id: &str) -> Problem {
    Problem::not_found(format!("there is no feature {id} in {}", collection.id()))
}
