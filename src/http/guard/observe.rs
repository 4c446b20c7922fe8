//! What operators see: an id and a log line for every request, and the metrics.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, PoisonError, RwLock};
use std::time::Instant;

use axum::Extension;
use axum::extract::{MatchedPath, Request, State};
use axum::http::{HeaderName, HeaderValue, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use metrics::{Counter, Histogram};
use metrics_exporter_prometheus::{Matcher, PrometheusBuilder, PrometheusHandle, PrometheusRecorder};
use tracing::Instrument;
use uuid::Uuid;

use crate::app::App;
use crate::http::problem::Problem;

/// The header that carries the id of a request, in both directions.
const REQUEST_ID: HeaderName = HeaderName::from_static("x-request-id");
/// Upper bounds of the latency histogram, seconds: from an answer out of memory to the longest patience.
const LATENCY_BUCKETS: [f64; 11] = [0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 1.0, 5.0, 30.0];
/// Requests between two clean-ups of the recorder, which otherwise happen whenever it is read.
const UPKEEP_PERIOD: u64 = 4_096;

/// The id of a request.
#[derive(Debug, Clone)]
pub struct RequestId(pub HeaderValue);

/// The metrics of one router. Not a global: several services may live in a process, as they do in tests.
pub struct Metrics {
    recorder: PrometheusRecorder,
    handle: PrometheusHandle,
    requests: AtomicU64,
    /// By method, status and route: to look them up in the recorder takes longer than to answer from memory.
    measures: RwLock<HashMap<String, Measures>>,
}

/// What is counted of the requests with the same labels.
struct Measures {
    seconds: Histogram,
    requests: Counter,
}

impl Metrics {
    /// Metrics that start at zero.
    #[must_use]
    pub fn new() -> Self {
        let latency = Matcher::Full("http_request_duration_seconds".to_owned());
        let builder = PrometheusBuilder::new().set_buckets_for_metric(latency, &LATENCY_BUCKETS);
        let recorder = builder.expect("there are buckets").build_recorder();
        let handle = recorder.handle();
        metrics::with_local_recorder(&recorder, || {
            metrics::describe_counter!("http_requests_total", "Requests by route, method and status.");
            metrics::describe_histogram!("http_request_duration_seconds", "Time to the head of the answer.");
            metrics::describe_gauge!("jobs", "Jobs by state.");
        });
        Self { recorder, handle, requests: AtomicU64::default(), measures: RwLock::default() }
    }

    fn count_request(&self, route: &str, method: &str, status: u16, seconds: f64) {
        let labels = format!("{method} {status} {route}");
        if let Some(measures) = self.measures.read().unwrap_or_else(PoisonError::into_inner).get(&labels) {
            measures.count(seconds);
        } else {
            let measures = self.measures(route, method, status);
            measures.count(seconds);
            self.measures.write().unwrap_or_else(PoisonError::into_inner).insert(labels, measures);
        }
        if self.requests.fetch_add(1, Ordering::Relaxed) % UPKEEP_PERIOD == UPKEEP_PERIOD - 1 {
            self.handle.run_upkeep();
        }
    }

    fn measures(&self, route: &str, method: &str, status: u16) -> Measures {
        let labels = [("route", route.to_owned()), ("method", method.to_owned())];
        metrics::with_local_recorder(&self.recorder, || {
            let seconds = metrics::histogram!("http_request_duration_seconds", &labels);
            let [route, method] = labels;
            let labels = [route, method, ("status", status.to_string())];
            Measures { seconds, requests: metrics::counter!("http_requests_total", &labels) }
        })
    }
}

impl Measures {
    fn count(&self, seconds: f64) {
        self.seconds.record(seconds);
        self.requests.increment(1);
    }
}

impl std::fmt::Debug for Metrics {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Metrics").finish_non_exhaustive()
    }
}

/// Middleware: gives the request its id, logs it and counts it.
pub async fn observe(State(metrics): State<Arc<Metrics>>, mut request: Request, next: Next) -> Response {
    let began = Instant::now();
    let id = request_id(&request);
    request.extensions_mut().insert(RequestId(id.clone()));
    let method = request.method().clone();
    let span =
        tracing::info_span!("request", %method, path = request.uri().path(), id = id.to_str().unwrap_or_default());
    let mut response = next.run(request).instrument(span.clone()).await;
    let (status, seconds) = (response.status().as_u16(), began.elapsed().as_secs_f64());
    span.in_scope(|| tracing::debug!(status, seconds, "answered"));
    let path = response.extensions_mut().remove::<MatchedPath>();
    let route = path.as_ref().map_or("unmatched", MatchedPath::as_str);
    // Methods are free text: only those of the standard become labels.
    let label = if method.as_str().len() <= 7 { method.as_str() } else { "other" };
    metrics.count_request(route, label, status, seconds);
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
/// Requests by route, method and status, their latency, and jobs by state, in the text format of Prometheus.
#[utoipa::path(get, path = "/metrics", tag = "service", operation_id = "getMetrics", security(("key" = ["metrics"]), ()),
    responses((status = 200, description = "The metrics", body = String, content_type = "text/plain; version=0.0.4")))]
pub async fn metrics(
    State(app): State<Arc<App>>,
    Extension(metrics): Extension<Arc<Metrics>>,
) -> Result<Response, Problem> {
    let counts = app.job_counts().await?;
    metrics::with_local_recorder(&metrics.recorder, || {
        for (state, count) in counts {
            metrics::gauge!("jobs", "state" => state).set(count as f64);
        }
    });
    Ok(([(header::CONTENT_TYPE, "text/plain; version=0.0.4")], metrics.handle.render()).into_response())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_are_counted_by_route() {
        let metrics = Metrics::new();
        metrics.count_request("/v1/maps/{mapId}", "GET", 200, 0.003);
        metrics.count_request("/v1/maps/{mapId}", "GET", 200, 0.2);
        let text = metrics.handle.render();
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
