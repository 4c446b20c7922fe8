//! Every metric: its name (with the unit, as Prometheus has it), its kind, and what it says.

/// Kinds of metrics.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MetricKind {
    /// Only rises while the process lives.
    Counter,
    /// Is what it is at the moment.
    Gauge,
    /// Counts what lies below bounds.
    Histogram,
}

/// A metric.
#[derive(Debug, Clone, Copy)]
pub struct Metric {
    /// Its name.
    pub name: &'static str,
    /// Its kind.
    pub kind: MetricKind,
    /// What it says.
    pub help: &'static str,
}

macro_rules! metrics {
    ($($constant:ident = $name:literal, $kind:ident, $help:literal;)*) => {
        $(#[doc = $help] pub const $constant: &str = $name;)*

        /// All metrics.
        pub const METRICS: &[Metric] = &[$(Metric { name: $name, kind: MetricKind::$kind, help: $help },)*];
    };
}

metrics! {
    BUILD_INFO = "stillage_build_info", Gauge, "1, with the version, the role and the database of the process as labels.";

    HTTP_REQUESTS = "http_requests_total", Counter, "Requests by route, method and status.";
    HTTP_DURATION = "http_request_duration_seconds", Histogram, "Time to the head of the answer, by route and method.";
    HTTP_SHED = "http_requests_shed_total", Counter,
        "Requests and connections that were refused because there was too much to do, by reason.";
    HTTP_CONNECTIONS = "http_connections", Gauge, "Open connections.";
    HTTP_BODIES = "http_bodies_held_bytes", Gauge, "Bytes of requests that are held until they have arrived.";
    CACHE_ANSWERS = "answer_cache_requests_total", Counter,
        "Requests whose answer may be given again, by whether it was (hit, miss).";
    CACHE_BYTES = "answer_cache_bytes", Gauge, "Memory of the answers that are kept.";

    JOBS = "jobs", Gauge, "Jobs in the database by state.";
    JOBS_OLDEST = "jobs_oldest_waiting_seconds", Gauge, "How long ago the oldest waiting job was asked for; 0 without one.";
    JOB_ATTEMPTS = "job_attempts_total", Counter, "Jobs that this process began to work on.";
    JOB_ENDS = "job_ends_total", Counter,
        "How that ended: successful, failed, dismissed, requeued (to be tried again), given-back (the process stops), or lost.";
    JOB_RESCUES = "job_rescues_total", Counter, "Jobs that this process took from a worker that was gone.";
    JOB_DURATION = "job_duration_seconds", Histogram, "Time from the beginning of an attempt to its end.";
    JOB_STAGES = "job_stage_duration_seconds", Histogram, "Time of each stage of successful jobs.";

    DATABASE_UP = "database_up", Gauge, "1 where the database answered just now, else 0.";
    DATABASE_BUSY = "database_busy_total", Counter, "Calls that the database did not answer because it was busy or away.";
    DATABASE_LOG = "database_log_bytes", Gauge, "Length of the write-ahead log of SQLite.";
    DISK_FREE = "disk_free_bytes", Gauge, "Free space on the disk of the data folder, or of the folder of the blobs.";

    PROCESS_MEMORY = "process_resident_memory_bytes", Gauge, "Memory of the process.";
    PROCESS_FILES = "process_open_fds", Gauge, "Open files and connections of the process.";
    PROCESS_CPU = "process_cpu_seconds_total", Counter, "CPU time of the process.";
}
