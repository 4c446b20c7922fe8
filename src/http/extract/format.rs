//! The parameter `f`: what a client accepts, where it cannot set `Accept`.

use axum::extract::{Query, Request};
use axum::http::{HeaderValue, StatusCode, Uri, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use crate::http::links::{CSV, FLAT_GEOBUF, GEO_JSON, HTML, JSON, JSON_FG};
use crate::http::problem::Problem;

/// Short names of media types.
const FORMATS: [(&str, &str); 6] =
    [("json", JSON), ("geojson", GEO_JSON), ("jsonfg", JSON_FG), ("html", HTML), ("csv", CSV), ("fgb", FLAT_GEOBUF)];

/// The short names under which one of these media types is got, for the document; none where a type has no name.
#[must_use]
pub fn names(media_types: &[&str]) -> Option<Vec<&'static str>> {
    let name = |wanted: &&str| FORMATS.iter().any(|(_, media_type)| media_type == wanted);
    let is_asked_for = |media_type: &str| {
        // Whoever asks for JSON gets what there is of it.
        media_types.contains(&media_type) || (media_type == JSON && media_types.contains(&GEO_JSON))
    };
    let names = || FORMATS.iter().filter(|(_, media_type)| is_asked_for(media_type)).map(|(name, _)| *name).collect();
    (!media_types.is_empty() && media_types.iter().all(name)).then(names)
}

/// The short name of a media type.
#[must_use]
pub fn name(media_type: &str) -> &'static str {
    FORMATS.iter().find(|(_, named)| *named == media_type).map_or("json", |(name, _)| name)
}

/// Middleware: `f` of a read becomes its `Accept` header, and is taken out of the query.
pub async fn format_parameter(mut request: Request, next: Next) -> Response {
    let named = match requested(&request) {
        Ok(None) => return next.run(request).await,
        Ok(Some(format)) => format,
        Err(problem) => return problem.into_response(),
    };
    let query = request.uri().query().unwrap_or_default();
    let others: Vec<&str> = query.split('&').filter(|pair| !is_format(pair)).collect();
    let path = request.uri().path();
    let address = if others.is_empty() { path.to_owned() } else { format!("{path}?{}", others.join("&")) };
    if let Ok(address) = address.parse::<Uri>() {
        *request.uri_mut() = address;
    }
    request.headers_mut().insert(header::ACCEPT, HeaderValue::from_static(named));
    let response = next.run(request).await;
    if response.status() == StatusCode::NOT_ACCEPTABLE {
        return Problem::parameter("f", "the resource is not served in this format").into_response();
    }
    response
}

fn is_format(pair: &str) -> bool {
    pair.split('=').next() == Some("f")
}

/// The media type that a read names.
fn requested(request: &Request) -> Result<Option<&'static str>, Problem> {
    if !request.method().is_safe() || !request.uri().query().is_some_and(|query| query.split('&').any(is_format)) {
        return Ok(None);
    }
    let pairs =
        Query::<Vec<(String, String)>>::try_from_uri(request.uri()).map(|Query(pairs)| pairs).unwrap_or_default();
    let values: Vec<String> = pairs.into_iter().filter(|(name, _)| name == "f").map(|(_, value)| value).collect();
    let known = FORMATS.map(|(name, _)| name).join(", ");
    match values.as_slice() {
        [value] => match FORMATS.iter().find(|(name, _)| name == value) {
            Some((_, media_type)) => Ok(Some(media_type)),
            None => Err(Problem::parameter("f", format!("must be one of {known}"))),
        },
        _ => Err(Problem::parameter("f", "must be given once")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_told_by_their_short_names() {
        assert_eq!(names(&[JSON]), Some(vec!["json"]));
        assert_eq!(names(&[GEO_JSON, HTML]), Some(vec!["json", "geojson", "html"]));
        assert_eq!(names(&["image/png"]), None);
        assert_eq!(names(&[JSON, "application/zip"]), None, "the resource has its format in its name");
        assert_eq!(names(&[]), None);
        assert_eq!(name(FLAT_GEOBUF), "fgb");
    }
}
