//! Pages for people: the same documents that programs get as JSON, in HTML. No script, nothing from elsewhere; every text is
//! escaped.

mod document;
mod drawing;
mod markup;

use axum::Json;
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, IntoResponseParts, Response};
use serde::Serialize;
use serde_json::Value;

use crate::http::extract::negotiation::Accept;
use crate::http::links::{HTML, JSON};

pub use drawing::{LinkedFeature, drawing};
pub use markup::{Markup, text};

/// What a page looks like: that of a document that is read, on screens of any width, light or dark.
const STYLE: &str = "\
    :root{color-scheme:light dark}\
    body{font:1rem/1.5 system-ui,sans-serif;max-width:75rem;margin:0 auto;padding:1rem}\
    main{overflow-x:auto}\
    table{border-collapse:collapse;margin:.5rem 0}\
    th,td{border-bottom:1px solid #8886;padding:.2rem .8rem .2rem 0;text-align:left;vertical-align:top}\
    svg{width:100%;max-height:60vh;border:1px solid #8886}\
    svg path,svg circle{fill:#1f77b433;stroke:#1f77b4;stroke-width:1;vector-effect:non-scaling-stroke}\
    svg path.line{fill:none}";

/// A document as the client accepts it: JSON, or a page with this title.
pub fn answer<T: Serialize>(accept: &Accept, title: &str, view: &T) -> Response {
    if is_wanted(accept) { document(title, view, &Markup::default()) } else { Json(view).into_response() }
}

/// GeoJSON as the client accepts it: as it is, or a page of what is known of its features, with this title.
pub fn answer_geojson(accept: &Accept, title: &str, headers: impl IntoResponseParts, written: Vec<u8>) -> Response {
    if !is_wanted(accept) {
        return (headers, written).into_response();
    }
    let mut value: Value = serde_json::from_slice(&written).expect("GeoJSON that was just written");
    document::forget_shapes(&mut value);
    document(title, &value, &Markup::default())
}

/// Whether the client wants a page rather than JSON.
#[must_use]
pub fn is_wanted(accept: &Accept) -> bool {
    accept.best(&[JSON, HTML]) == HTML
}

/// The kind of a resource for its entity tag: a page is another representation than JSON.
#[must_use]
pub fn kind(name: &str, accept: &Accept) -> String {
    if is_wanted(accept) { format!("{name}.html") } else { name.to_owned() }
}

/// A page with a title, a drawing, and a document member by member.
pub fn document<T: Serialize>(title: &str, view: &T, drawing: &Markup) -> Response {
    page(title, &[drawing, &part(view)])
}

/// A document as a part of a page.
pub fn part<T: Serialize>(view: &T) -> Markup {
    document::markup(&serde_json::to_value(view).expect("documents have texts for keys"))
}

/// A page with a title and what lies below it.
pub fn page(title: &str, parts: &[&Markup]) -> Response {
    let title = text(title);
    let body: String = parts.iter().map(|part| part.as_str()).collect();
    let html = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>{title}</title>\
         <style>{STYLE}</style></head>\n<body><h1>{title}</h1><main>\n{body}\n</main></body></html>\n",
        title = title.as_str()
    );
    let headers = [
        (header::CONTENT_TYPE, HeaderValue::from_static("text/html; charset=utf-8")),
        (header::CACHE_CONTROL, HeaderValue::from_static("no-cache")),
    ];
    (headers, html).into_response()
}
