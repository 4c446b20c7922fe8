//! `stillage serve`: the service, until it is told to stop.

use std::io::{self, Write};
use std::net::SocketAddr;
use std::num::NonZero;
use std::time::Duration;

use clap::Args;
use tokio::net::TcpListener;
use tokio::signal::unix::{Signal, SignalKind, signal};

use super::access::AccessArgs;
use super::logging::{LogArgs, LoggingError};
use super::storage::{BlobsNotShared, StorageArgs};
use super::tls::TlsArgs;
use crate::allowed_hosts::HostPattern;
use crate::app::{App, AppError};
use crate::config::{Config, DatabaseAddress, KeyRule, Role};
use crate::core_split::{CoreSplitError, JobCores};
use crate::ingest::Limits;
use crate::server::certificate::CertificateError;
use crate::server::{self, ConnectionLimits, open_files};

/// Serves the API. Everything can also be set in the environment.
#[derive(Debug, Clone, Args)]
pub(super) struct ServeArgs {
    /// Address and port; port 0 takes a free one and prints it.
    #[arg(long, env = "STILLAGE_LISTEN", default_value = "127.0.0.1:8080", value_name = "ADDRESS")]
    pub(super) listen: SocketAddr,
    /// Listen on an address that others can reach, although requests need no key: everybody who reaches it may read, change and
    /// delete every map.
    #[arg(long, env = "STILLAGE_ALLOW_PUBLIC")]
    pub(super) allow_public: bool,
    #[command(flatten)]
    pub(super) tls: TlsArgs,
    #[command(flatten)]
    pub(super) access: AccessArgs,
    #[command(flatten)]
    pub(super) storage: StorageArgs,
    /// What this process does. Several processes share a database of `--database postgres://...`.
    #[arg(long, env = "STILLAGE_ROLE", default_value = "all", value_name = "ROLE")]
    pub(super) role: Role,
    /// How long a job stays with a process that no longer says it works on it, seconds.
    #[arg(long, env = "STILLAGE_LEASE_S", default_value_t = 30, value_name = "S", value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) lease_s: u64,
    /// Jobs that run at the same time.
    #[arg(long, env = "STILLAGE_JOB_SLOTS", default_value_t = 1, value_name = "N")]
    pub(super) job_slots: usize,
    /// Compute threads, shared out among the job slots; all cores when absent.
    #[arg(long, env = "STILLAGE_COMPUTE_THREADS", value_name = "N")]
    pub(super) compute_threads: Option<usize>,
    /// Cores that requests have for themselves while jobs have all others: answers come as fast as without jobs, and jobs take
    /// as much longer as they have fewer cores. All do without.
    #[arg(long, env = "STILLAGE_REQUEST_CORES", value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) request_cores: Option<u16>,
    /// Jobs that may wait; further uploads are answered 503.
    #[arg(long, env = "STILLAGE_MAX_QUEUED_JOBS", default_value_t = 1_000, value_name = "N")]
    pub(super) max_queued_jobs: u64,
    /// How often a job is tried that a fault of the machine interrupts.
    #[arg(long, env = "STILLAGE_MAX_ATTEMPTS", default_value_t = 5, value_name = "N")]
    pub(super) max_attempts: u32,
    /// Memory that one job may need by estimate, MiB; larger maps are answered 413.
    #[arg(long, env = "STILLAGE_MAX_JOB_MIB", default_value_t = 8_192, value_name = "MIB")]
    pub(super) max_job_mib: u64,
    /// Largest upload, MiB.
    #[arg(long, env = "STILLAGE_MAX_UPLOAD_MIB", default_value_t = 128, value_name = "MIB")]
    pub(super) max_upload_mib: usize,
    /// Largest map, cells.
    #[arg(long, env = "STILLAGE_MAX_CELLS", default_value_t = 100_000_000, value_name = "N")]
    pub(super) max_cells: u64,
    /// Free disk space below which uploads are answered 507, MiB.
    #[arg(long, env = "STILLAGE_MIN_FREE_MIB", default_value_t = 256, value_name = "MIB")]
    pub(super) min_free_mib: u64,
    /// Analysed maps kept in memory.
    #[arg(long, env = "STILLAGE_CACHED_MAPS", default_value_t = 8, value_name = "N")]
    pub(super) cached_maps: usize,
    /// How long a deleted map can be restored, minutes; 0 deletes at once. Where the disk is short, no deleted map is kept.
    #[arg(long, env = "STILLAGE_KEEP_DELETED_MINUTES", default_value_t = 60, value_name = "MINUTES")]
    pub(super) keep_deleted_minutes: u32,
    /// Memory for answers that are given again as they are, MiB; 0 for none.
    #[arg(long, env = "STILLAGE_CACHED_ANSWER_MIB", default_value_t = 64, value_name = "MIB")]
    pub(super) cached_answer_mib: usize,
    /// Corrections that a map may have; further ones are refused.
    #[arg(long, env = "STILLAGE_MAX_CORRECTIONS", default_value_t = 10_000, value_name = "N")]
    pub(super) max_corrections: usize,
    /// Faces that one correction may make, such as the places of a row.
    #[arg(long, env = "STILLAGE_MAX_CORRECTION_FACES", default_value_t = 5_000, value_name = "N")]
    pub(super) max_correction_faces: usize,
    /// Connections at the same time. Beyond that, the one that has been waiting for its client longest makes room for the next.
    #[arg(long, env = "STILLAGE_MAX_CONNECTIONS", default_value_t = 1_024, value_name = "N")]
    pub(super) max_connections: usize,
    /// Connections of one address at the same time; half of all when absent, behind a trusted proxy all.
    #[arg(long, env = "STILLAGE_MAX_CONNECTIONS_PER_ADDRESS", value_name = "N")]
    pub(super) max_connections_per_address: Option<usize>,
    /// Requests under way at the same time, those that wait for their turn included; further ones are answered 503.
    #[arg(long, env = "STILLAGE_MAX_REQUESTS", default_value_t = 256, value_name = "N")]
    pub(super) max_requests: usize,
    /// The same of requests that compute (pictures, routes, exports), and of uploads.
    #[arg(long, env = "STILLAGE_MAX_HEAVY_REQUESTS", default_value_t = 32, value_name = "N")]
    pub(super) max_heavy_requests: usize,
    /// Requests that arrive are held on the disk until they are there: so much of them at the same time, MiB.
    #[arg(long, env = "STILLAGE_MAX_UPLOADING_MIB", default_value_t = 4_096, value_name = "MIB")]
    pub(super) max_uploading_mib: u64,
    /// Streams of events that are open at the same time; an address may have a quarter of them, a trusted proxy all.
    #[arg(long, env = "STILLAGE_MAX_EVENT_STREAMS", default_value_t = 256, value_name = "N")]
    pub(super) max_event_streams: usize,
    /// Host names under which the service answers, beside localhost and every address, separated by commas:
    /// `maps.example.com`, `*.example.com`, or `*` for all.
    #[arg(long, env = "STILLAGE_ALLOWED_HOSTS", value_delimiter = ',', value_name = "NAMES")]
    pub(super) allowed_hosts: Vec<HostPattern>,
    /// Believe `Forwarded` and `X-Forwarded-*`: links then have the address by which clients reach the proxy in front. Only
    /// behind a proxy that sets or removes these headers.
    #[arg(long, env = "STILLAGE_TRUST_PROXY")]
    pub(super) trust_proxy: bool,
    /// How long the service is not ready after a request to stop and still answers, seconds, so that balancers see it.
    #[arg(long, env = "STILLAGE_SHUTDOWN_NOTICE_S", default_value_t = 1, value_name = "S")]
    pub(super) shutdown_notice_s: u64,
    /// How long running jobs may go on after a request to stop, seconds; then they are put back.
    #[arg(long, env = "STILLAGE_SHUTDOWN_GRACE_S", default_value_t = 25, value_name = "S")]
    pub(super) shutdown_grace_s: u64,
    #[command(flatten)]
    logging: LogArgs,
}

/// Why the service did not start.
#[derive(Debug, thiserror::Error)]
pub(super) enum ServeError {
    /// An address that others can reach, without saying so.
    #[error(
        "{0} can be reached from other machines: pass --keys required (`stillage key create` makes keys), listen on 127.0.0.1 \
        behind a proxy that knows its users, or let everybody in with --allow-public"
    )]
    Public(SocketAddr),
    /// A database of several processes with the blobs of one.
    #[error(transparent)]
    Storage(#[from] BlobsNotShared),
    /// A part of a service on a database that no other part can use.
    #[error("{0} is of one process, which has to do everything: choose --role all, or --database postgres://...")]
    OneProcess(DatabaseAddress),
    /// The port is taken, or the address is not of this machine.
    #[error("cannot listen on {address}: {source}")]
    Listen {
        /// The address.
        address: SocketAddr,
        /// What the system says.
        source: io::Error,
    },
    /// What is asked of the log makes no sense.
    #[error(transparent)]
    Log(#[from] LoggingError),
    /// Requests and jobs cannot have cores of their own.
    #[error(transparent)]
    Cores(#[from] CoreSplitError),
    /// Cores are split between two kinds of work, and the process has one.
    #[error(
        "--request-cores is for a process that answers requests and works on jobs: choose --role all, or leave it out"
    )]
    OneKindOfWork,
    /// The files of TLS.
    #[error("--tls-cert and --tls-key: {0}")]
    Tls(#[from] CertificateError),
    /// The store does not open.
    #[error("{}", root(.0))]
    App(#[from] AppError),
    /// Threads, signals.
    #[error("the system refused: {0}")]
    System(#[from] io::Error),
}

/// An internal error hides its cause from clients, not from whoever starts the service.
fn root(error: &AppError) -> &dyn std::fmt::Display {
    match error {
        AppError::Internal(source) => source,
        other => other,
    }
}

impl ServeArgs {
    /// The configuration that the arguments mean, with the cores that jobs have for themselves.
    ///
    /// # Errors
    /// When they contradict one another.
    pub fn config(&self, job_cores: Option<JobCores>) -> Result<Config, ServeError> {
        let defaults = self.access.config(self.storage.config()?);
        let threads = job_cores.as_ref().map_or(defaults.compute_threads, |cores| cores.count().get());
        if self.role != Role::All && !defaults.database.is_shared() {
            return Err(ServeError::OneProcess(defaults.database));
        }
        if self.role != Role::All && self.request_cores.is_some() {
            return Err(ServeError::OneKindOfWork);
        }
        Ok(Config {
            role: self.role,
            is_tls: self.tls.is_given(),
            lease: Duration::from_secs(self.lease_s),
            limits: Limits {
                max_bytes: self.max_upload_mib.saturating_mul(1 << 20),
                max_cells: self.max_cells,
                ..defaults.limits
            },
            job_slots: if self.role == Role::Api { 0 } else { self.job_slots },
            compute_threads: self.compute_threads.unwrap_or(threads),
            job_cores,
            max_attempts: self.max_attempts,
            max_queued_jobs: self.max_queued_jobs,
            max_requests: self.max_requests,
            max_heavy_requests: self.max_heavy_requests,
            max_uploading_bytes: self.max_uploading_mib.saturating_mul(1 << 20),
            max_event_streams: self.max_event_streams,
            min_free_bytes: self.min_free_mib.saturating_mul(1 << 20),
            max_job_bytes: self.max_job_mib.saturating_mul(1 << 20),
            cached_maps: self.cached_maps,
            keep_deleted: Duration::from_mins(u64::from(self.keep_deleted_minutes)),
            cached_answer_bytes: self.cached_answer_mib.saturating_mul(1 << 20),
            max_corrections: self.max_corrections,
            max_correction_faces: self.max_correction_faces,
            allowed_hosts: self.allowed_hosts.clone().into(),
            trust_proxy: self.trust_proxy,
            shutdown_notice: Duration::from_secs(self.shutdown_notice_s),
            shutdown_grace: Duration::from_secs(self.shutdown_grace_s),
            ..defaults
        })
    }
}

impl ServeArgs {
    /// The connections that there may be, as far as the system lets there be so many.
    fn connections(&self) -> ConnectionLimits {
        let in_all = open_files::make_room(self.max_connections.max(1));
        let of_address = if self.trust_proxy { in_all } else { in_all.div_ceil(2) };
        ConnectionLimits { in_all, of_address: self.max_connections_per_address.unwrap_or(of_address).max(1) }
    }
}

/// Serves until SIGTERM or SIGINT; a second one ends the process at once (jobs survive that too).
pub(super) fn run(args: &ServeArgs) -> Result<(), ServeError> {
    if args.access.keys == KeyRule::None && !args.allow_public && !args.listen.ip().is_loopback() {
        return Err(ServeError::Public(args.listen));
    }
    let _logging = args.logging.start()?;
    // Before the threads of the runtime, which stay on the cores of this one.
    let request_cores = args.request_cores.map(usize::from).and_then(NonZero::new);
    let job_cores = request_cores.map(JobCores::beside_requests).transpose()?;
    tokio::runtime::Builder::new_multi_thread().enable_all().build()?.block_on(serve(args, job_cores))
}

async fn serve(args: &ServeArgs, job_cores: Option<JobCores>) -> Result<(), ServeError> {
    let address = args.listen;
    let listener = TcpListener::bind(address).await.map_err(|source| ServeError::Listen { address, source })?;
    let mut signals = StopSignals::listen()?;
    let tls = args.tls.open()?;
    let app = App::open(args.config(job_cores)?).await?;
    // Whoever started the service may not listen any more.
    let _ = writeln!(
        io::stdout(),
        "listening on {}://{}",
        if tls.is_some() { "https" } else { "http" },
        listener.local_addr()?
    );
    tracing::info!(version = env!("CARGO_PKG_VERSION"), role = ?args.role, "started");
    let stop = async {
        signals.next().await;
        tracing::info!("stopping: running requests and jobs may end");
        tokio::spawn(async move {
            signals.next().await;
            tracing::warn!("stopped at once");
            std::process::exit(130);
        });
    };
    server::serve(listener, tls, app, args.connections(), stop).await;
    tracing::info!("stopped");
    Ok(())
}

/// The two signals that ask a service to stop.
struct StopSignals {
    terminate: Signal,
    interrupt: Signal,
}

impl StopSignals {
    fn listen() -> io::Result<Self> {
        Ok(Self { terminate: signal(SignalKind::terminate())?, interrupt: signal(SignalKind::interrupt())? })
    }

    async fn next(&mut self) {
        tokio::select! {
            _ = self.terminate.recv() => {}
            _ = self.interrupt.recv() => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        serve: ServeArgs,
    }

    #[test]
    fn the_defaults_of_the_command_line_are_those_of_the_configuration() {
        let args = Line::parse_from(["stillage"]).serve;
        assert_eq!(format!("{:?}", args.config(None).unwrap()), format!("{:?}", Config::new("data")));
    }

    #[test]
    fn what_processes_share_must_be_shared_whole() {
        let refusal = |arguments: &[&str]| {
            let args = Line::parse_from(["stillage"].iter().chain(arguments)).serve;
            args.config(None).expect_err("it contradicts itself").to_string()
        };
        assert!(refusal(&["--role", "worker"]).starts_with("sqlite:data is of one process"));
        #[cfg(feature = "postgres")]
        {
            let refusal = refusal(&["--database", "postgres://me:secret@host/maps"]);
            assert!(
                refusal.starts_with("postgres://host/maps is shared by processes, and its blobs must be"),
                "{refusal}"
            );
        }
    }

    #[cfg(feature = "postgres")]
    #[test]
    fn cores_are_split_between_two_kinds_of_work() {
        let shared =
            ["--database", "postgres://host/maps", "--blobs", "file:///maps", "--request-cores", "1", "--role"];
        for (role, is_split) in [("all", true), ("api", false), ("worker", false)] {
            let args = Line::parse_from(["stillage"].iter().chain(&shared).chain(&[role])).serve;
            assert_eq!(args.config(None).is_ok(), is_split, "{role}");
        }
    }

    #[test]
    fn an_address_that_others_reach_must_be_asked_for() {
        let args = Line::parse_from(["stillage", "--listen", "0.0.0.0:0"]).serve;
        let refusal = run(&args).expect_err("it is public").to_string();
        assert!(refusal.starts_with("0.0.0.0:0 can be reached from other machines"), "{refusal}");
    }
}
