//! The front door, the OpenAPI document and the reference page made of it. Nothing loads from elsewhere.

pub mod openapi;
pub mod problem_types;
pub mod refusals;

use axum::Json;
use axum::response::{IntoResponse, Response};
use bytes::Bytes;
use serde::Serialize;
use utoipa::ToSchema;
use utoipa_swagger_ui::{Config, SwaggerUi};

use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::links::{Base, JSON, OPENAPI};
use crate::views::link::Link;

/// The front door.
#[derive(Debug, Serialize, ToSchema)]
pub struct LandingPage {
    title: &'static str,
    description: &'static str,
    version: &'static str,
    links: Vec<Link>,
}

/// Landing page
///
/// Leads to everything else.
#[utoipa::path(get, path = "/", tag = "service", operation_id = "getLandingPage",
    responses((status = 200, description = "The landing page", body = LandingPage)))]
pub async fn landing(base: Base) -> Json<LandingPage> {
    Json(LandingPage {
        title: "stillage",
        description: env!("CARGO_PKG_DESCRIPTION"),
        version: env!("CARGO_PKG_VERSION"),
        links: vec![
            base.link("self", "/", JSON),
            base.link("service-desc", "/openapi.json", OPENAPI).titled("The API as an OpenAPI 3.1 document"),
            base.link("service-doc", "/docs/", "text/html").titled("The API reference"),
            base.link("status", "/health/ready", JSON).titled("Readiness"),
            base.link("data", "/v1/maps", JSON).titled("The maps"),
            base.link("http://www.opengis.net/def/rel/ogc/1.0/job-list", "/v1/jobs", JSON).titled("The jobs"),
            base.link("related", "/v1/rule-sets", JSON).titled("The rule sets"),
        ],
    })
}

/// The OpenAPI document, written once, with its tag.
#[derive(Debug, Clone)]
pub struct Document {
    bytes: Bytes,
    tag: EntityTag,
}

impl Document {
    /// The document in these bytes.
    #[must_use]
    pub fn new(bytes: impl Into<Bytes>) -> Self {
        let bytes = bytes.into();
        let tag = EntityTag::of_content(&[&blake3::hash(&bytes).to_hex()]);
        Self { bytes, tag }
    }
}

/// OpenAPI document
///
/// This document.
#[utoipa::path(get, path = "/openapi.json", tag = "service", operation_id = "getOpenApi",
    responses((status = 200, description = "The OpenAPI 3.1 document", body = serde_json::Value,
        content_type = "application/vnd.oai.openapi+json;version=3.1",
        headers(("ETag" = String, description = "Changes with the document")))))]
pub async fn openapi(axum::Extension(document): axum::Extension<Document>, if_none_match: IfNoneMatch) -> Response {
    let Document { bytes, tag } = document;
    tag.answer(&if_none_match, || ([(axum::http::header::CONTENT_TYPE, OPENAPI)], bytes).into_response())
}

/// The reference page at `/docs/`: swagger-ui, built into the program.
pub fn reference_page<S: Clone + Send + Sync + 'static>() -> axum::Router<S> {
    SwaggerUi::new("/docs").config(Config::from("/openapi.json").use_base_layout()).into()
}
