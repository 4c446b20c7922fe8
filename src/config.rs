//! Everything that can be configured, read once at the start.

use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::access::{KEY_SECRET_FILE, KeySecretError, TokenRules};
use crate::allowed_hosts::AllowedHosts;
use crate::core_split::JobCores;
use crate::ingest::Limits;
pub use crate::storage_address::{BlobAddress, DatabaseAddress};
use crate::store::Quotas;

/// What a process does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Role {
    /// Answers requests and works on jobs.
    All,
    /// Answers requests; the jobs are for other processes.
    Api,
    /// Works on jobs; of requests it answers those for its health and metrics alone.
    Worker,
}

/// Whether requests need a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum KeyRule {
    /// Whoever reaches the service may do everything.
    None,
    /// Every request needs a key, but for health, the pages of the dashboard and the description of the API.
    Required,
}

/// Tokens of an identity provider.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TokenConfig {
    /// File or address of the provider's keys, a JWK Set.
    pub keys: String,
    /// Which of its tokens are taken.
    pub rules: TokenRules,
}

/// Configuration of a running service.
#[derive(Debug, Clone)]
pub struct Config {
    /// Where the rows are.
    pub database: DatabaseAddress,
    /// Where the blobs are.
    pub blobs: BlobAddress,
    /// What this process does.
    pub role: Role,
    /// Whether clients reach the listener by TLS.
    pub is_tls: bool,
    /// Whether requests need a key.
    pub keys: KeyRule,
    /// File of the secret that keys are hashed with; `None` for `key-secret` in the folder of SQLite.
    pub key_secret_file: Option<PathBuf>,
    /// Which tokens of an identity provider are taken in place of keys; none when absent.
    pub tokens: Option<TokenConfig>,
    /// Requests that a key may send in a minute; 0 for any number.
    pub requests_per_minute: u32,
    /// What a tenant may have.
    pub quotas: Quotas,
    /// How long the log of changes is kept.
    pub keep_audit: Duration,
    /// Limits on uploaded maps.
    pub limits: Limits,
    /// Jobs that run at the same time.
    pub job_slots: usize,
    /// Threads of the compute pool (shared by all jobs).
    pub compute_threads: usize,
    /// The cores of these threads; those of requests, too, when absent.
    pub job_cores: Option<JobCores>,
    /// How long a claim lasts without a heartbeat.
    pub lease: Duration,
    /// How often a running job reports and asks whether it was cancelled.
    pub heartbeat: Duration,
    /// How often a job that failed by a fault of the infrastructure is tried in all.
    pub max_attempts: u32,
    /// Jobs that may wait; further uploads are answered 503.
    pub max_queued_jobs: u64,
    /// Requests under way at the same time, those that wait for their turn included; further ones are answered 503.
    pub max_requests: usize,
    /// The same of requests that compute (pictures, routes, exports), and of uploads.
    pub max_heavy_requests: usize,
    /// Bytes of requests that are held at the same time until they have arrived.
    pub max_uploading_bytes: u64,
    /// Streams of events that are open at the same time.
    pub max_event_streams: usize,
    /// Free space below which uploads are answered 507, bytes.
    pub min_free_bytes: u64,
    /// Memory that one job may need by estimate, bytes.
    pub max_job_bytes: u64,
    /// Analysed maps kept in memory.
    pub cached_maps: usize,
    /// Memory for answers that are given again as they are, bytes; 0 for none.
    pub cached_answer_bytes: usize,
    /// Corrections that a map may have.
    pub max_corrections: usize,
    /// Faces that one correction may make.
    pub max_correction_faces: usize,
    /// Hosts under which the service answers.
    pub allowed_hosts: AllowedHosts,
    /// Whether what a proxy says about the client's address is believed.
    pub trust_proxy: bool,
    /// How long a deleted map is kept, so that it can be restored.
    pub keep_deleted: Duration,
    /// How long the service says that it is not ready, before it takes no more connections.
    pub shutdown_notice: Duration,
    /// How long running jobs may go on after a request to stop, before they are put back.
    pub shutdown_grace: Duration,
}

impl Config {
    /// The defaults, with SQLite and the blobs in a data folder.
    #[must_use]
    pub fn new(data: impl Into<PathBuf>) -> Self {
        let data = data.into();
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        Self {
            blobs: BlobAddress::Folder(data.join("blobs")),
            database: DatabaseAddress::Sqlite(data),
            role: Role::All,
            is_tls: false,
            keys: KeyRule::None,
            key_secret_file: None,
            tokens: None,
            requests_per_minute: 6_000,
            quotas: Quotas::UNLIMITED,
            keep_audit: Duration::from_hours(365 * 24),
            limits: Limits::default(),
            job_slots: 1,
            compute_threads: cores,
            job_cores: None,
            lease: Duration::from_secs(30),
            heartbeat: Duration::from_millis(250),
            max_attempts: 5,
            max_queued_jobs: 1_000,
            max_requests: 256,
            max_heavy_requests: 32,
            max_uploading_bytes: 4 << 30,
            max_event_streams: 256,
            min_free_bytes: 256 << 20,
            max_job_bytes: 8 << 30,
            cached_maps: 8,
            // A layer of 10,000 faces has 7 MB before it is compressed.
            cached_answer_bytes: 64 << 20,
            max_corrections: 10_000,
            max_correction_faces: 5_000,
            allowed_hosts: AllowedHosts::default(),
            trust_proxy: false,
            keep_deleted: Duration::from_hours(1),
            shutdown_notice: Duration::from_secs(1),
            shutdown_grace: Duration::from_secs(25),
        }
    }

    /// The file of the secret that keys are hashed with.
    ///
    /// # Errors
    /// Processes that share a database share the file, too, so it has to be named.
    pub fn key_secret_path(&self) -> Result<PathBuf, KeySecretError> {
        let in_folder = || self.database.folder().map(|folder| folder.join(KEY_SECRET_FILE));
        self.key_secret_file.clone().or_else(in_folder).ok_or(KeySecretError::NotNamed)
    }

    /// The folder for requests that are being received: that of the rows or the blobs, or where neither is on this machine, that
    /// of temporary files.
    #[must_use]
    pub fn upload_folder(&self) -> PathBuf {
        let own = self.database.folder().or_else(|| self.blobs.folder());
        own.map_or_else(std::env::temp_dir, Path::to_owned)
    }
}
