//! Names that people bring along.

use std::sync::Arc;

use axum::Json;
use axum::extract::{Request, State};
use serde::Deserialize;
use stillage_core::Point;
use utoipa::IntoParams;

use crate::app::{App, AppError, Caller, FieldProblem};
use crate::blocking::off_the_runtime;
use crate::formats::csv;
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::crs::CrsName;
use crate::http::extract::{self, MapPath, Path, Query, content_type, is_json, parse_json};
use crate::http::links::CSV;
use crate::http::problem::{Problem, ProblemType};
use crate::ingest::{self, IngestError};
use crate::views::names::{NameReportView, NamedPolygonsBody};

/// How names are read.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct NamesQuery {
    /// System of the coordinates. CRS84 (longitude, latitude) when absent, as everywhere; `EPSG:3857` for the metres of the
    /// map frame (of a map without georeference).
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
    /// Only tell what would happen.
    #[serde(default)]
    #[param(value_type = Option<bool>, default = false)]
    dry_run: bool,
}

/// Import names
///
/// Codes, names and groups from a table with the columns `x`, `y`, `code`, `name` and `groups` (separated by `|`), which name
/// the location under each point; or from labelled polygons, which name the location (place, aisle, row) that they cover
/// best. All or nothing: whatever is wrong is told with its row, and nothing is named then. The table may be that of
/// `GET …/collections/locations/items?f=csv` with other codes.
#[utoipa::path(post, path = "/v1/maps/{mapId}/names", tag = "maps", operation_id = "importNames",
    params(MapPath, NamesQuery),
    request_body(content((String = "text/csv", example = "x,y,code,name\n12.5,3.2,A-07-12,By the gate\n"),
        (NamedPolygonsBody = "application/geo+json"))),
    responses((status = 200, description = "What was named, or would be", body = NameReportView), NotFound, NotAnalysed))]
pub async fn create(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    Query(query): Query<NamesQuery>,
    request: Request,
) -> Result<Json<NameReportView>, Problem> {
    let is_table = content_type(request.headers()) == CSV;
    if !is_table && !is_json(request.headers()) {
        let detail = "send text/csv (x, y, code) or application/geo+json (labelled polygons)";
        return Err(Problem::new(ProblemType::UnsupportedMediaType, detail));
    }
    let bytes = extract::body(request, &app).await?;
    let map = app.map(&caller, path.map_id.0).await?;
    let transform = query.crs.transform(map.georeference).map_err(|detail| Problem::parameter("crs", detail))?;
    let rows = off_the_runtime(move || {
        let to_map = |position: [f64; 2]| -> Point { transform.inverse(position) };
        let rows = if is_table {
            ingest::name_table(&bytes, &csv::COLUMNS.map(|(name, _)| name), &to_map)
        } else {
            ingest::name_areas(&parse_json("", &bytes)?, &to_map)
        };
        rows.map_err(|errors| Problem::from(unreadable(errors)))
    })
    .await?;
    let report = app.import_names(&caller, map.id, rows, query.dry_run).await?;
    Ok(Json(NameReportView::new(report, query.dry_run)))
}

fn unreadable(errors: Vec<IngestError>) -> AppError {
    /// Problems that are told at most.
    const MOST_TOLD: usize = 100;
    let detail = format!("{} rows cannot be read: nothing was named", errors.len());
    let field = |error: IngestError| FieldProblem { pointer: error.pointer, detail: error.message };
    AppError::Invalid { detail, fields: errors.into_iter().take(MOST_TOLD).map(field).collect() }
}
