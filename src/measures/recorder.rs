//! The metrics of one service.

use metrics::{Counter, Gauge, Histogram, Unit};
use metrics_exporter_prometheus::{Matcher, PrometheusBuilder, PrometheusHandle, PrometheusRecorder};

use super::list::{
    HTTP_DURATION, JOB_DURATION, JOB_STAGES, METRICS, MetricKind, PROCESS_CPU, PROCESS_FILES, PROCESS_MEMORY,
};
use super::process;

/// Upper bounds of the time of answers, seconds: from an answer out of memory to the longest patience.
const ANSWER_BUCKETS: [f64; 11] = [0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 1.0, 5.0, 30.0];

/// Upper bounds of the time of jobs and their stages, seconds: from a small room to the largest site.
const JOB_BUCKETS: [f64; 10] = [0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 15.0, 60.0, 240.0, 960.0];

/// A label of a metric and its value.
pub type Label<'a> = (&'static str, &'a str);

/// The metrics of one service.
pub struct Measures {
    recorder: PrometheusRecorder,
    handle: PrometheusHandle,
}

impl Measures {
    /// Metrics that start at zero.
    #[must_use]
    pub fn new() -> Self {
        let recorder = builder().build_recorder();
        let handle = recorder.handle();
        metrics::with_local_recorder(&recorder, || {
            for metric in METRICS {
                match metric.kind {
                    MetricKind::Counter => metrics::describe_counter!(metric.name, Unit::Count, metric.help),
                    MetricKind::Gauge => metrics::describe_gauge!(metric.name, Unit::Count, metric.help),
                    MetricKind::Histogram => metrics::describe_histogram!(metric.name, Unit::Seconds, metric.help),
                }
            }
        });
        Self { recorder, handle }
    }

    /// A counter with its labels, to be looked up once where it counts often.
    pub fn counter(&self, name: &'static str, labels: &[Label<'_>]) -> Counter {
        metrics::with_local_recorder(&self.recorder, || metrics::counter!(name, &owned(labels)))
    }

    /// A gauge with its labels.
    pub fn gauge(&self, name: &'static str, labels: &[Label<'_>]) -> Gauge {
        metrics::with_local_recorder(&self.recorder, || metrics::gauge!(name, &owned(labels)))
    }

    /// A histogram with its labels.
    pub fn histogram(&self, name: &'static str, labels: &[Label<'_>]) -> Histogram {
        metrics::with_local_recorder(&self.recorder, || metrics::histogram!(name, &owned(labels)))
    }

    /// Keeps what was recorded since the last look small; to be called now and then where nobody looks.
    pub fn tidy(&self) {
        self.handle.run_upkeep();
    }

    /// All of them as text, with what the system knows of the process now.
    #[must_use]
    pub fn render(&self) -> String {
        if let Some(bytes) = process::resident_bytes() {
            self.gauge(PROCESS_MEMORY, &[]).set(bytes);
        }
        if let Some(files) = process::open_files() {
            self.gauge(PROCESS_FILES, &[]).set(files as f64);
        }
        // Whole seconds, as counters count.
        self.counter(PROCESS_CPU, &[]).absolute(process::cpu_time().as_secs());
        self.handle.render()
    }
}

impl Default for Measures {
    fn default() -> Self {
        Self::new()
    }
}

impl std::fmt::Debug for Measures {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Measures").finish_non_exhaustive()
    }
}

/// A builder that knows the bounds of the histograms.
fn builder() -> PrometheusBuilder {
    let bounds = [(HTTP_DURATION, &ANSWER_BUCKETS[..]), (JOB_DURATION, &JOB_BUCKETS), (JOB_STAGES, &JOB_BUCKETS)];
    bounds.into_iter().fold(PrometheusBuilder::new(), |builder, (name, bounds)| {
        builder.set_buckets_for_metric(Matcher::Full(name.to_owned()), bounds).expect("there are bounds")
    })
}

fn owned(labels: &[Label<'_>]) -> Vec<(&'static str, String)> {
    labels.iter().map(|&(name, value)| (name, value.to_owned())).collect()
}

/// Something that is there until this is dropped, such as a connection.
pub struct Present(Gauge);

impl Present {
    /// Counts one more.
    #[must_use]
    pub fn new(gauge: Gauge) -> Self {
        gauge.increment(1.0);
        Self(gauge)
    }
}

impl Drop for Present {
    fn drop(&mut self) {
        self.0.decrement(1.0);
    }
}

impl std::fmt::Debug for Present {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Present").finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measures::{HTTP_CONNECTIONS, HTTP_REQUESTS, JOB_ATTEMPTS};

    #[test]
    fn what_is_counted_is_read_with_its_meaning() {
        let measures = Measures::new();
        measures.counter(HTTP_REQUESTS, &[("route", "/v1/maps/{mapId}"), ("status", "200")]).increment(2);
        measures.histogram(HTTP_DURATION, &[]).record(0.003);
        let first = Present::new(measures.gauge(HTTP_CONNECTIONS, &[]));
        drop(Present::new(measures.gauge(HTTP_CONNECTIONS, &[])));
        let text = measures.render();
        drop(first);
        for line in [
            r#"http_requests_total{route="/v1/maps/{mapId}",status="200"} 2"#,
            "# TYPE http_request_duration_seconds histogram",
            r#"http_request_duration_seconds_bucket{le="0.005"} 1"#,
            "http_connections 1",
            "# HELP http_connections Open connections.",
        ] {
            assert!(text.lines().any(|found| found == line), "{line}: {text}");
        }
        assert!(!text.contains(JOB_ATTEMPTS), "what never happened is not there");
    }
}
