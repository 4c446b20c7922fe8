//! Maps are deleted, and restored for a while after that; what can be restored is listed.

use std::sync::Arc;

use axum::Json;
use axum::extract::{Request, State};
use axum::http::{StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use jiff::{RoundMode, TimestampRound, Unit};
use uuid::Uuid;

use super::map::view;
use crate::app::{App, Caller, DeletedMap};
use crate::http::docs::refusals::NotFound;
use crate::http::extract::conditional::{EntityTag, IfMatch};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{MapPath, Paging, Path, Query};
use crate::http::links::{Base, JSON};
use crate::http::page;
use crate::http::paging::{cut, next_header};
use crate::http::problem::Problem;
use crate::views::deleted_map::{DeletedMapList, DeletedMapView};
use crate::views::map::MapView;

/// Delete a map
///
/// Takes the map and all of it out of sight at once and stops its jobs. `POST …/restore` brings it back, an hour long unless the
/// service is configured otherwise; then everything is deleted. With `If-Match` only if nobody changed it since.
#[utoipa::path(delete, path = "/v1/maps/{mapId}", tag = "maps", operation_id = "deleteMap",
    params(MapPath, ("If-Match" = Option<String>, Header, description = "The ETag that was read")),
    responses((status = 204, description = "Deleted"),
        NotFound))]
pub async fn delete(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_match: IfMatch,
) -> Result<StatusCode, Problem> {
    let version = app.map(&caller, path.map_id.0).await?.version;
    let if_match = if_match.against(&EntityTag::of_version(version), version)?;
    app.delete_map(&caller, path.map_id.0, if_match).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// List deleted maps
///
/// Those that can still be restored, the newest map first.
#[utoipa::path(get, path = "/v1/deleted-maps", tag = "maps", operation_id = "listDeletedMaps", params(Paging),
    responses((status = 200, description = "A page of deleted maps",
        content((DeletedMapList = "application/json"), (String = "text/html")),
        headers(("Link" = Option<String>, description = "The next page")))))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Query(paging): Query<Paging>,
    accept: Accept,
) -> Result<Response, Problem> {
    let limit = paging.limit.0;
    let (maps, more) = cut(app.deleted_maps(&caller, limit + 1, paging.after.map(|id| id.0)).await?, limit);
    let next = maps.last().filter(|_| more);
    let next = next.map(|last| format!("/v1/deleted-maps?limit={limit}&after={}", last.map.id));
    let next = next.map(|path| base.link("next", &path, JSON));
    let headers = next_header(next.as_ref());
    let links = std::iter::once(base.link("self", "/v1/deleted-maps", JSON)).chain(next).collect();
    let view = |deleted: DeletedMap| {
        let restore = base.link("related", &format!("/v1/maps/{}/restore", deleted.map.id), JSON);
        DeletedMapView::new(deleted, vec![restore.titled("POST restores it")])
    };
    let list = DeletedMapList { maps: maps.into_iter().map(view).collect(), links };
    Ok((headers, page::answer(&accept, "Deleted maps", &list)).into_response())
}

/// Restore a map
///
/// Brings a deleted map back as it was, with its analyses, labels, names and jobs; what waited or ran goes on. A map that is
/// there stays as it is. `GET /v1/deleted-maps` lists what can be restored, and answers about a deleted map (404) say until when.
#[utoipa::path(post, path = "/v1/maps/{mapId}/restore", tag = "maps", operation_id = "restoreMap", params(MapPath),
    responses((status = 200, description = "The map", body = MapView,
        headers(("ETag" = String, description = "Its version"))),
        NotFound))]
pub async fn restore(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
) -> Result<Response, Problem> {
    let map = app.restore_map(&caller, path.map_id.0).await?;
    let tag = [(header::ETAG, EntityTag::of_version(map.version).header())];
    Ok((tag, Json(view(&base, map))).into_response())
}

/// Middleware: where nothing is below a map that was deleted, the refusal says how to restore it.
pub async fn tell_restorable(State(app): State<Arc<App>>, request: Request, next: Next) -> Response {
    let caller = request.extensions().get::<Caller>().cloned();
    let id = request.uri().path().strip_prefix("/v1/maps/").and_then(|rest| rest.split('/').next()?.parse().ok());
    let response = next.run(request).await;
    let (StatusCode::NOT_FOUND, Some(id), Some(caller)) = (response.status(), id, caller) else { return response };
    restorable(&app, &caller, id).await.map_or(response, IntoResponse::into_response)
}

/// The refusal about a deleted map.
async fn restorable(app: &App, caller: &Caller, id: Uuid) -> Option<Problem> {
    let until = app.restorable_until(caller, id).await.ok().flatten()?;
    let until = until.round(TimestampRound::new().smallest(Unit::Second).mode(RoundMode::Trunc)).unwrap_or(until);
    let detail = format!("map {id} was deleted: POST /v1/maps/{id}/restore brings it back until {until}");
    Some(Problem::not_found(detail))
}
