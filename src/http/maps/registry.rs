//! The codes and names of a site's places.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::response::Response;

use crate::app::{App, Caller};
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{JsonBody, MapPath, Path};
use crate::http::links::{Base, JSON};
use crate::http::page;
use crate::http::problem::Problem;
use crate::views::registry::{ConfirmationBody, RegistryView};

async fn view(app: &App, caller: &Caller, base: &Base, path: &MapPath) -> Result<RegistryView, Problem> {
    let (site, to_site) = app.registry(caller, path.map_id.0).await?;
    let links = vec![
        base.link("self", &format!("/v1/maps/{}/registry", path.map_id), JSON),
        base.link("up", &format!("/v1/maps/{}", path.map_id), JSON),
    ];
    Ok(RegistryView::new(site, &to_site, links))
}

/// Codes of a site's places
///
/// Codes stay with their places through relabelling, another analysis and a new scan. A place that the newest map of the
/// site does not show is lost, and keeps its code; one that may be another is stale until somebody confirms it.
#[utoipa::path(get, path = "/v1/maps/{mapId}/registry", tag = "maps", operation_id = "getRegistry", params(MapPath),
    responses((status = 200, description = "The registry of the map's site",
        content((RegistryView = "application/json"), (String = "text/html"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    accept: Accept,
) -> Result<Response, Problem> {
    Ok(page::answer(&accept, "Codes of a site's places", &view(&app, &caller, &base, &path).await?))
}

/// Confirm stale codes
///
/// Says that stale places are where the newest map of the site shows them: those with the `codes`, or all.
#[utoipa::path(post, path = "/v1/maps/{mapId}/registry/confirm", tag = "maps", operation_id = "confirmCodes",
    params(MapPath), request_body = ConfirmationBody,
    responses((status = 200, description = "The registry as it is now", body = RegistryView),
        NotFound, NotAnalysed))]
pub async fn confirm(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    JsonBody(body): JsonBody<ConfirmationBody>,
) -> Result<Json<RegistryView>, Problem> {
    app.confirm_codes(&caller, path.map_id.0, body.codes).await?;
    view(&app, &caller, &base, &path).await.map(Json)
}
