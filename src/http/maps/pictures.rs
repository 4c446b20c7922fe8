//! Pictures of a map, in its own pixels.

use std::sync::Arc;

use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};

use crate::app::{App, Caller, MapContext};
use crate::http::docs::binary::Binary;
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::{MapPath, Path};
use crate::http::links::{PNG, SVG};
use crate::http::problem::Problem;
use crate::render;
use crate::views::id::Id;

/// Names, media types and titles of the pictures.
pub const NAMES: [(&str, &str, &str); 5] = [
    ("image.png", PNG, "The occupancy grid"),
    ("categories.png", PNG, "Categories of the cells"),
    ("regions.png", PNG, "Regions"),
    ("semantic.png", PNG, "Faces by label, cogency of the edges"),
    ("semantic.svg", SVG, "Faces by label, cogency of the edges, as shapes"),
];

/// Draws a picture of an analysed map, unless the client has it.
async fn picture(
    app: Arc<App>,
    caller: Caller,
    map: Id,
    if_none_match: IfNoneMatch,
    name: &'static str,
    media_type: &'static str,
    draw: fn(&MapContext) -> Vec<u8>,
) -> Result<Response, Problem> {
    let context = app.context(&caller, map.0).await?;
    let tag = EntityTag::of_map(name, &context);
    tag.answer_computed(&if_none_match, move || {
        Ok(([(header::CONTENT_TYPE, media_type)], draw(&context)).into_response())
    })
    .await
}

/// The map
///
/// The occupancy grid as `map_saver` draws it: free white, occupied black, unknown grey. It is there as soon as the map
/// is uploaded; thresholds of the options count once an analysis with them is in force.
#[utoipa::path(get, path = "/v1/maps/{mapId}/image.png", tag = "maps", operation_id = "getImage", params(MapPath),
    responses((status = 200, description = "The picture", body = Binary, content_type = "image/png",
        headers(("ETag" = String, description = "Changes with the picture"))),
        NotFound))]
pub async fn image(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let source = app.grid_source(&caller, path.map_id.0).await?;
    let thresholds = format!("{:?}", source.options);
    let tag = EntityTag::of_content(&["image.png", source.blob.as_str(), &thresholds]);
    let png = if if_none_match.has(&tag) { Vec::new() } else { app.read_grid(source, render::image).await? };
    Ok(tag.answer(&if_none_match, || ([(header::CONTENT_TYPE, PNG)], png).into_response()))
}

/// The categories
///
/// One colour per category of the cells; the palette index is the category + 1.
#[utoipa::path(get, path = "/v1/maps/{mapId}/categories.png", tag = "maps", operation_id = "getCategoriesImage",
    params(MapPath),
    responses((status = 200, description = "The picture", body = Binary, content_type = "image/png",
        headers(("ETag" = String, description = "Changes with the picture"))),
        NotFound, NotAnalysed))]
pub async fn categories(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let draw = |context: &MapContext| render::categories(&context.analysis);
    picture(app, caller, path.map_id, if_none_match, "categories.png", PNG, draw).await
}

/// The regions
///
/// Coloured over the dimmed map.
#[utoipa::path(get, path = "/v1/maps/{mapId}/regions.png", tag = "maps", operation_id = "getRegionsImage",
    params(MapPath),
    responses((status = 200, description = "The picture", body = Binary, content_type = "image/png",
        headers(("ETag" = String, description = "Changes with the picture"))),
        NotFound, NotAnalysed))]
pub async fn regions(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let draw = |context: &MapContext| render::regions(&context.analysis, &context.grid);
    picture(app, caller, path.map_id, if_none_match, "regions.png", PNG, draw).await
}

/// The semantic map
///
/// Drawn like the paper's Fig. 9: faces by label, cogency of the edges, a legend.
#[utoipa::path(get, path = "/v1/maps/{mapId}/semantic.png", tag = "maps", operation_id = "getSemanticImage",
    params(MapPath),
    responses((status = 200, description = "The picture", body = Binary, content_type = "image/png",
        headers(("ETag" = String, description = "Changes with the picture"))),
        NotFound, NotAnalysed))]
pub async fn semantic(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let draw = |MapContext { grid, analysis, semantic, layout, .. }: &MapContext| {
        render::semantic_png(grid, analysis, semantic, &layout.locations)
    };
    picture(app, caller, path.map_id, if_none_match, "semantic.png", PNG, draw).await
}

/// The semantic map, as SVG
///
/// The same picture as shapes: it can be enlarged, and tells the label and the code of a face under the pointer.
#[utoipa::path(get, path = "/v1/maps/{mapId}/semantic.svg", tag = "maps", operation_id = "getSemanticDrawing",
    params(MapPath),
    responses((status = 200, description = "The picture", body = String, content_type = "image/svg+xml",
        headers(("ETag" = String, description = "Changes with the picture"))),
        NotFound, NotAnalysed))]
pub async fn semantic_svg(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let draw = |MapContext { grid, analysis, semantic, layout, .. }: &MapContext| {
        render::semantic_svg(grid, analysis, semantic, &layout.locations)
    };
    picture(app, caller, path.map_id, if_none_match, "semantic.svg", SVG, draw).await
}
