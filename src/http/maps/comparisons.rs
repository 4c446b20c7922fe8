//! What changed between two maps, two versions of the labels, or would change with another analysis.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;
use serde::Deserialize;
use utoipa::IntoParams;

use super::analyses::AnalysisPath;
use crate::app::{App, Caller};
use crate::blocking::off_the_runtime;
use crate::http::docs::refusals::{Conflict, NotAnalysed, NotFound};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{MapPath, Path, Query};
use crate::http::page;
use crate::http::problem::Problem;
use crate::views::comparison::{AnalysisComparisonView, LabelComparisonView, MapComparisonView};
use crate::views::id::Id;

/// `/v1/maps/{mapId}/compare/{otherId}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
pub struct PairPath {
    /// The map before.
    map_id: Id,
    /// The map now.
    other_id: Id,
}

/// Parameters of changes.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct ChangesQuery {
    /// A version of the labels; 0, the default, is the suggestion.
    #[serde(default)]
    #[param(value_type = Option<u64>, default = 0)]
    since: u64,
}

/// Compare two maps
///
/// Which storage locations were added, removed, moved, relabelled, filled or emptied from the first map to the second.
/// Maps that were not uploaded as one site are aligned first; maps of different sites are refused.
#[utoipa::path(get, path = "/v1/maps/{mapId}/compare/{otherId}", tag = "maps", operation_id = "compareMaps",
    params(PairPath),
    responses((status = 200, description = "What changed",
        content((MapComparisonView = "application/json"), (String = "text/html"))),
        NotFound, Conflict))]
pub async fn compare(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<PairPath>,
    accept: Accept,
) -> Result<Response, Problem> {
    let made = app.compare_maps(&caller, path.map_id.0, path.other_id.0).await?;
    let view = MapComparisonView::new(path.map_id, path.other_id, &made);
    Ok(page::answer(&accept, "Changes from one map to another", &view))
}

/// Changes since a version
///
/// Which faces have another label than under an earlier version of the labels, and what that changed about the storage
/// locations.
#[utoipa::path(get, path = "/v1/maps/{mapId}/changes", tag = "semantics", operation_id = "listChanges",
    params(MapPath, ChangesQuery),
    responses((status = 200, description = "What changed",
        content((LabelComparisonView = "application/json"), (String = "text/html"))),
        NotFound, Conflict))]
pub async fn changes(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    Query(query): Query<ChangesQuery>,
    accept: Accept,
) -> Result<Response, Problem> {
    let made = app.version_changes(&caller, path.map_id.0, query.since, None).await?;
    let view = off_the_runtime(move || LabelComparisonView::new(query.since, made)).await;
    Ok(page::answer(&accept, "Changes since a version of the labels", &view))
}

/// Changes of an analysis
///
/// What would be different if it was activated now: how many faces, and which storage locations, with the codes that they would
/// have. Nothing is different about the analysis in force.
#[utoipa::path(get, path = "/v1/maps/{mapId}/analyses/{analysisId}/changes", tag = "maps",
    operation_id = "listAnalysisChanges", params(AnalysisPath),
    responses((status = 200, description = "What would change",
        content((AnalysisComparisonView = "application/json"), (String = "text/html"))),
        NotFound, NotAnalysed))]
pub async fn of_analysis(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<AnalysisPath>,
    accept: Accept,
) -> Result<Response, Problem> {
    let made = app.analysis_changes(&caller, path.map_id.0, path.analysis_id.0).await?;
    let view = off_the_runtime(move || AnalysisComparisonView::new(&made)).await;
    Ok(page::answer(&accept, "Changes of an analysis", &view))
}
