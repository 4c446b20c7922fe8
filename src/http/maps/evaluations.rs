//! How well a map fits the truth of its site.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;

use crate::app::{App, AppError, Caller};
use crate::blocking::off_the_runtime;
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::{JsonBody, MapPath, Path};
use crate::http::problem::Problem;
use crate::ingest;
use crate::views::evaluation::EvaluationView;
use crate::views::truth::TruthBody;

/// Compare with the truth
///
/// How well the newest analysis fits what is known to be true: which places are found, how the areas of labels agree,
/// which orientations are right. Under the suggested labels, under one decision per category, and under the labels in
/// force where a person assigned them. Coordinates are metres of the map frame. Nothing is stored.
#[utoipa::path(post, path = "/v1/maps/{mapId}/evaluations", tag = "maps", operation_id = "evaluate", security(("key" = ["read"]), ()), params(MapPath),
    request_body(content = TruthBody, content_type = "application/geo+json"),
    responses((status = 200, description = "The figures", body = EvaluationView),
        NotFound, NotAnalysed))]
pub async fn create(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    JsonBody(document): JsonBody<serde_json::Value>,
) -> Result<Json<EvaluationView>, Problem> {
    let truth = off_the_runtime(move || ingest::ground_truth(&document)).await.map_err(AppError::from)?;
    let evaluation = app.evaluate(&caller, path.map_id.0, truth).await?;
    Ok(Json(EvaluationView::from(&evaluation)))
}
