//! The root of the API as OGC API Processes sees it: its landing page, and the requirements that are met.

use axum::response::Response;

use super::conformance::Conformance;
use crate::http::docs::{LandingPage, TITLE, pages_of_the_api};
use crate::http::extract::negotiation::Accept;
use crate::http::links::{Base, HTML, JSON};
use crate::http::page;

/// The classes of requirements that are met by processes and jobs, by their URIs. Each map lists those of its features.
const CONFORMS_TO: [&str; 7] = [
    "http://www.opengis.net/spec/ogcapi-common-1/1.0/conf/core",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/core",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/ogc-process-description",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/json",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/oas30",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/job-list",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/dismiss",
];

/// Root of the API
///
/// Its processes, jobs and maps. Each map is the root of an API of its own.
#[utoipa::path(get, path = "/v1", tag = "jobs", operation_id = "getApiRoot",
    responses((status = 200, description = "The landing page",
        content((LandingPage = "application/json"), (String = "text/html")))))]
pub async fn landing(base: Base, accept: Accept) -> Response {
    let own = [base.link("self", "/v1", JSON), base.link("alternate", "/v1?f=html", HTML)];
    let view = LandingPage::new(own.into_iter().chain(pages_of_the_api(&base)).collect());
    page::answer(&accept, TITLE, &view)
}

/// Conformance of processes and jobs
///
/// The classes of requirements of OGC API Processes that are met. Each map lists those of its features.
#[utoipa::path(get, path = "/v1/conformance", tag = "jobs", operation_id = "getApiConformance",
    responses((status = 200, description = "The classes",
        content((Conformance = "application/json"), (String = "text/html")))))]
pub async fn conformance(accept: Accept) -> Response {
    page::answer(&accept, "Conformance", &Conformance::with(&CONFORMS_TO))
}
