//! The collections of a map: what there is, how much of it, and where.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;
use serde::{Deserialize, Serialize};
use stillage_core::Point;
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{ObjectBuilder, Schema, Type};
use utoipa::{IntoParams, PartialSchema, ToSchema};

use super::items_format::Format;
use crate::app::{App, Caller, MapContext};
use crate::coordinates::{Crs, Transform};
use crate::features::{Collection, CollectionSchema};
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::crs::{CRS84, CrsName};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{MapPath, Path};
use crate::http::links::{Base, FLAT_GEOBUF, GEO_PACKAGE, HTML, JSON, JSON_SCHEMA, encode};
use crate::http::page::{self, LinkedFeature, Markup};
use crate::http::problem::Problem;
use crate::views::id::Id;
use crate::views::link::Link;

/// Most features in the small map of a page: a browser draws them without delay.
const MOST_DRAWN: usize = 5_000;

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
    crs: Vec<String>,
    /// The system in which nothing is lost: of a map without georeference the metres of the map frame, else those of its
    /// UTM zone.
    storage_crs: String,
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
        let to = |rel, below: &str, media_type| base.link(rel, &format!("{path}{below}"), media_type);
        let mut links =
            vec![to("self", "", JSON), to("alternate", "?f=html", HTML).titled("This collection as a page")];
        // No query string: clients append to the address of the items.
        links.extend(Format::ALL.map(|format| to("items", "/items", format.media_type()).titled(format.title())));
        links.extend([
            to("enclosure", "/items?f=fgb", FLAT_GEOBUF).titled("The whole collection as a file"),
            to("http://www.opengis.net/def/rel/ogc/1.0/queryables", "/queryables", JSON_SCHEMA)
                .titled("What can be asked for"),
            to("http://www.opengis.net/def/rel/ogc/1.0/schema", "/schema", JSON_SCHEMA).titled("The properties"),
            to("describedby", "/schema", JSON_SCHEMA).titled("The properties"),
        ]);
        let systems = Crs::of_map(context.record.georeference).into_iter().map(|crs| CrsName(crs).uri());
        let crs: Vec<String> = systems.collect();
        Self {
            id: collection.id(),
            title,
            description,
            item_type: "feature",
            extent: Extent { spatial: SpatialExtent { bbox: vec![extent(context, collection)], crs: CRS84 } },
            storage_crs: crs.last().cloned().unwrap_or_default(),
            crs,
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
    responses((status = 200, description = "The collections",
        content((CollectionList = "application/json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the map, its analysis and its labels"))),
        NotFound, NotAnalysed))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let tag = EntityTag::of_map(&page::kind("collections", &accept), &context);
    tag.answer_computed(&if_none_match, move || {
        let collections = Collection::ALL.map(|collection| CollectionView::new(&base, &context, collection));
        let own = format!("/v1/maps/{}/collections", path.map_id);
        let links = vec![
            base.link("self", &own, JSON),
            base.link("alternate", &format!("{own}?f=html"), HTML).titled("The collections as a page"),
            base.link("enclosure", &format!("/v1/maps/{}/exports/map.gpkg", path.map_id), GEO_PACKAGE)
                .titled("All collections as a GeoPackage"),
            base.link("up", &format!("/v1/maps/{}", path.map_id), JSON),
        ];
        let title = format!("Collections of {}", context.record.name);
        Ok(page::answer(&accept, &title, &CollectionList { collections: collections.into(), links }))
    })
    .await
}

/// A collection
#[utoipa::path(get, path = "/v1/maps/{mapId}/collections/{collectionId}", tag = "features",
    operation_id = "getCollection", params(CollectionPath),
    responses((status = 200, description = "The collection",
        content((CollectionView = "application/json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the map, its analysis and its labels"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<CollectionPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let tag = EntityTag::of_map(&page::kind("collection", &accept), &context);
    tag.answer_computed(&if_none_match, move || {
        let collection = path.collection_id.0;
        let view = CollectionView::new(&base, &context, collection);
        if !page::is_wanted(&accept) {
            return Ok(page::answer(&accept, view.title, &view));
        }
        Ok(page::document(view.title, &view, &map_of(&base, &context, collection)))
    })
    .await
}

/// A small map of a collection, each feature with a link to its page.
fn map_of(base: &Base, context: &MapContext, collection: Collection) -> Markup {
    let path = format!("/v1/maps/{}/collections/{}/items", context.record.id, collection.id());
    let drawn = context.features(collection).iter().take(MOST_DRAWN).map(|feature| {
        let href = base.link("item", &format!("{path}/{}?f=html", encode(&feature.id.to_string())), HTML).href;
        LinkedFeature { feature, href }
    });
    page::drawing(&drawn.collect::<Vec<_>>())
}
