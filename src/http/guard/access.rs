//! What a caller may ask for. The OpenAPI document says which scope an operation needs, and is obeyed here.

use std::collections::HashMap;
use std::sync::Arc;

use axum::extract::{MatchedPath, Request, State};
use axum::http::{Method, Uri, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use tokio::runtime::Handle;
use utoipa::openapi::OpenApi;
use utoipa::openapi::path::Operation;

use super::observe::RequestId;
use super::sign_in::NotSignedIn;
use crate::access::Scope;
use crate::app::{App, Caller, with_entry};
use crate::http::dashboard;
use crate::http::docs::openapi::operations;
use crate::http::docs::security;
use crate::http::problem::Problem;
use crate::records::AuditRecord;

/// Routes beside the document that need no key: the same bytes for everybody.
const OPEN_ROUTES: [&str; 3] = [dashboard::ASSET_PATH, "/docs", "/docs/{*rest}"];

/// What the document says of an operation.
#[derive(Debug)]
struct Rule {
    operation: String,
    /// `None` where it needs no key.
    scope: Option<Scope>,
}

/// What the middleware works with.
#[derive(Debug, Clone)]
pub struct AccessGuard {
    app: Arc<App>,
    rules: Arc<HashMap<(String, Method), Rule>>,
}

impl AccessGuard {
    /// The rules of a document that is complete.
    #[must_use]
    pub fn new(app: Arc<App>, document: &OpenApi) -> Self {
        let rule = |(path, method, operation): (&str, Method, &Operation)| {
            let (scope, operation) = (security::scope(operation), operation.operation_id.clone());
            ((path.to_owned(), method), Rule { operation: operation.unwrap_or_default(), scope })
        };
        Self { app, rules: Arc::new(operations(document).map(rule).collect()) }
    }

    /// The scope that a request to a route needs, and the name of its operation. A route that the document does not have needs
    /// the scope of its method, so that nothing is open by being forgotten.
    fn rule(&self, route: &str, method: &Method) -> Option<(Scope, String)> {
        let method = if *method == Method::HEAD { &Method::GET } else { method };
        match self.rules.get(&(route.to_owned(), method.clone())) {
            Some(rule) => rule.scope.map(|scope| (scope, rule.operation.clone())),
            None if OPEN_ROUTES.contains(&route) || *method == Method::OPTIONS => None,
            None => Some((security::scope_of_method(method.is_safe()), route.to_owned())),
        }
    }
}

/// Middleware: refuses whoever has no key (401), or one without the scope that the operation needs (403), and records what was
/// changed by whom. Where there is no route there is nothing to guard.
pub async fn allowed(
    State(guard): State<AccessGuard>,
    route: Option<MatchedPath>,
    request: Request,
    next: Next,
) -> Response {
    let Some((scope, operation)) = route.as_ref().and_then(|route| guard.rule(route.as_str(), request.method())) else {
        return next.run(request).await;
    };
    let extensions = request.extensions();
    let Some(caller) = extensions.get::<Caller>().cloned() else {
        let reason = extensions.get::<NotSignedIn>().map(|reason| reason.0.clone());
        return reason.unwrap_or_else(Problem::key_required).into_response();
    };
    if scope != Scope::Write {
        return if caller.may(scope) { next.run(request).await } else { Problem::missing_scope(scope).into_response() };
    }
    let pending = PendingChange::new(&guard.app, &caller, operation, &request);
    let response = if caller.may(scope) {
        pending.carry_out(next.run(request)).await
    } else {
        Problem::missing_scope(scope).into_response()
    };
    pending.answered(response.status().as_u16(), made(&response)).await;
    response
}

/// A change that is under way. It is recorded, too, where its client does not wait for the answer, whatever became of it.
struct PendingChange {
    app: Arc<App>,
    /// `None` where no log is kept, and once the answer is recorded.
    entry: Option<AuditRecord>,
}

impl PendingChange {
    fn new(app: &Arc<App>, caller: &Caller, operation: String, request: &Request) -> Self {
        let id = request.extensions().get::<RequestId>().and_then(|id| id.0.to_str().ok()).unwrap_or_default();
        let entry = app.entry_of(caller, operation, request.uri().path().to_owned(), id.to_owned());
        Self { app: Arc::clone(app), entry }
    }

    /// What it writes and its entry are stored together.
    async fn carry_out(&self, change: impl Future<Output = Response>) -> Response {
        match &self.entry {
            Some(entry) => with_entry(entry.clone(), change).await,
            None => change.await,
        }
    }

    /// Records what was answered, and the path of what was made.
    async fn answered(mut self, status: u16, made: Option<String>) {
        if let Some(entry) = self.entry.take() {
            let resource = made.unwrap_or(entry.resource);
            self.app.record_answer(&AuditRecord { resource, status, ..entry }).await;
        }
    }
}

impl Drop for PendingChange {
    fn drop(&mut self) {
        let (Some(entry), Ok(runtime)) = (self.entry.take(), Handle::try_current()) else { return };
        let app = Arc::clone(&self.app);
        runtime.spawn(async move { app.record_answer(&entry).await });
    }
}

/// The path of what a request made.
fn made(response: &Response) -> Option<String> {
    let location: Uri = response.headers().get(header::LOCATION)?.to_str().ok()?.parse().ok()?;
    Some(location.path().to_owned())
}
