//! Liveness and readiness, for whoever keeps the service running.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use serde::Serialize;
use utoipa::ToSchema;

use crate::app::App;
use crate::http::docs::refusals::NoSpace;
use crate::http::problem::Problem;

/// State of the service.
#[derive(Debug, Serialize, ToSchema)]
pub struct Health {
    /// `live` or `ready`.
    #[schema(example = "ready")]
    status: &'static str,
}

/// Liveness
///
/// Answers as long as the process can answer at all.
#[utoipa::path(get, path = "/health/live", tag = "service", operation_id = "getLiveness", security(()),
    responses((status = 200, description = "The process answers", body = Health)))]
pub async fn live() -> Json<Health> {
    Json(Health { status: "live" })
}

/// Readiness
///
/// 503 or 507 while the store does not answer, is not migrated, is short of space, or the service is stopping.
#[utoipa::path(get, path = "/health/ready", tag = "service", operation_id = "getReadiness", security(()),
    responses((status = 200, description = "The service takes work", body = Health),
        NoSpace))]
pub async fn ready(State(app): State<Arc<App>>) -> Result<Json<Health>, Problem> {
    app.ready().await?;
    Ok(Json(Health { status: "ready" }))
}
