//! What changed between two maps, and between two versions of the labels.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::app::{App, Caller};
use crate::blocking::off_the_runtime;
use crate::http::docs::refusals::{Conflict, NotFound};
use crate::http::extract::{MapPath, Path, Query};
use crate::http::problem::Problem;
use crate::views::comparison::{LabelComparisonView, MapComparisonView};
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
    responses((status = 200, description = "What changed", body = MapComparisonView),
        NotFound, Conflict))]
pub async fn compare(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<PairPath>,
) -> Result<Json<MapComparisonView>, Problem> {
    let made = app.compare_maps(&caller, path.map_id.0, path.other_id.0).await?;
    Ok(Json(MapComparisonView::new(path.map_id, path.other_id, &made)))
}

/// Changes since a version
///
/// Which faces have another label than under an earlier version of the labels, and what that changed about the storage
/// locations.
#[utoipa::path(get, path = "/v1/maps/{mapId}/changes", tag = "semantics", operation_id = "listChanges",
    params(MapPath, ChangesQuery),
    responses((status = 200, description = "What changed", body = LabelComparisonView),
        NotFound, Conflict))]
pub async fn changes(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    Query(query): Query<ChangesQuery>,
) -> Result<Json<LabelComparisonView>, Problem> {
    let made = app.version_changes(&caller, path.map_id.0, query.since, None).await?;
    Ok(Json(off_the_runtime(move || LabelComparisonView::new(query.since, made)).await))
}
