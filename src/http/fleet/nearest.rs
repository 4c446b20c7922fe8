//! What is near a point.

use std::sync::Arc;

use axum::extract::State;
use axum::http::{HeaderValue, header};
use axum::response::Response;
use serde::{Deserialize, Serialize, Serializer};
use utoipa::IntoParams;

use super::outside;
use super::vehicle::Numbers;
use crate::app::{App, Caller};
use crate::coordinates::Transform;
use crate::features::query::{NearFeature, PropertySelection, nearest};
use crate::features::{Collection, Feature, rounded};
use crate::formats::geojson::{self, GeoJsonFeature};
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::crs::{CONTENT_CRS, CrsName};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{Limit, MapPath, Path, Query};
use crate::http::links::GEO_JSON;
use crate::http::ogc::collections::CollectionId;
use crate::http::ogc::filter::{self, FilterLanguage};
use crate::http::ogc::item_query::properties;
use crate::http::page;
use crate::http::problem::Problem;
use crate::views::feature::FeatureListView;

/// Most features of an answer.
const MAX_COUNT: u32 = 1_000;

/// A point, and what is looked for around it.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct NearestQuery {
    /// x and y in the coordinates of `crs`.
    #[param(value_type = String, pattern = "^-?[0-9]{1,9}([.][0-9]+)?,-?[0-9]{1,9}([.][0-9]+)?$", example = "0.00001,0.00002")]
    point: Numbers,
    /// Features of which collection; locations when absent.
    collection: Option<CollectionId>,
    /// How many features, and never more than 1,000.
    #[serde(default)]
    #[param(value_type = Option<u32>, minimum = 1, default = 1)]
    k: Limit<1, MAX_COUNT>,
    /// A condition on the features, in the language that `filter-lang` says; shapes in it have the coordinates of `crs`.
    #[param(max_length = 32_768, example = "label = 'pc'")]
    filter: Option<String>,
    /// The language of `filter`.
    #[serde(default, rename = "filter-lang")]
    #[param(value_type = Option<FilterLanguage>, rename = "filter-lang", inline)]
    filter_lang: FilterLanguage,
    /// Only these properties of the features; all when absent. They come in the order of the schema.
    #[param(value_type = Option<Vec<String>>, style = Form, explode = false, min_items = 1, example = json!(["label"]))]
    properties: Option<String>,
    /// System of all coordinates. CRS84 (longitude, latitude) when absent, as everywhere; `EPSG:3857` for the metres of the
    /// map frame (of a map without georeference).
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
}

/// What is nearest?
///
/// The features of a collection that are nearest to a point, the nearest first, each with its distance as the straight line
/// goes: `distanceM` among its properties, metres, 0 where the point lies in it. A point outside the map is a 404 that names
/// the nearest one inside.
#[utoipa::path(get, path = "/v1/maps/{mapId}/nearest", tag = "fleet", operation_id = "getNearest",
    params(MapPath, NearestQuery),
    responses((status = 200, description = "The features",
        content((FeatureListView = "application/geo+json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the map, its analysis, its labels and its names"),
            ("Content-Crs" = String, description = "System of the coordinates"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    Query(query): Query<NearestQuery>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let &[x, y] = query.point.0.as_slice() else {
        return Err(Problem::parameter("point", "must be x,y"));
    };
    let context = app.context(&caller, path.map_id.0).await?;
    let transform =
        query.crs.transform(context.record.georeference).map_err(|detail| Problem::parameter("crs", detail))?;
    let collection = query.collection.map_or(Collection::Locations, |collection| collection.0);
    let properties = properties(query.properties.as_deref(), collection)?;
    let filter = query.filter.as_deref();
    let filter = filter.map(|text| filter::filter(collection, text, query.filter_lang, &transform)).transpose()?;
    if !outside::is_inside(&context, &transform, [x, y]) {
        return Err(outside::refusal(&context, &transform, [x, y]));
    }
    let headers = [(header::CONTENT_TYPE, HeaderValue::from_static(GEO_JSON)), (CONTENT_CRS, query.crs.header())];
    EntityTag::of_map(&page::kind("nearest", &accept), &context)
        .answer_computed(&if_none_match, move || {
            let is_wanted = |feature: &&Feature| filter.as_ref().is_none_or(|filter| filter.selects(*feature));
            let features = context.features(collection).iter().filter(is_wanted);
            let near = nearest(features, transform.inverse([x, y]), query.k.0 as usize);
            let written = written(&near, &properties, &transform);
            Ok(page::answer_geojson(&accept, "Nearest features", headers, written))
        })
        .await
}

/// The properties of a feature, and its distance.
#[derive(Debug)]
struct PropertiesAndDistance<'a> {
    near: NearFeature<'a>,
    properties: &'a PropertySelection,
}

impl Serialize for PropertiesAndDistance<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let values = self.properties.values(self.near.feature).map(|(property, value)| (property.name, value));
        serializer.collect_map(values.chain([("distanceM", rounded(self.near.distance).into())]))
    }
}

fn written(near: &[NearFeature<'_>], properties: &PropertySelection, transform: &Transform) -> Vec<u8> {
    let told: Vec<_> = near.iter().map(|&near| PropertiesAndDistance { near, properties }).collect();
    let documents = told.iter().map(|told| GeoJsonFeature {
        id: Some(&told.near.feature.id),
        geometry: &told.near.feature.geometry,
        properties: told,
        members: &[],
    });
    geojson::document_collection(documents, transform, &[("numberReturned", &near.len())])
}
