//! What changed from one version of the semantics to another.

use std::sync::Arc;

use axum::extract::State;
use axum::http::{HeaderValue, header};
use axum::response::Response;
use serde::Deserialize;
use utoipa::IntoParams;

use super::face_differences;
use super::semantics::VersionPath;
use crate::app::{App, Caller};
use crate::blocking::off_the_runtime;
use crate::http::docs::refusals::{Conflict, NotFound};
use crate::http::extract::crs::{CONTENT_CRS, CrsName};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{Limit, Path, Query};
use crate::http::links::GEO_JSON;
use crate::http::page;
use crate::http::problem::Problem;
use crate::views::face_difference::{DifferenceCounts, VersionChangesView};

/// Parameters of the changes of a version.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct VersionChangesQuery {
    /// The version before; 0, the default, is the suggestion.
    #[serde(default)]
    #[param(value_type = Option<u64>, default = 0)]
    since: u64,
    /// System of the coordinates of the answer; CRS84 when absent.
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
    /// Most features of the answer, and never more than 10,000; all of them are counted.
    #[serde(default)]
    #[param(value_type = Option<u32>, minimum = 1, default = 1000)]
    limit: Limit<1_000, 10_000>,
}

/// Changes of a version
///
/// The faces that labels and corrections added, removed, reshaped or relabelled from one version to another, counted and as
/// GeoJSON features. A face that has another shape is there twice: as it was (`isBefore`) and as it is. Both versions are of
/// the analysis in force.
#[utoipa::path(get, path = "/v1/maps/{mapId}/semantics/versions/{version}/changes", tag = "semantics",
    operation_id = "listVersionChanges", params(VersionPath, VersionChangesQuery),
    responses((status = 200, description = "What changed",
            content((VersionChangesView = "application/geo+json"), (String = "text/html")),
            headers(("Content-Crs" = String, description = "System of the coordinates"))),
        NotFound, Conflict))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<VersionPath>,
    Query(query): Query<VersionChangesQuery>,
    accept: Accept,
) -> Result<Response, Problem> {
    let made = app.version_changes(&caller, path.map_id.0, query.since, Some(path.version)).await?;
    let transform =
        query.crs.transform(made.now.record.georeference).map_err(|detail| Problem::parameter("crs", detail))?;
    let headers = [(header::CONTENT_TYPE, HeaderValue::from_static(GEO_JSON)), (CONTENT_CRS, query.crs.header())];
    let written = move || {
        let (since, version, counts) = (query.since, path.version, DifferenceCounts::of(&made.faces));
        let members = [("since", &since as _), ("version", &version as _), ("counts", &counts as _)];
        let of = (&*made.before, &*made.now);
        let written = face_differences::written(of, &made.faces, query.limit.0 as usize, &transform, &members);
        page::answer_geojson(&accept, "Changes of a version of the labels", headers, written)
    };
    Ok(off_the_runtime(written).await)
}
