//! Who changed what.

use std::sync::Arc;

use axum::extract::State;
use axum::response::{IntoResponse, Response};

use crate::app::{App, Caller};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{Paging, Query};
use crate::http::links::{Base, JSON};
use crate::http::page;
use crate::http::paging::{cut, next_header};
use crate::http::problem::Problem;
use crate::views::audit::{AuditEntryView, AuditLogPage};

/// Log of changes
///
/// Who changed what and when, the newest first, with what was refused: every request of the tenant to an operation that needs the
/// scope `write`, and the keys that were made and revoked. A service without keys has none.
#[utoipa::path(get, path = "/v1/audit-log", tag = "service", operation_id = "listAuditEntries", params(Paging),
    security(("key" = ["admin"]), ()),
    responses((status = 200, description = "A page of the log",
        content((AuditLogPage = "application/json"), (String = "text/html")),
        headers(("Link" = Option<String>, description = "The next page")))))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Query(paging): Query<Paging>,
    accept: Accept,
) -> Result<Response, Problem> {
    let limit = paging.limit.0;
    let after = paging.after.map(|id| id.0);
    let (entries, more) = cut(app.changes_recorded(&caller, limit + 1, after).await?, limit);
    let next = entries.last().filter(|_| more).map(|last| format!("/v1/audit-log?limit={limit}&after={}", last.id));
    let next = next.map(|path| base.link("next", &path, JSON));
    let headers = next_header(next.as_ref());
    let links = std::iter::once(base.link("self", "/v1/audit-log", JSON)).chain(next).collect();
    let list = AuditLogPage { entries: entries.into_iter().map(AuditEntryView::from).collect(), links };
    Ok((headers, page::answer(&accept, "Log of changes", &list)).into_response())
}
