//! The root of the API, from which clients of OGC API Processes start: its landing page, and the requirements that are met.

use axum::response::Response;

use super::conformance::Conformance;
use crate::http::docs::{LandingPage, TITLE, pages_of_the_api};
use crate::http::extract::negotiation::Accept;
use crate::http::links::{Base, HTML, JSON};
use crate::http::page;

/// The classes of requirements that are met at the root, by their URIs. Each map lists those of its features. Those of
/// OGC API Processes 1.0 are not among them: an execution that asks for several outputs and says nothing of `response` gets a
/// JSON document, as clients expect, where its class "Core" (OGC 18-062r2) wants the parts of a multipart body.
const CONFORMS_TO: [&str; 1] = ["http://www.opengis.net/spec/ogcapi-common-1/1.0/conf/core"];

/// Root of the API
///
/// Its processes, jobs and maps. Each map is the root of an API of its own.
#[utoipa::path(get, path = "/v1", tag = "jobs", operation_id = "getApiRoot", security(()),
    responses((status = 200, description = "The landing page",
        content((LandingPage = "application/json"), (String = "text/html")))))]
pub async fn landing(base: Base, accept: Accept) -> Response {
    let own = [base.link("self", "/v1", JSON), base.link("alternate", "/v1?f=html", HTML)];
    let view = LandingPage::new(own.into_iter().chain(pages_of_the_api(&base)).collect());
    page::answer(&accept, TITLE, &view)
}

/// Conformance of the root
///
/// The classes of requirements of the OGC standards that are met here. Each map lists those of its features.
#[utoipa::path(get, path = "/v1/conformance", tag = "jobs", operation_id = "getApiConformance", security(()),
    responses((status = 200, description = "The classes",
        content((Conformance = "application/json"), (String = "text/html")))))]
pub async fn conformance(accept: Accept) -> Response {
    page::answer(&accept, "Conformance", &Conformance::with(&CONFORMS_TO))
}
