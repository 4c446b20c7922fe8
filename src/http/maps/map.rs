//! Maps: upload, list, landing page, rename, georeference.

use std::sync::Arc;

use axum::Json;
use axum::extract::{Request, State};
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use utoipa::{IntoParams, ToSchema};

use super::{pictures, upload};
use crate::app::{App, Caller, MapPatch, MapRecord};
use crate::http::docs::refusals::{NoSpace, NotFound, NotSameSite};
use crate::http::extract::conditional::{EntityTag, IfMatch, IfNoneMatch};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::prefer::Prefer;
use crate::http::extract::{JsonBody, MapPath, Paging, Path, Query, present};
use crate::http::links::{Base, GEO_JSON, GEO_PACKAGE, HTML, JSON, OPENAPI_3_0};
use crate::http::ogc::jobs;
use crate::http::page::{self, Markup};
use crate::http::paging::{cut, next_header};
use crate::http::problem::Problem;
use crate::views::georeference::GeoreferenceView;
use crate::views::id::Id;
use crate::views::job::JobView;
use crate::views::link::Link;
use crate::views::map::{MapList, MapView};
use crate::views::name::Name;
use crate::views::occupancy_grid::OccupancyGridMessage;

/// The document of a map.
pub(super) fn view(base: &Base, map: MapRecord) -> MapView {
    let links = map_links(base, &map);
    MapView::new(map, links)
}

/// Everything below a map.
fn map_links(base: &Base, map: &MapRecord) -> Vec<Link> {
    let to = |rel, below: &str, media_type| base.link(rel, &format!("/v1/maps/{}{below}", map.id), media_type);
    let mut links = vec![
        to("self", "", JSON),
        to("alternate", "?f=html", HTML).titled("This map as a page"),
        to("service-desc", "/api", OPENAPI_3_0).titled("The API of this map"),
        base.link("service-doc", "/docs/", HTML).titled("The API reference"),
        to("conformance", "/conformance", JSON).titled("The standards that are met"),
        to("data", "/collections", JSON).titled("Faces, edges, locations and the other features"),
        to("related", "/analyses", JSON).titled("Analyses"),
        to("related", "/diagnostics", JSON).titled("Signals and timings of the analysis"),
        to("related", "/categories", JSON).titled("Categories with suggested labels"),
        to("related", "/semantics", JSON).titled("Labels of the categories"),
        to("related", "/corrections", JSON).titled("Corrections"),
        to("related", "/registry", JSON).titled("Codes and names of the site's places"),
        to("related", "/changes", JSON).titled("What changed since a version of the labels"),
        to("version-history", "/semantics/versions", JSON).titled("Versions of the labels"),
        to("related", "/exports", JSON).titled("Files for fleet managers, planners and inventory systems"),
        to("enclosure", "/exports/map.gpkg", GEO_PACKAGE).titled("All collections as a GeoPackage"),
        to("related", "/routes", GEO_JSON).titled("Routes between two places"),
        to("related", "/graph-report", JSON).titled("Report on the navigation graph"),
    ];
    links.extend(pictures::NAMES.map(|(name, kind, title)| to("preview", &format!("/{name}"), kind).titled(title)));
    links.push(base.link("http://www.opengis.net/def/rel/ogc/1.0/job-list", "/v1/jobs", JSON).titled("The jobs"));
    links.push(base.link("up", "/v1/maps", JSON));
    links
}

/// Parameters of an upload.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct UploadQuery {
    /// Name for people. A message has no other place for it; in a form it stands before the part `name`.
    name: Option<Name>,
    /// Id of an earlier map of the same site. A message has no other place for it; in a form it stands before the part
    /// `previous`.
    previous: Option<Id>,
}

/// Upload a map
///
/// Stores the map and puts its analysis in the queue. As a form: `image` and `metadata` are the two files of
/// `map_server`. As JSON: a `nav_msgs/OccupancyGrid` message as rosbridge sends it, alone or in its envelope. As YAML: the
/// message as `ros2 topic echo --full-length --once` prints it. Bodies may be in gzip or zstd (`Content-Encoding`), parts of
/// forms in gzip or base64. Limits, which hold for what is sent and for what comes out of it: 128 MiB by default for the
/// image or the message, 64 KiB for `metadata` and `options`.
///
/// With `previous`, the map is aligned to an earlier one of the same site before it is stored: whatever its shift, turn and
/// resolution, and with other goods. Codes then stay with their places. Maps of different sites are refused.
#[utoipa::path(post, path = "/v1/maps", tag = "maps", operation_id = "createMap",
    params(UploadQuery,
        ("Idempotency-Key" = Option<String>, Header, min_length = 1, max_length = 255,
            description = "A key of the client's choice: the same key with the same content answers the same job")),
    request_body(content(
        (upload::MapUploadView = "multipart/form-data"),
        (OccupancyGridMessage = "application/json"),
        (String = "application/yaml", example = "info:\n  resolution: 0.05\n  width: 2\n  height: 1\n  origin:\n    position: {x: 0.0, y: 0.0, z: 0.0}\ndata: [0, 100]\n")),
        description = "The map"),
    responses(
        (status = 202, description = "Stored; the job will analyse it", body = JobView,
            headers(("Location" = String, description = "The job"),
                ("Idempotent-Replayed" = Option<String>, description = "`true` when the key had been seen before"))),
        NotSameSite, NoSpace))]
pub async fn create(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Query(query): Query<UploadQuery>,
    request: Request,
) -> Result<Response, Problem> {
    let prefers_async = Prefer::of(request.headers()).is_async;
    let mut map = upload::read(request, &app, query.name, &app.config().limits).await?;
    map.previous = query.previous.map(|id| id.0).or(map.previous);
    let (job, is_new) = app.create_map(&caller, map).await?;
    let mut response = jobs::accepted(&base, job);
    if !is_new {
        response.headers_mut().insert("idempotent-replayed", HeaderValue::from_static("true"));
    }
    if prefers_async {
        response.headers_mut().insert("preference-applied", HeaderValue::from_static("respond-async"));
    }
    Ok(response)
}

/// List maps
///
/// Newest first.
#[utoipa::path(get, path = "/v1/maps", tag = "maps", operation_id = "listMaps", params(Paging),
    responses((status = 200, description = "A page of maps",
        content((MapList = "application/json"), (String = "text/html")),
        headers(("Link" = Option<String>, description = "The next page")))))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Query(paging): Query<Paging>,
    accept: Accept,
) -> Result<Response, Problem> {
    let limit = paging.limit.0;
    let (maps, more) = cut(app.maps(&caller, limit + 1, paging.after.map(|id| id.0)).await?, limit);
    let next = maps.last().filter(|_| more).map(|last| format!("/v1/maps?limit={limit}&after={}", last.id));
    let next = next.map(|path| base.link("next", &path, JSON));
    let headers = next_header(next.as_ref());
    let own = [
        base.link("self", "/v1/maps", JSON),
        base.link("related", "/v1/deleted-maps", JSON).titled("Deleted maps that can be restored"),
    ];
    let links = own.into_iter().chain(next).collect();
    let maps = maps.into_iter().map(|map| view(&base, map)).collect();
    Ok((headers, page::answer(&accept, "Maps", &MapList { maps, links })).into_response())
}

/// A map
///
/// Its landing page: what it is, and links to all that can be asked of it.
#[utoipa::path(get, path = "/v1/maps/{mapId}", tag = "maps", operation_id = "getMap", params(MapPath),
    responses((status = 200, description = "The map", content((MapView = "application/json"), (String = "text/html")),
        headers(("ETag" = String, description = "Its version"))),
        NotFound))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let map = app.map(&caller, path.map_id.0).await?;
    if page::is_wanted(&accept) {
        // The tag is that of the JSON, which a write may name.
        return Ok(page::document(&map.name.clone(), &view(&base, map), &Markup::default()));
    }
    Ok(EntityTag::of_version(map.version).answer(&if_none_match, || Json(view(&base, map)).into_response()))
}

/// Changes to a map, as a JSON merge patch (RFC 7396).
#[derive(Debug, Deserialize, ToSchema)]
#[schema(as = MapPatch)]
#[serde(deny_unknown_fields)]
pub struct MapPatchBody {
    /// A new name.
    name: Option<Name>,
    /// Where the map lies on Earth; null makes it nominal.
    #[serde(default, deserialize_with = "present")]
    #[schema(value_type = Option<GeoreferenceView>)]
    #[allow(clippy::option_option, reason = "a merge patch tells absent from null")]
    georeference: Option<Option<GeoreferenceView>>,
}

/// Rename or georeference a map
///
/// With `If-Match` only if nobody else changed it since.
#[utoipa::path(patch, path = "/v1/maps/{mapId}", tag = "maps", operation_id = "updateMap",
    params(MapPath, ("If-Match" = Option<String>, Header, description = "The ETag that was read")),
    request_body(content((MapPatchBody = "application/merge-patch+json"), (MapPatchBody = "application/json"))),
    responses((status = 200, description = "The map as it is now", body = MapView,
        headers(("ETag" = String, description = "Its version"))),
        NotFound))]
pub async fn update(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    if_match: IfMatch,
    JsonBody(body): JsonBody<MapPatchBody>,
) -> Result<Response, Problem> {
    let id = path.map_id.0;
    let georeference = match body.georeference {
        Some(Some(georeference)) => Some(upload::stored(georeference)?),
        Some(None) => Some(None),
        None => None,
    };
    let version = app.map(&caller, id).await?.version;
    let if_match = if_match.against(&EntityTag::of_version(version), version)?;
    let patch = MapPatch { name: body.name.map(|name| name.0), georeference };
    let map = app.update_map(&caller, id, patch, if_match).await?;
    let tag = [(header::ETAG, EntityTag::of_version(map.version).header())];
    Ok((tag, Json(view(&base, map))).into_response())
}
