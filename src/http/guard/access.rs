//! What a caller may ask for. The OpenAPI document says which scope an operation needs, and is obeyed here.

use std::collections::HashMap;
use std::sync::Arc;

use axum::extract::{MatchedPath, Request, State};
use axum::http::Method;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use utoipa::openapi::OpenApi;

use super::sign_in::NotSignedIn;
use crate::access::Scope;
use crate::app::Caller;
use crate::http::dashboard;
use crate::http::docs::security;
use crate::http::problem::Problem;

/// Routes beside the document that need no key: the same bytes for everybody.
const OPEN_ROUTES: [&str; 3] = [dashboard::ASSET_PATH, "/docs", "/docs/{*rest}"];

/// The scope that each operation needs; none where it needs no key.
#[derive(Debug, Default)]
pub struct AccessRules(HashMap<(String, Method), Option<Scope>>);

impl AccessRules {
    /// The rules of a document that is complete.
    #[must_use]
    pub fn of(document: &OpenApi) -> Self {
        let mut rules = HashMap::new();
        for (path, item) in &document.paths.paths {
            let operations = [
                (Method::GET, &item.get),
                (Method::PUT, &item.put),
                (Method::POST, &item.post),
                (Method::PATCH, &item.patch),
                (Method::DELETE, &item.delete),
            ];
            for (method, operation) in operations {
                if let Some(operation) = operation {
                    rules.insert((path.clone(), method), security::scope(operation));
                }
            }
        }
        Self(rules)
    }

    /// The scope that a request to a route needs. One that the document does not have needs that of its method, so that
    /// nothing is open by being forgotten.
    fn scope(&self, route: &str, method: &Method) -> Option<Scope> {
        let method = if *method == Method::HEAD { &Method::GET } else { method };
        match self.0.get(&(route.to_owned(), method.clone())) {
            Some(scope) => *scope,
            None if OPEN_ROUTES.contains(&route) || *method == Method::OPTIONS => None,
            None => Some(security::scope_of_method(method.is_safe())),
        }
    }
}

/// Middleware: refuses whoever has no key (401), or one without the scope that the operation needs (403). Where there is no
/// route there is nothing to guard.
pub async fn allowed(
    State(rules): State<Arc<AccessRules>>,
    route: Option<MatchedPath>,
    request: Request,
    next: Next,
) -> Response {
    let Some(scope) = route.and_then(|route| rules.scope(route.as_str(), request.method())) else {
        return next.run(request).await;
    };
    let extensions = request.extensions();
    match extensions.get::<Caller>() {
        Some(caller) if caller.may(scope) => next.run(request).await,
        Some(_) => Problem::missing_scope(scope).into_response(),
        None => {
            let reason = extensions.get::<NotSignedIn>().map(|reason| reason.0.clone());
            reason.unwrap_or_else(Problem::key_required).into_response()
        }
    }
}
