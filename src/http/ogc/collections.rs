//! The collections of a map: what there is, how much of it, and where.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use stillage_core::Point;
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{ObjectBuilder, Schema, Type};
use utoipa::{IntoParams, PartialSchema, ToSchema};

use crate::app::{App, Caller, MapContext};
use crate::coordinates::{Crs, Transform};
use crate::features::{Collection, CollectionSchema};
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::crs::{CRS84, EPSG_3857};
use crate::http::extract::{MapPath, Path};
use crate::http::links::{Base, CSV, GEO_JSON, JSON};
use crate::http::problem::Problem;
use crate::views::id::Id;
use crate::views::link::Link;

/// A collection as a part of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct CollectionId(pub Collection);

impl PartialSchema for CollectionId {
    fn schema() -> RefOr<Schema> {
        let ids = Collection::ALL.map(Collection::id);
        ObjectBuilder::new().schema_type(Type::String).enum_values(Some(ids)).into()
    }
}

impl ToSchema for CollectionId {}

impl TryFrom<String> for CollectionId {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        Collection::find(&text).map(Self).ok_or("is no collection")
    }
}

/// `/v1/maps/{mapId}/collections/{collectionId}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
pub struct CollectionPath {
    /// The map.
    pub map_id: Id,
    /// The collection.
    pub collection_id: CollectionId,
}

/// A collection of features.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Collection)]
#[serde(rename_all = "camelCase")]
pub struct CollectionView {
    #[schema(example = "faces")]
    id: &'static str,
    title: &'static str,
    description: &'static str,
    /// `feature`
    item_type: &'static str,
    extent: Extent,
    /// The systems in which items can be asked for; the first is the default.
    crs: Vec<&'static str>,
    /// The system in which nothing is lost: of a map without georeference, the metres of the map frame.
    storage_crs: &'static str,
    /// Number of features.
    item_count: usize,
    links: Vec<Link>,
}

/// Where the features of a collection lie.
#[derive(Debug, Serialize, ToSchema)]
pub struct Extent {
    spatial: SpatialExtent,
}

/// A box in degrees.
#[derive(Debug, Serialize, ToSchema)]
pub struct SpatialExtent {
    /// West, south, east, north.
    #[schema(example = json!([[12.857, 56.663, 12.859, 56.664]]))]
    bbox: Vec<[f64; 4]>,
    crs: &'static str,
}

/// The collections of a map.
#[derive(Debug, Serialize, ToSchema)]
pub struct CollectionList {
    collections: Vec<CollectionView>,
    links: Vec<Link>,
}

impl CollectionView {
    fn new(base: &Base, context: &MapContext, collection: Collection) -> Self {
        let CollectionSchema { title, description, .. } = *CollectionSchema::of(collection);
        let path = format!("/v1/maps/{}/collections/{}", context.record.id, collection.id());
        // No query string: clients append to the address of the items.
        let mut links =
            vec![base.link("self", &path, JSON), base.link("items", &format!("{path}/items"), GEO_JSON).titled(title)];
        if collection == Collection::Locations {
            links.push(base.link("items", &format!("{path}/items"), CSV).titled("The locations as a table"));
        }
        Self {
            id: collection.id(),
            title,
            description,
            item_type: "feature",
            extent: Extent { spatial: SpatialExtent { bbox: vec![extent(context, collection)], crs: CRS84 } },
            crs: vec![CRS84, EPSG_3857],
            storage_crs: EPSG_3857,
            item_count: context.features(collection).len(),
            links,
        }
    }
}

/// The box around a collection in degrees; around the whole grid where the collection is empty.
fn extent(context: &MapContext, collection: Collection) -> [f64; 4] {
    let transform = Transform::new(Crs::Crs84, context.record.georeference);
    let frame = &context.analysis.frame;
    let (width, height) =
        (context.analysis.width as f64 * frame.resolution, context.analysis.height as f64 * frame.resolution);
    let grid =
        [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]].map(|corner| frame.to_map(Point::from(corner)));
    let boxes = context.features(collection).iter().map(|feature| feature.bounds.corners());
    let mut corners = boxes.flatten().peekable();
    let corners: Vec<Point> = if corners.peek().is_some() { corners.collect() } else { grid.to_vec() };
    let empty = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    corners.into_iter().map(|corner| transform.forward(corner)).fold(empty, |[west, south, east, north], [lon, lat]| {
        [west.min(lon), south.min(lat), east.max(lon), north.max(lat)]
    })
}

/// List collections
///
/// The collections of an analysed map.
#[utoipa::path(get, path = "/v1/maps/{mapId}/collections", tag = "features", operation_id = "listCollections",
    params(MapPath),
    responses((status = 200, description = "The collections", body = CollectionList,
        headers(("ETag" = String, description = "Changes with the map, its analysis and its labels"))),
        NotFound, NotAnalysed))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let tag = EntityTag::of_map("collections", &context);
    tag.answer_computed(&if_none_match, move || {
        let collections = Collection::ALL.map(|collection| CollectionView::new(&base, &context, collection));
        let links = vec![
            base.link("self", &format!("/v1/maps/{}/collections", path.map_id), JSON),
            base.link("up", &format!("/v1/maps/{}", path.map_id), JSON),
        ];
        Ok(Json(CollectionList { collections: collections.into(), links }).into_response())
    })
    .await
}

/// A collection
#[utoipa::path(get, path = "/v1/maps/{mapId}/collections/{collectionId}", tag = "features",
    operation_id = "getCollection", params(CollectionPath),
    responses((status = 200, description = "The collection", body = CollectionView,
        headers(("ETag" = String, description = "Changes with the map, its analysis and its labels"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<CollectionPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let tag = EntityTag::of_map("collection", &context);
    tag.answer_computed(&if_none_match, move || {
        Ok(Json(CollectionView::new(&base, &context, path.collection_id.0)).into_response())
    })
    .await
}
