//! The features of a collection, page by page, as GeoJSON; the locations as a table too.

use std::sync::Arc;

use axum::extract::State;
use axum::http::{HeaderMap, HeaderName, HeaderValue, header};
use axum::response::{IntoResponse, Response};
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use utoipa::{IntoParams, ToSchema};

use crate::app::{App, Caller, MapContext};
use crate::geojson::{Collection, Feature, FeatureId, MapView, Transform, locations_csv};
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::conditional::IfNoneMatch;
use crate::http::extract::crs::CrsName;
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{Id, Limit, Path, Query};
use crate::http::links::{Base, CSV, GEO_JSON, JSON, Link, encode};
use crate::http::ogc::bbox::{Bbox, Selection};
use crate::http::ogc::collections::{CollectionId, CollectionPath, off_the_runtime, tag};
use crate::http::problem::{Problem, ProblemType};

/// Longest id of a feature: codes of locations are far shorter.
const MAX_ID: usize = 64;
/// The header of OGC API Features part 2.
pub const CONTENT_CRS: HeaderName = HeaderName::from_static("content-crs");

/// Which features.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct ItemsQuery {
    /// Only features that meet this box: west, south, east, north (or with heights, which do not select).
    #[param(value_type = Option<Vec<f64>>, style = Form, explode = false, min_items = 4, max_items = 6)]
    bbox: Option<Bbox>,
    /// System of the coordinates of `bbox`; CRS84 when absent.
    #[serde(default, rename = "bbox-crs")]
    #[param(value_type = Option<CrsName>, rename = "bbox-crs")]
    bbox_crs: CrsName,
    /// System of the coordinates of the answer; CRS84 when absent.
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
    /// Most features of the answer.
    #[serde(default)]
    #[param(value_type = Option<u32>, minimum = 1, maximum = 10_000, default = 1000)]
    limit: Limit<1_000, 10_000>,
    /// Id of the last feature of the page before: taken from the `next` link.
    #[param(max_length = 64)]
    after: Option<String>,
    /// Format, where `Accept` cannot be set. Only the locations are served as CSV.
    #[param(inline)]
    f: Option<Format>,
}

/// Format of the items.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    Json,
    Csv,
}

/// Features in GeoJSON (RFC 7946).
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FeatureCollection)]
#[serde(rename_all = "camelCase")]
#[allow(dead_code, reason = "it describes what is written straight to bytes")]
pub struct FeatureCollectionView {
    /// `FeatureCollection`
    #[schema(example = "FeatureCollection")]
    r#type: String,
    /// Features that were selected.
    number_matched: usize,
    /// Features of this page.
    number_returned: usize,
    /// When the answer was made.
    #[schema(value_type = String, format = DateTime)]
    time_stamp: Timestamp,
    links: Vec<Link>,
    features: Vec<FeatureView>,
}

/// A feature in GeoJSON (RFC 7946). Its properties are those of its collection.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Feature)]
#[allow(dead_code, reason = "it describes what is written straight to bytes")]
pub struct FeatureView {
    /// `Feature`
    #[schema(example = "Feature")]
    r#type: String,
    /// A number; the code of a location.
    #[schema(value_type = FeatureIdView)]
    id: Value,
    /// A GeoJSON geometry: `Point`, `LineString`, `MultiLineString`, `Polygon` or `MultiPolygon`.
    #[schema(value_type = Object, example = json!({"type": "Point", "coordinates": [0.000012345, 0.000023456]}))]
    geometry: Value,
    #[schema(value_type = Object, example = json!({"label": "co", "labelName": "corridor", "areaM2": 61.2}))]
    properties: Value,
    #[serde(skip_serializing_if = "Option::is_none")]
    links: Option<Vec<Link>>,
}

/// Id of a feature.
#[derive(Debug, Serialize, ToSchema)]
#[serde(untagged)]
#[schema(as = FeatureId)]
#[allow(dead_code, reason = "it describes what is written straight to bytes")]
pub enum FeatureIdView {
    Number(u64),
    Text(String),
}

/// Features of a collection
///
/// A page of features, ascending by id. The coordinates are longitude and latitude unless `crs` says otherwise; of a map
/// without georeference those of EPSG:3857 are the metres of the map frame. Pages go on after an id, so that nothing is
/// skipped or repeated when the map changes between them.
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
    let format = match query.f {
        Some(Format::Csv) if collection != Collection::Locations => {
            return Err(Problem::parameter("f", "only the locations are served as CSV"));
        }
        Some(format) => format,
        None if collection == Collection::Locations && accept.prefers(CSV, GEO_JSON) => Format::Csv,
        None => Format::Json,
    };
    let context = app.context(&caller, path.map_id.0).await?;
    off_the_runtime(move || {
        let page = Page::select(&context, collection, &query)?;
        let kind = if format == Format::Csv { "items.csv" } else { "items" };
        Ok(tag(kind, &context).answer(&if_none_match, || match format {
            Format::Json => page.geojson(&base, &context, collection, &query),
            Format::Csv => page.csv(&base, &context, &query),
        }))
    })
    .await
}

/// A page of features.
struct Page<'a> {
    features: Vec<&'a Feature>,
    matched: usize,
    more: bool,
}

impl<'a> Page<'a> {
    fn select(context: &'a MapContext, collection: Collection, query: &ItemsQuery) -> Result<Self, Problem> {
        let transform = Transform::new(query.bbox_crs.0, context.record.georeference);
        let selection = query.bbox.map(|bbox| Selection::new(bbox, transform)).transpose();
        let selection = selection.map_err(|detail| Problem::parameter("bbox", detail))?;
        let after = query.after.as_deref().map(|text| feature_id(collection, text)).transpose();
        let after = after.map_err(|detail| Problem::parameter("after", detail))?;
        let matches = |feature: &&Feature| selection.as_ref().is_none_or(|selection| selection.matches(feature));
        let matched: Vec<&Feature> = context.features(collection).iter().filter(matches).collect();
        let start = after.map_or(0, |after| matched.partition_point(|feature| feature.id <= after));
        let end = matched.len().min(start + query.limit.0 as usize);
        Ok(Self { features: matched[start..end].to_vec(), matched: matched.len(), more: end < matched.len() })
    }

    /// The address of the page after this one.
    fn next(&self, base: &Base, context: &MapContext, collection: Collection, query: &ItemsQuery) -> Option<Link> {
        let last = self.features.last().filter(|_| self.more)?;
        let media_type = if query.f == Some(Format::Csv) { CSV } else { GEO_JSON };
        let path = query.path(context, collection, Some(&last.id.to_string()));
        Some(base.link("next", &path, media_type).titled("The next page"))
    }

    fn geojson(&self, base: &Base, context: &MapContext, collection: Collection, query: &ItemsQuery) -> Response {
        let transform = Transform::new(query.crs.0, context.record.georeference);
        let next = self.next(base, context, collection, query);
        let mut headers = headers(GEO_JSON, query.crs);
        headers.extend(next.iter().map(|link| (header::LINK, link.header())));
        let collection_path = format!("/v1/maps/{}/collections/{}", context.record.id, collection.id());
        let mut links = vec![
            base.link("self", &query.path(context, collection, query.after.as_deref()), GEO_JSON),
            base.link("collection", &collection_path, JSON),
        ];
        if collection == Collection::Locations {
            links.push(base.link("alternate", &format!("{collection_path}/items?f=csv"), CSV));
        }
        links.extend(next);
        let mut body = Vec::with_capacity(256 * self.features.len() + 1024);
        body.extend_from_slice(b"{\"type\":\"FeatureCollection\"");
        for (name, value) in [
            ("numberMatched", Value::from(self.matched)),
            ("numberReturned", Value::from(self.features.len())),
            ("timeStamp", Value::from(Timestamp::now().to_string())),
        ] {
            body.extend_from_slice(format!(",\"{name}\":{value}").as_bytes());
        }
        body.extend_from_slice(b",\"links\":");
        serde_json::to_writer(&mut body, &links).expect("links are plain data");
        body.extend_from_slice(b",\"features\":[");
        for (index, feature) in self.features.iter().enumerate() {
            body.extend_from_slice(if index == 0 { b"\n" } else { b",\n" });
            feature.write(&transform, &mut body);
        }
        body.extend_from_slice(b"\n]}\n");
        (headers, body).into_response()
    }

    fn csv(&self, base: &Base, context: &MapContext, query: &ItemsQuery) -> Response {
        let is_here =
            |code: &str| self.features.iter().any(|feature| matches!(&feature.id, FeatureId::Text(id) if id == code));
        let locations: Vec<_> = if self.features.len() == context.locations.len() {
            context.locations.clone()
        } else {
            context.locations.iter().filter(|location| is_here(&location.code)).cloned().collect()
        };
        let rows = locations_csv(&MapView { locations: &locations, ..context.view() });
        let mut headers = headers("text/csv; charset=utf-8", query.crs);
        // The positions of the table are map-frame metres, whatever the request says of coordinates.
        headers.remove(CONTENT_CRS);
        let next = self.next(base, context, Collection::Locations, query);
        headers.extend(next.iter().map(|link| (header::LINK, link.header())));
        let name = HeaderValue::from_static("attachment; filename=\"locations.csv\"");
        headers.insert(header::CONTENT_DISPOSITION, name);
        (headers, rows).into_response()
    }
}

impl ItemsQuery {
    /// The address of a page of the same selection.
    fn path(&self, context: &MapContext, collection: Collection, after: Option<&str>) -> String {
        let mut parameters = Vec::new();
        if let Some(bbox) = self.bbox {
            parameters.push(format!("bbox={bbox}"));
            parameters.push(format!("bbox-crs={}", encode(self.bbox_crs.uri())));
        }
        if self.crs != CrsName::default() {
            parameters.push(format!("crs={}", encode(self.crs.uri())));
        }
        parameters.push(format!("limit={}", self.limit.0));
        parameters.extend(after.map(|after| format!("after={}", encode(after))));
        if self.f == Some(Format::Csv) {
            parameters.push("f=csv".to_owned());
        }
        let query = parameters.join("&");
        format!("/v1/maps/{}/collections/{}/items?{query}", context.record.id, collection.id())
    }
}

fn headers(media_type: &'static str, crs: CrsName) -> HeaderMap {
    [(header::CONTENT_TYPE, HeaderValue::from_static(media_type)), (CONTENT_CRS, crs.header())].into_iter().collect()
}

/// Reads the id of a feature: the code of a location, or a number.
fn feature_id(collection: Collection, text: &str) -> Result<FeatureId, &'static str> {
    if collection == Collection::Locations {
        let fits = (1..=MAX_ID).contains(&text.len());
        return if fits { Ok(FeatureId::Text(text.to_owned())) } else { Err("is not the code of a location") };
    }
    let number = text.parse().ok().filter(|number: &u64| number.to_string() == text);
    number.map(FeatureId::Number).ok_or("is not the id of a feature")
}

/// `/v1/maps/{mapId}/collections/{collectionId}/items/{featureId}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
#[allow(clippy::struct_field_names, reason = "they are the names in the path")]
pub struct FeaturePath {
    /// The map.
    map_id: Id,
    /// The collection.
    collection_id: CollectionId,
    /// The feature: a number, or the code of a location.
    #[param(example = "5")]
    feature_id: String,
}

/// How to write a feature.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct ItemQuery {
    /// System of the coordinates of the answer; CRS84 when absent.
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
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
    Query(query): Query<ItemQuery>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let (collection, id) = (path.collection_id.0, path.feature_id);
    let context = app.context(&caller, path.map_id.0).await?;
    off_the_runtime(move || {
        let missing =
            || Problem::new(ProblemType::NotFound, format!("there is no feature {id} in {}", collection.id()));
        let wanted = feature_id(collection, &id).map_err(|_| missing())?;
        let features = context.features(collection);
        let found = features.binary_search_by(|feature| feature.id.cmp(&wanted)).map_err(|_| missing())?;
        Ok(tag("item", &context).answer(&if_none_match, || {
            let path = format!("/v1/maps/{}/collections/{}", context.record.id, collection.id());
            let links = [
                base.link("self", &format!("{path}/items/{}", encode(&id)), GEO_JSON),
                base.link("collection", &path, JSON),
            ];
            let mut body = Vec::new();
            features[found].write(&Transform::new(query.crs.0, context.record.georeference), &mut body);
            // A feature of its own carries links as one more member.
            body.pop();
            body.extend_from_slice(b",\"links\":");
            serde_json::to_writer(&mut body, &links).expect("links are plain data");
            body.extend_from_slice(b"}\n");
            (headers(GEO_JSON, query.crs), body).into_response()
        }))
    })
    .await
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_of_features_have_one_spelling() {
        assert_eq!(feature_id(Collection::Faces, "12"), Ok(FeatureId::Number(12)));
        for wrong in ["", "012", "+12", "-1", "x", "99999999999999999999"] {
            assert!(feature_id(Collection::Faces, wrong).is_err(), "{wrong}");
        }
        assert_eq!(feature_id(Collection::Locations, "03-012"), Ok(FeatureId::Text("03-012".to_owned())));
    }
}
