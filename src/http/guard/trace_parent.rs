//! The trace of a caller, which goes on in the spans of its request (W3C Trace Context, `traceparent` and `tracestate`).

use axum::http::HeaderMap;
use opentelemetry::propagation::TextMapPropagator as _;
use opentelemetry::trace::TraceContextExt as _;
use opentelemetry_http::HeaderExtractor;
use opentelemetry_sdk::propagation::TraceContextPropagator;
use tracing::Span;
use tracing_opentelemetry::OpenTelemetrySpanExt as _;

/// Puts the span of a request below the one that its headers name, where they name one. Where the caller does not record its
/// trace, this service does not, either.
pub fn take_over(span: &Span, headers: &HeaderMap) {
    let caller = TraceContextPropagator::new().extract(&HeaderExtractor(headers));
    if caller.span().span_context().is_valid() {
        // Without a collector there is no trace to go on with.
        let _ = span.set_parent(caller);
    }
}
