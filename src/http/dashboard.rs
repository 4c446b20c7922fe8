//! The dashboard: the page for browsers, built from `web/` and embedded into the program.

use axum::extract::Path;
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};

use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::problem::{Problem, ProblemType};

/// The page. It loads its assets and the service's answers, and nothing else.
const PAGE: &str = include_str!("../../web/dist/index.html");
/// What it loads, by name.
const ASSETS: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/dashboard_assets.rs"));
/// Scripts and styles of the page itself only, none within a document; nothing from elsewhere.
const POLICY: HeaderValue = HeaderValue::from_static(
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; \
     base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
);
/// Licences of the packages in the page: the one asset whose name stays.
const LICENSES: &str = "licenses.txt";
/// The name of any other asset changes with its content: a year is for ever.
const FOR_EVER: HeaderValue = HeaderValue::from_static("public, max-age=31536000, immutable");

/// The path of an asset.
pub const ASSET_PATH: &str = "/assets/{name}";

/// The page.
pub fn page(if_none_match: &IfNoneMatch) -> Response {
    let tag = EntityTag::of_content(&["dashboard", PAGE]);
    let headers = [
        (header::CONTENT_TYPE, HeaderValue::from_static("text/html; charset=utf-8")),
        (header::CONTENT_SECURITY_POLICY, POLICY),
    ];
    tag.answer(if_none_match, || (headers, PAGE).into_response())
}

/// What the page loads.
pub async fn asset(Path(name): Path<String>) -> Result<Response, Problem> {
    let (name, bytes) = ASSETS.iter().find(|(known, _)| *known == name).ok_or_else(|| {
        Problem::new(ProblemType::NotFound, "there is no such file of the dashboard: load its page anew")
    })?;
    let caching = if *name == LICENSES { HeaderValue::from_static("no-cache") } else { FOR_EVER };
    let headers =
        [(header::CONTENT_TYPE, HeaderValue::from_static(media_type(name))), (header::CACHE_CONTROL, caching)];
    Ok((headers, *bytes).into_response())
}

fn media_type(name: &str) -> &'static str {
    match name.rsplit('.').next() {
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("svg") => "image/svg+xml",
        Some("txt") => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}
