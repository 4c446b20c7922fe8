//! The front door, the OpenAPI documents and the reference page made of them. Nothing loads from elsewhere.

pub mod binary;
mod for_clients;
mod integers;
mod of_map;
pub mod openapi;
pub mod problem_types;
pub mod refusals;
pub mod security;
mod version_3_0;

use std::sync::Arc;

use axum::extract::State;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use axum::{Extension, Json};
use bytes::Bytes;
use serde::Serialize;
use serde_json::Value;
use utoipa::ToSchema;
use utoipa_swagger_ui::{Config, SwaggerUi};

use crate::app::{App, Caller};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{MapPath, Path};
use crate::http::links::{Base, HTML, JSON, OPENAPI_3_0, OPENAPI_3_1};
use crate::http::problem::Problem;
use crate::http::public_address::PublicAddress;
use crate::http::{dashboard, page};
use crate::views::link::Link;
use refusals::NotFound;

/// What the service is called.
pub const TITLE: &str = "stillage";

/// The front door.
#[derive(Debug, Serialize, ToSchema)]
pub struct LandingPage {
    title: &'static str,
    description: &'static str,
    version: &'static str,
    links: Vec<Link>,
}

impl LandingPage {
    /// A page with these links.
    #[must_use]
    pub const fn new(links: Vec<Link>) -> Self {
        let (description, version) = (env!("CARGO_PKG_DESCRIPTION"), env!("CARGO_PKG_VERSION"));
        Self { title: TITLE, description, version, links }
    }
}

/// Landing page
///
/// Leads to everything else. Browsers get the dashboard.
#[utoipa::path(get, path = "/", tag = "service", operation_id = "getLandingPage", security(()),
    responses((status = 200, description = "The landing page, or the dashboard",
        content((LandingPage = "application/json"), (String = "text/html")))))]
pub async fn landing(base: Base, accept: Accept, if_none_match: IfNoneMatch) -> Response {
    if page::is_wanted(&accept) {
        return dashboard::page(&if_none_match);
    }
    let own = [
        base.link("self", "/", JSON),
        base.link("alternate", "/?f=html", HTML).titled("The dashboard"),
        base.link("related", "/openapi.json", OPENAPI_3_1).titled("The API as an OpenAPI 3.1 document"),
        base.link("status", "/health/ready", JSON).titled("Readiness"),
    ];
    Json(LandingPage::new(own.into_iter().chain(pages_of_the_api(&base)).collect())).into_response()
}

/// Where the API is described, and where its resources begin.
pub fn pages_of_the_api(base: &Base) -> [Link; 7] {
    [
        base.link("service-desc", "/openapi-3.0.json", OPENAPI_3_0).titled("The API as an OpenAPI 3.0 document"),
        base.link("service-doc", "/docs/", HTML).titled("The API reference"),
        base.link("http://www.opengis.net/def/rel/ogc/1.0/conformance", "/v1/conformance", JSON)
            .titled("The standards that are met here"),
        base.link("http://www.opengis.net/def/rel/ogc/1.0/processes", "/v1/processes", JSON).titled("The processes"),
        base.link("http://www.opengis.net/def/rel/ogc/1.0/job-list", "/v1/jobs", JSON).titled("The jobs"),
        base.link("data", "/v1/maps", JSON).titled("The maps"),
        base.link("related", "/v1/rule-sets", JSON).titled("The rule sets"),
    ]
}

/// A document, written once, with its tag.
#[derive(Debug, Clone)]
pub struct Document {
    bytes: Bytes,
    tag: EntityTag,
}

impl Document {
    fn new(text: String) -> Self {
        let bytes = Bytes::from(text);
        let tag = EntityTag::of_content(&[&blake3::hash(&bytes).to_hex()]);
        Self { bytes, tag }
    }

    /// The document for clients that reach the service below another path than `/`.
    fn below(self, root: &str) -> Self {
        if root == openapi::SERVER {
            return self;
        }
        let text = String::from_utf8_lossy(&self.bytes);
        let server = |root: &str| format!("\"url\": {}", Value::from(root));
        Self::new(text.replacen(&server(openapi::SERVER), &server(root), 1))
    }

    fn answer(self, if_none_match: &IfNoneMatch, media_type: &'static str) -> Response {
        let Self { bytes, tag } = self;
        tag.answer(if_none_match, || ([(CONTENT_TYPE, media_type)], bytes).into_response())
    }
}

/// The OpenAPI documents of the service.
#[derive(Debug)]
pub struct Documents {
    version_3_1: Document,
    version_3_0: Document,
    /// That of a map, in version 3.0, without spaces: GDAL reads it whenever it opens a layer. [`of_map::SERVER`] stands for
    /// the address of the map.
    of_map: String,
}

impl Documents {
    /// Those of a document in version 3.1.
    #[must_use]
    pub fn of(version_3_1: &Value) -> Self {
        let [version_3_0, of_map] = in_version_3_0(version_3_1);
        Self {
            version_3_1: Document::new(openapi::text(version_3_1)),
            version_3_0: Document::new(openapi::text(&version_3_0)),
            of_map: of_map.to_string(),
        }
    }
}

/// The document of the service and that of a map in version 3.0.
fn in_version_3_0(version_3_1: &Value) -> [Value; 2] {
    let version_3_0 = for_clients::for_clients(version_3_0::down_convert(version_3_1));
    let of_map = of_map::of_map(&version_3_0);
    [version_3_0, of_map]
}

/// The OpenAPI documents as they are stored.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texts {
    /// The API in OpenAPI 3.1.
    pub version_3_1: String,
    /// The API in OpenAPI 3.0.
    pub version_3_0: String,
    /// The API of a map, in OpenAPI 3.0.
    pub of_map: String,
}

impl Texts {
    /// Those of a document in version 3.1.
    #[must_use]
    pub fn of(version_3_1: &Value) -> Self {
        let [version_3_0, of_map] = in_version_3_0(version_3_1);
        let [version_3_1, version_3_0, of_map] = [version_3_1, &version_3_0, &of_map].map(openapi::text);
        Self { version_3_1, version_3_0, of_map }
    }
}

/// OpenAPI document
///
/// This document.
#[utoipa::path(get, path = "/openapi.json", tag = "service", operation_id = "getOpenApi", security(()),
    responses((status = 200, description = "The OpenAPI 3.1 document", body = serde_json::Value,
        content_type = "application/vnd.oai.openapi+json;version=3.1",
        headers(("ETag" = String, description = "Changes with the document")))))]
pub async fn openapi(
    Extension(documents): Extension<Arc<Documents>>,
    Extension(address): Extension<PublicAddress>,
    if_none_match: IfNoneMatch,
) -> Response {
    documents.version_3_1.clone().below(&address.path("/")).answer(&if_none_match, OPENAPI_3_1)
}

/// OpenAPI 3.0 document
///
/// This document in the version that GIS read, with a path for each collection.
#[utoipa::path(get, path = "/openapi-3.0.json", tag = "service", operation_id = "getOpenApi30", security(()),
    responses((status = 200, description = "The OpenAPI 3.0 document", body = serde_json::Value,
        content_type = "application/vnd.oai.openapi+json;version=3.0",
        headers(("ETag" = String, description = "Changes with the document")))))]
pub async fn openapi_3_0(
    Extension(documents): Extension<Arc<Documents>>,
    Extension(address): Extension<PublicAddress>,
    if_none_match: IfNoneMatch,
) -> Response {
    documents.version_3_0.clone().below(&address.path("/")).answer(&if_none_match, OPENAPI_3_0)
}

/// OpenAPI document of a map
///
/// Every map is an OGC API of its own: its features in OpenAPI 3.0, with paths relative to the map.
#[utoipa::path(get, path = "/v1/maps/{mapId}/api", tag = "features", operation_id = "getMapApi", params(MapPath),
    responses((status = 200, description = "The OpenAPI 3.0 document", body = serde_json::Value,
        content_type = "application/vnd.oai.openapi+json;version=3.0",
        headers(("ETag" = String, description = "Changes with the document"))),
        NotFound))]
pub async fn map_api(
    State(app): State<Arc<App>>,
    Extension(documents): Extension<Arc<Documents>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let map = app.map(&caller, path.map_id.0).await?;
    let server = base.link("self", &format!("/v1/maps/{}", map.id), JSON).href;
    let document = Document::new(documents.of_map.replacen(of_map::SERVER, &server, 1));
    Ok(document.answer(&if_none_match, OPENAPI_3_0))
}

/// The reference page at `/docs/`: swagger-ui, built into the program. It looks for the document beside its folder, wherever
/// a proxy puts both.
pub fn reference_page<S: Clone + Send + Sync + 'static>() -> axum::Router<S> {
    SwaggerUi::new("/docs").config(Config::from("../openapi.json").use_base_layout()).into()
}
