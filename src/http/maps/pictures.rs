//! Pictures of a map, in its own pixels.

use std::sync::Arc;

use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};

use crate::app::{App, Caller, MapContext};
use crate::http::extract::conditional::IfNoneMatch;
use crate::http::extract::{Id, MapPath, Path};
use crate::http::links::PNG;
use crate::http::ogc::collections::{off_the_runtime, tag};
use crate::http::problem::Problem;
use crate::render;

/// Names and titles of the pictures.
pub const NAMES: [(&str, &str); 4] = [
    ("image.png", "The occupancy grid"),
    ("categories.png", "Categories of the cells"),
    ("regions.png", "Regions"),
    ("semantic.png", "Faces by label, cogency of the edges"),
];

/// Draws a picture of an analysed map, unless the client has it.
async fn picture(
    app: Arc<App>,
    caller: Caller,
    map: Id,
    if_none_match: IfNoneMatch,
    name: &'static str,
    draw: fn(&MapContext) -> Vec<u8>,
) -> Result<Response, Problem> {
    let context = app.context(&caller, map.0).await?;
    off_the_runtime(move || {
        let answer = || ([(header::CONTENT_TYPE, PNG)], draw(&context)).into_response();
        Ok(tag(name, &context).answer(&if_none_match, answer))
    })
    .await
}

/// The map
///
/// The occupancy grid as `map_saver` draws it: free white, occupied black, unknown grey.
#[utoipa::path(get, path = "/v1/maps/{mapId}/image.png", tag = "maps", operation_id = "getImage", params(MapPath),
    responses((status = 200, description = "The picture", body = Vec<u8>, content_type = "image/png",
        headers(("ETag" = String, description = "Changes with the picture")))))]
pub async fn image(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    picture(app, caller, path.map_id, if_none_match, "image.png", |context| render::image(&context.grid)).await
}

/// The categories
///
/// One colour per category of the cells; the palette index is the category + 1.
#[utoipa::path(get, path = "/v1/maps/{mapId}/categories.png", tag = "maps", operation_id = "getCategoriesImage",
    params(MapPath),
    responses((status = 200, description = "The picture", body = Vec<u8>, content_type = "image/png",
        headers(("ETag" = String, description = "Changes with the picture")))))]
pub async fn categories(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    picture(app, caller, path.map_id, if_none_match, "categories.png", |context| render::categories(&context.analysis))
        .await
}

/// The regions
///
/// Coloured over the dimmed map.
#[utoipa::path(get, path = "/v1/maps/{mapId}/regions.png", tag = "maps", operation_id = "getRegionsImage",
    params(MapPath),
    responses((status = 200, description = "The picture", body = Vec<u8>, content_type = "image/png",
        headers(("ETag" = String, description = "Changes with the picture")))))]
pub async fn regions(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let draw = |context: &MapContext| render::regions(&context.analysis, &context.grid);
    picture(app, caller, path.map_id, if_none_match, "regions.png", draw).await
}

/// The semantic map
///
/// Drawn like the paper's Fig. 9: faces by label, cogency of the edges, a legend.
#[utoipa::path(get, path = "/v1/maps/{mapId}/semantic.png", tag = "maps", operation_id = "getSemanticImage",
    params(MapPath),
    responses((status = 200, description = "The picture", body = Vec<u8>, content_type = "image/png",
        headers(("ETag" = String, description = "Changes with the picture")))))]
pub async fn semantic(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let draw =
        |context: &MapContext| render::semantic(&context.grid, &context.cells, &context.analysis, &context.semantic);
    picture(app, caller, path.map_id, if_none_match, "semantic.png", draw).await
}
