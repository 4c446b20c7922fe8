//! What a change of labels and corrections would do, without doing it.

use std::sync::Arc;

use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use utoipa::IntoParams;

use super::face_differences;
use super::semantics::in_list;
use super::semantics_body::{self, SemanticsPatchBody};
use crate::app::{App, Caller, LabelPreview};
use crate::blocking::off_the_runtime;
use crate::coordinates::Transform;
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::crs::{CONTENT_CRS, CrsName};
use crate::http::extract::{JsonBody, Limit, MapPath, Path, Query};
use crate::http::links::GEO_JSON;
use crate::http::problem::Problem;
use crate::views::carried::LostLabelView;
use crate::views::correction::ListedCorrection;
use crate::views::face_difference::DifferenceCounts;
use crate::views::label_preview::{LabelPreviewView, PreviewCounts};

/// Parameters of a preview.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct PreviewQuery {
    /// System of the coordinates of the answer; CRS84 when absent.
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
    /// Most features of the answer, and never more than 10,000; all of them are counted.
    #[serde(default)]
    #[param(value_type = Option<u32>, minimum = 1, default = 1000)]
    limit: Limit<1_000, 10_000>,
}

/// Preview labels
///
/// What a change of labels and corrections would do, which is as in `PATCH …/semantics` (labels as they are read may be sent,
/// too, and a rule set that is not stored in the place of its id): counts of faces, locations, edges and links before and
/// after, whether the corrections fit, and the faces that would be added, removed, reshaped or relabelled as GeoJSON features
/// with `label` and `previousLabel`. Corrections that do not fit are told, not refused. Nothing is stored.
#[utoipa::path(post, path = "/v1/maps/{mapId}/semantics/preview", tag = "semantics", operation_id = "previewSemantics", security(("key" = ["read"]), ()),
    params(MapPath, PreviewQuery),
    request_body(content((SemanticsPatchBody = "application/json"),
        (SemanticsPatchBody = "application/merge-patch+json"))),
    responses((status = 200, description = "What would change", body = LabelPreviewView,
            content_type = "application/geo+json",
            headers(("Content-Crs" = String, description = "System of the coordinates"))),
        NotFound, NotAnalysed))]
pub async fn create(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    Query(query): Query<PreviewQuery>,
    JsonBody(body): JsonBody<SemanticsPatchBody>,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let transform =
        query.crs.transform(context.record.georeference).map_err(|detail| Problem::parameter("crs", detail))?;
    let faces = body.listed_faces();
    let change = semantics_body::of_patch(body, &context)?;
    let preview = app.preview_semantics(&caller, context, change).await;
    let preview = preview.map_err(|error| in_list(faces)(Problem::from(error)))?;
    let headers = [(header::CONTENT_TYPE, GEO_JSON.parse().expect("is a header")), (CONTENT_CRS, query.crs.header())];
    let body = off_the_runtime(move || written(&preview, query.limit.0 as usize, &transform)).await;
    Ok((headers, body).into_response())
}

/// The GeoJSON of a preview with so many features.
fn written(preview: &LabelPreview, limit: usize, transform: &Transform) -> Vec<u8> {
    let LabelPreview { before, after, correction_ids, faces, lost } = preview;
    let (counts, differences) = (PreviewCounts::of(preview), DifferenceCounts::of(faces));
    let corrections = ListedCorrection::of_preview(correction_ids, after);
    let lost: Vec<LostLabelView> = lost.iter().cloned().map(Into::into).collect();
    let members = [
        ("counts", &counts as _),
        ("faces", &differences as _),
        ("corrections", &corrections as _),
        ("lost", &lost as _),
    ];
    face_differences::written((before, after), faces, limit, transform, &members)
}
