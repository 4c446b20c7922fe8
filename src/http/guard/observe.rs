//! What operators see: an id and a log line for every request, and the metrics.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, PoisonError, RwLock};
use std::time::Instant;

use axum::extract::{MatchedPath, Request, State};
use axum::http::{HeaderName, HeaderValue, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use metrics::{Counter, Histogram};
use tracing::Instrument;
use uuid::Uuid;

use crate::app::App;
use crate::http::problem::ProblemType;
use crate::measures::{HTTP_DURATION, HTTP_REQUESTS, HTTP_SHED, Measures};

/// The header that carries the id of a request, in both directions.
const REQUEST_ID: HeaderName = HeaderName::from_static("x-request-id");
/// Requests between two clean-ups of the recorder, which otherwise happen whenever it is read.
const UPKEEP_PERIOD: u64 = 4_096;

/// The id of a request.
#[derive(Debug, Clone)]
pub struct RequestId(pub HeaderValue);

/// Kinds of refusals for which there was too much to do, and what operators are told as the reason.
const SHED: [(ProblemType, &str); 3] =
    [(ProblemType::Overloaded, "overload"), (ProblemType::Busy, "queue"), (ProblemType::NoSpace, "disk")];

/// The requests of one router, counted.
pub struct RequestMeasures {
    measures: Arc<Measures>,
    requests: AtomicU64,
    /// By method, status and route: to look them up in the recorder takes longer than to answer from memory.
    counted: RwLock<HashMap<String, Counted>>,
}

/// What is counted of the requests with the same labels.
struct Counted {
    seconds: Histogram,
    requests: Counter,
}

impl RequestMeasures {
    /// Counts on the measures of a service.
    #[must_use]
    pub fn new(measures: Arc<Measures>) -> Self {
        for (_, reason) in SHED {
            measures.counter(HTTP_SHED, &[("reason", reason)]).absolute(0);
        }
        Self { measures, requests: AtomicU64::default(), counted: RwLock::default() }
    }

    fn count_request(&self, route: &str, method: &str, status: u16, seconds: f64) {
        let labels = format!("{method} {status} {route}");
        if let Some(counted) = self.counted.read().unwrap_or_else(PoisonError::into_inner).get(&labels) {
            counted.count(seconds);
        } else {
            let labelled = [("route", route), ("method", method), ("status", &status.to_string())];
            let counted = Counted {
                seconds: self.measures.histogram(HTTP_DURATION, &labelled[..2]),
                requests: self.measures.counter(HTTP_REQUESTS, &labelled),
            };
            counted.count(seconds);
            self.counted.write().unwrap_or_else(PoisonError::into_inner).insert(labels, counted);
        }
        if self.requests.fetch_add(1, Ordering::Relaxed) % UPKEEP_PERIOD == UPKEEP_PERIOD - 1 {
            self.measures.tidy();
        }
    }

    fn count_refusal(&self, kind: ProblemType) {
        if let Some((_, reason)) = SHED.iter().find(|(shed, _)| *shed == kind) {
            self.measures.counter(HTTP_SHED, &[("reason", reason)]).increment(1);
        }
    }
}

impl Counted {
    fn count(&self, seconds: f64) {
        self.seconds.record(seconds);
        self.requests.increment(1);
    }
}

impl std::fmt::Debug for RequestMeasures {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("RequestMeasures").finish_non_exhaustive()
    }
}

/// Middleware: gives the request its id, logs it and counts it.
pub async fn observe(State(measures): State<Arc<RequestMeasures>>, mut request: Request, next: Next) -> Response {
    let began = Instant::now();
    let id = request_id(&request);
    request.extensions_mut().insert(RequestId(id.clone()));
    let method = request.method().clone();
    // Of the highest level, so that every line about the request has its id.
    let request_id = id.to_str().unwrap_or_default();
    let span = tracing::error_span!("request", request_id, %method, path = request.uri().path());
    #[cfg(feature = "otel")]
    super::trace_parent::take_over(&span, request.headers());
    let mut response = next.run(request).instrument(span.clone()).await;
    let (status, seconds) = (response.status().as_u16(), began.elapsed().as_secs_f64());
    span.in_scope(|| tracing::debug!(status, seconds, "answered"));
    let path = response.extensions_mut().remove::<MatchedPath>();
    let route = path.as_ref().map_or("unmatched", MatchedPath::as_str);
    // Methods are free text: only those of the standard become labels.
    let label = if method.as_str().len() <= 7 { method.as_str() } else { "other" };
    measures.count_request(route, label, status, seconds);
    if let Some(kind) = response.extensions_mut().remove::<ProblemType>() {
        measures.count_refusal(kind);
    }
    response.headers_mut().insert(REQUEST_ID, id);
    response
}

/// Middleware: the answer tells its route to [`observe`], which lies around the list of routes.
pub async fn tell_route(path: Option<MatchedPath>, request: Request, next: Next) -> Response {
    let mut response = next.run(request).await;
    if let Some(path) = path {
        response.extensions_mut().insert(path);
    }
    response
}

/// The client's own id where it is a plain one, or a new one.
fn request_id(request: &Request) -> HeaderValue {
    let plain = |id: &&HeaderValue| {
        (1..=64).contains(&id.len())
            && id.as_bytes().iter().all(|&byte| byte.is_ascii_alphanumeric() || b"-_.".contains(&byte))
    };
    request
        .headers()
        .get(REQUEST_ID)
        .filter(plain)
        .cloned()
        .unwrap_or_else(|| HeaderValue::try_from(Uuid::now_v7().to_string()).expect("a UUID is plain text"))
}

/// Metrics
///
/// Requests, jobs, the queue, what is held and what is left, in the text format of Prometheus.
#[utoipa::path(get, path = "/metrics", tag = "service", operation_id = "getMetrics", security(("key" = ["metrics"]), ()),
    responses((status = 200, description = "The metrics", body = String, content_type = "text/plain; version=0.0.4")))]
pub async fn metrics(State(app): State<Arc<App>>) -> Response {
    ([(header::CONTENT_TYPE, "text/plain; version=0.0.4")], app.metrics_text().await).into_response()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_are_counted_by_route() {
        let measures = RequestMeasures::new(Arc::default());
        measures.count_request("/v1/maps/{mapId}", "GET", 200, 0.003);
        measures.count_request("/v1/maps/{mapId}", "GET", 200, 0.2);
        measures.count_refusal(ProblemType::Busy);
        let text = measures.measures.render();
        assert!(text.contains(r#"http_requests_shed_total{reason="queue"} 1"#), "{text}");
        assert!(
            text.contains(r#"http_requests_total{route="/v1/maps/{mapId}",method="GET",status="200"} 2"#),
            "{text}"
        );
        assert!(text.contains(r#"method="GET",le="0.005"} 1"#), "{text}");
    }

    #[test]
    fn only_plain_ids_of_clients_are_taken_over() {
        let id = |value: &str| {
            let request = Request::builder().header(REQUEST_ID, value).body(axum::body::Body::empty());
            request_id(&request.expect("is a request"))
        };
        assert_eq!(id("robot-7.42"), "robot-7.42");
        assert_ne!(id("robot 7"), "robot 7");
        assert_ne!(id(&"7".repeat(65)), "7".repeat(65).as_str());
    }
}
