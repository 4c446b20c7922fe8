//! The exports of a map: the list of them, and each as a file.

use std::sync::Arc;

use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use utoipa::IntoParams;
use utoipa::openapi::path::{Parameter, ParameterBuilder, ParameterIn};
use utoipa::openapi::schema::{ObjectBuilder, Type};
use utoipa::openapi::{Required, Schema};

use crate::app::{App, Caller};
use crate::exports::{self, Export, ExportError, ExportKind, ExportOptions};
use crate::http::docs::binary::Binary;
use crate::http::docs::refusals::{Conflict, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{MapPath, Path, Query};
use crate::http::links::{Base, JSON, encode};
use crate::http::page;
use crate::http::problem::{Problem, ProblemType};
use crate::views::export::{ExportList, ExportView};
use crate::views::id::Id;

/// The archive that vehicles fetch.
const BUNDLE: &str = "bundle.zip";

/// List exports
///
/// Files that other programs read: fleet managers, planners, inventory systems, tools for graphs and maps. Each with its
/// media type, what it is for, and the query parameters that it takes.
#[utoipa::path(get, path = "/v1/maps/{mapId}/exports", tag = "fleet", operation_id = "listExports", params(MapPath),
    responses((status = 200, description = "The exports",
        content((ExportList = "application/json"), (String = "text/html"))),
        NotFound))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    accept: Accept,
) -> Result<Response, Problem> {
    let map = app.map(&caller, path.map_id.0).await?.id;
    let view = |export: &'static Export| {
        ExportView::new(export, base.link("enclosure", &file_path(map, export.name), export.media_type))
    };
    let list = ExportList {
        exports: exports::list().iter().map(view).collect(),
        links: vec![
            base.link("self", &format!("/v1/maps/{map}/exports"), JSON),
            base.link("up", &format!("/v1/maps/{map}"), JSON),
        ],
    };
    Ok(page::answer(&accept, "Exports", &list))
}

fn file_path(map: uuid::Uuid, file: &str) -> String {
    format!("/v1/maps/{map}/exports/{file}")
}

/// `/v1/maps/{mapId}/exports/{file}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
pub struct ExportPath {
    /// The map.
    map_id: Id,
    /// Name of the file: one of those that the list of exports has.
    #[param(example = "lif.json")]
    file: String,
}

/// The options of all exports, as parameters of the query: each file takes some of them.
struct ExportParameters;

impl IntoParams for ExportParameters {
    fn into_params(_: impl Fn() -> Option<ParameterIn>) -> Vec<Parameter> {
        let parameter = |option: &exports::ExportOption| {
            let files = exports::list().iter().filter(|export| export.options.contains(&option.name));
            let files: Vec<&str> = files.map(|export| export.name).collect();
            let schema = ObjectBuilder::new().schema_type(Type::String).examples([option.example]).build();
            ParameterBuilder::new()
                .name(option.name)
                .parameter_in(ParameterIn::Query)
                .required(Required::False)
                .description(Some(format!("{}. Of {}.", option.description, files.join(", "))))
                .schema(Some(Schema::Object(schema)))
                .build()
        };
        exports::options().iter().map(parameter).collect()
    }
}

/// Download an export
///
/// A file as another program reads it. The same version of the map with the same options gives the same bytes. A parameter
/// that the file does not take is refused.
#[utoipa::path(get, path = "/v1/maps/{mapId}/exports/{file}", tag = "fleet", operation_id = "getExport",
    params(ExportPath, ExportParameters),
    responses((status = 200, description = "The file",
        content((serde_json::Value = "application/json"), (serde_json::Value = "application/geo+json"),
            (String = "application/yaml"), (String = "text/csv; charset=utf-8"), (String = "text/plain; charset=utf-8"),
            (String = "application/graphml+xml"), (Binary = "application/zip"), (Binary = "application/flatgeobuf"),
            (Binary = "application/geopackage+sqlite3"),
            (Binary = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet")),
        headers(("ETag" = String, description = "Changes with the map, its analysis, its labels and the options"),
            ("Content-Disposition" = String, description = "Name of the file"))),
        NotFound, Conflict))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<ExportPath>,
    Query(given): Query<Vec<(String, String)>>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let export = Export::find(&path.file).ok_or_else(|| unknown(&path.file))?;
    let pairs = given.iter().map(|(name, value)| (name.as_str(), value.as_str()));
    let mut options =
        ExportOptions::read(export, pairs).map_err(|problem| Problem::parameter(&problem.name, problem.detail))?;
    if export.kind == ExportKind::DownloadMap && options.link.is_none() {
        options.link = Some(bundle_link(&base, path.map_id.0, &given));
    }
    let context = app.context(&caller, path.map_id.0).await?;
    let tag = EntityTag::of_map(&format!("{} {options:?}", export.name), &context);
    tag.answer_computed(&if_none_match, move || {
        let bytes = context.export(export, &options).map_err(|reason| refusal(export, &reason))?;
        let name = format!("attachment; filename=\"{}\"", export.name);
        let headers = [(header::CONTENT_TYPE, export.media_type.to_owned()), (header::CONTENT_DISPOSITION, name)];
        Ok((headers, bytes).into_response())
    })
    .await
}

/// Where this service has the bundle with the same options.
fn bundle_link(base: &Base, map: uuid::Uuid, given: &[(String, String)]) -> String {
    let of_bundle = Export::find(BUNDLE).map_or(&[][..], |bundle| bundle.options);
    let options = given.iter().filter(|(name, _)| of_bundle.contains(&name.as_str()));
    let options: Vec<String> = options.map(|(name, value)| format!("{name}={}", encode(value))).collect();
    let query = if options.is_empty() { String::new() } else { format!("?{}", options.join("&")) };
    base.link("enclosure", &format!("{}{query}", file_path(map, BUNDLE)), "application/zip").href
}

fn unknown(file: &str) -> Problem {
    let known: Vec<&str> = exports::list().iter().map(|export| export.name).collect();
    Problem::not_found(format!("there is no export {file}; there are {}", known.join(", ")))
}

fn refusal(export: &Export, reason: &ExportError) -> Problem {
    match reason {
        ExportError::UnknownLabel { option, .. } => Problem::parameter(option, reason.to_string()),
        ExportError::NoLink => Problem::parameter("link", "is missing: say where vehicles fetch bundle.zip"),
        ExportError::NoLanes | ExportError::TooManyRows { .. } => {
            Problem::new(ProblemType::Conflict, format!("{} cannot be written: {reason}", export.name))
        }
    }
}
