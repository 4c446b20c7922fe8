//! What a service logs, and how; with the feature `otel`, the spans that it sends to a collector.

use std::io::{self, IsTerminal as _};

use clap::{Args, ValueEnum};
use tracing_subscriber::Layer as _;
use tracing_subscriber::filter::{ParseError, Targets};
use tracing_subscriber::layer::SubscriberExt as _;
use tracing_subscriber::util::SubscriberInitExt as _;

#[cfg(feature = "otel")]
use super::traces::{CollectorError, Traces};

/// What to log to standard error.
#[derive(Debug, Clone, Args)]
pub(super) struct LogArgs {
    /// What to log to standard error: a level, or directives such as `stillage=debug,sqlx=warn`.
    #[arg(long, visible_alias = "log-level", env = "STILLAGE_LOG", default_value = "info", value_name = "FILTER")]
    log: String,
    /// The form of log lines.
    #[arg(long, env = "STILLAGE_LOG_FORMAT", default_value = "text", value_name = "FORMAT")]
    log_format: LogFormat,
    /// A collector of OpenTelemetry that gets the spans of requests and jobs (OTLP over HTTP), such as
    /// `http://localhost:4318`.
    #[cfg(feature = "otel")]
    #[arg(long, env = "OTEL_EXPORTER_OTLP_ENDPOINT", value_name = "URL")]
    otlp_endpoint: Option<String>,
}

/// The form of log lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum LogFormat {
    /// For people.
    Text,
    /// One JSON object a line; `span` has the ids of the request or the job.
    Json,
}

/// Why nothing can be logged.
#[derive(Debug, thiserror::Error)]
pub(super) enum LoggingError {
    /// The directives make no sense.
    #[error("--log: {0}")]
    Filter(#[from] ParseError),
    /// The collector has no address.
    #[cfg(feature = "otel")]
    #[error("--otlp-endpoint: {0}")]
    Collector(#[from] CollectorError),
}

/// The log, until this is dropped: then what is left of the spans is sent.
#[derive(Debug)]
pub(super) struct Logging {
    #[cfg(feature = "otel")]
    _traces: Option<Traces>,
}

impl LogArgs {
    /// Logs from now on, panics too.
    ///
    /// # Errors
    /// When the arguments make no sense.
    pub(super) fn start(&self) -> Result<Logging, LoggingError> {
        let targets: Targets = self.log.parse()?;
        // Colours are for a terminal: in a file they are noise.
        let lines = tracing_subscriber::fmt::layer().with_writer(io::stderr).with_ansi(io::stderr().is_terminal());
        let lines = match self.log_format {
            LogFormat::Text => lines.boxed(),
            LogFormat::Json => lines.json().flatten_event(true).with_span_list(false).boxed(),
        };
        let subscriber = tracing_subscriber::registry().with(lines.with_filter(targets));
        #[cfg(feature = "otel")]
        let traces = self.otlp_endpoint.as_deref().map(Traces::to).transpose()?;
        #[cfg(feature = "otel")]
        let subscriber = subscriber.with(traces.as_ref().map(Traces::layer));
        // Set already only when a test starts two services in one process.
        if subscriber.try_init().is_ok() {
            std::panic::set_hook(Box::new(|panic| {
                let place = panic.location().map(ToString::to_string);
                tracing::error!(panic = panic.payload_as_str(), place, "something panicked");
            }));
        }
        Ok(Logging {
            #[cfg(feature = "otel")]
            _traces: traces,
        })
    }
}
