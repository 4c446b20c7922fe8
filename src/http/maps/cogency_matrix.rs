//! The cogency of every pair of labels of a rule set: JSON, a table for spreadsheets, or a page.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};

use super::rule_sets::{RuleSetPath, tag_of};
use crate::app::{App, AppError, Caller};
use crate::features::{Value, words};
use crate::formats::csv;
use crate::http::docs::refusals::NotFound;
use crate::http::extract::Path;
use crate::http::extract::conditional::IfNoneMatch;
use crate::http::extract::negotiation::Accept;
use crate::http::links::{Base, CSV, HTML, JSON};
use crate::http::page::{self, Markup};
use crate::http::problem::Problem;
use crate::views::cogency_matrix::{CogencyMatrixView, MatrixLabelView};

/// Cogency of every pair of labels
///
/// What an edge between two faces means, by their labels: an obstruction (`cogent`), where storage is reached
/// (`storage-access`), or nothing (`invalid`).
#[utoipa::path(get, path = "/v1/rule-sets/{ruleSetId}/matrix", tag = "semantics", operation_id = "getCogencyMatrix",
    params(RuleSetPath),
    responses((status = 200, description = "A row and a column for each label",
        content((CogencyMatrixView = "application/json"), (String = "text/html"), (String = "text/csv")),
        headers(("ETag" = String, description = "Changes with the rule set"))),
        NotFound))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<RuleSetPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let record = app.rule_set(&caller, &path.rule_set_id).await?;
    let rules = record.draft.clone().check().map_err(|problems| Problem::from(AppError::from(problems)))?;
    let format = accept.best(&[JSON, HTML, CSV]);
    let tag = tag_of(format, &record);
    let address = format!("/v1/rule-sets/{}/matrix", record.id);
    let links = vec![
        base.link("self", &address, JSON),
        base.link("alternate", &format!("{address}?f=html"), HTML).titled("This matrix as a page"),
        base.link("alternate", &format!("{address}?f=csv"), CSV).titled("This matrix as a table"),
        base.link("collection", &format!("/v1/rule-sets/{}", record.id), JSON).titled("The rule set"),
    ];
    let matrix = CogencyMatrixView::new(record.id, &rules, links);
    Ok(tag.answer(&if_none_match, || match format {
        HTML => page(&matrix),
        CSV => ([(header::CONTENT_TYPE, "text/csv; charset=utf-8")], table(&matrix)).into_response(),
        _ => Json(matrix).into_response(),
    }))
}

/// A row for each label, a column for each label.
fn table(matrix: &CogencyMatrixView) -> Vec<u8> {
    let names: Vec<&str> =
        std::iter::once("label").chain(matrix.labels.iter().map(|label| label.id.as_str())).collect();
    let rows = matrix.labels.iter().zip(&matrix.cogency).map(|(label, row)| {
        let cells = row.iter().map(|&cogency| Value::from(words::cogency(cogency)));
        std::iter::once(Value::from(label.id.as_str())).chain(cells).collect::<Vec<_>>()
    });
    csv::table(&names, rows)
}

/// The table with the names and colours of the labels.
fn page(matrix: &CogencyMatrixView) -> Response {
    let heads = |scope: &'static str| {
        let head = move |label: &MatrixLabelView| {
            let colour = format!("border-left:.5rem solid {};padding-left:.5rem", label.color);
            Markup::element("th", &[("scope", scope), ("style", &colour)], [page::text(&label.name)])
        };
        matrix.labels.iter().map(head).collect::<Vec<_>>()
    };
    let first = Markup::element("tr", &[], std::iter::once(Markup::element("td", &[], [])).chain(heads("col")));
    let rows = heads("row").into_iter().zip(&matrix.cogency).map(|(head, row)| {
        let cells = row.iter().map(|&cogency| Markup::element("td", &[], [page::text(words::cogency(cogency))]));
        Markup::element("tr", &[], std::iter::once(head).chain(cells))
    });
    let table = Markup::element("table", &[], std::iter::once(first).chain(rows));
    page::page("Cogency of every pair of labels", &[&table])
}
