//! What a service logs, and how.

use std::io::{self, IsTerminal as _};

use clap::{Args, ValueEnum};
use tracing_subscriber::Layer as _;
use tracing_subscriber::filter::{ParseError, Targets};
use tracing_subscriber::layer::SubscriberExt as _;
use tracing_subscriber::util::SubscriberInitExt as _;

/// What to log to standard error.
#[derive(Debug, Clone, Args)]
pub(super) struct LogArgs {
    /// What to log to standard error: a level, or directives such as `stillage=debug,sqlx=warn`.
    #[arg(long, visible_alias = "log-level", env = "STILLAGE_LOG", default_value = "info", value_name = "FILTER")]
    log: String,
    /// The form of log lines.
    #[arg(long, env = "STILLAGE_LOG_FORMAT", default_value = "text", value_name = "FORMAT")]
    log_format: LogFormat,
}

/// The form of log lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum LogFormat {
    /// For people.
    Text,
    /// One JSON object a line; `span` has the ids of the request or the job.
    Json,
}

impl LogArgs {
    /// Logs from now on, panics too.
    ///
    /// # Errors
    /// When the directives make no sense.
    pub(super) fn start(&self) -> Result<(), ParseError> {
        let targets: Targets = self.log.parse()?;
        // Colours are for a terminal: in a file they are noise.
        let lines = tracing_subscriber::fmt::layer().with_writer(io::stderr).with_ansi(io::stderr().is_terminal());
        let lines = match self.log_format {
            LogFormat::Text => lines.boxed(),
            LogFormat::Json => lines.json().flatten_event(true).with_span_list(false).boxed(),
        };
        // Set already only when a test starts two services in one process.
        if tracing_subscriber::registry().with(lines.with_filter(targets)).try_init().is_ok() {
            std::panic::set_hook(Box::new(|panic| {
                let place = panic.location().map(ToString::to_string);
                tracing::error!(panic = panic.payload_as_str(), place, "something panicked");
            }));
        }
        Ok(())
    }
}
