//! Who may ask, and how much.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use super::quotas::QuotaArgs;
use super::tokens::TokenArgs;
use crate::config::{Config, KeyRule};

/// Who may ask, and how much.
#[derive(Debug, Clone, Args)]
pub(super) struct AccessArgs {
    /// Whether requests need a key, which `stillage key create` makes.
    #[arg(long, env = "STILLAGE_KEYS", default_value = "none", value_name = "RULE")]
    pub(super) keys: KeyRule,
    /// File of the secret that keys are hashed with; `key-secret` in the data folder when absent. Processes that share a
    /// database need one that all of them read.
    #[arg(long, env = "STILLAGE_KEY_SECRET_FILE", value_name = "FILE")]
    key_secret_file: Option<PathBuf>,
    /// Requests that a key may send in a minute; 0 for any number.
    #[arg(long, env = "STILLAGE_REQUESTS_PER_MINUTE", default_value_t = 6_000, value_name = "N")]
    requests_per_minute: u32,
    #[command(flatten)]
    tokens: TokenArgs,
    #[command(flatten)]
    quotas: QuotaArgs,
    /// How long the log of changes is kept, days.
    #[arg(long, env = "STILLAGE_KEEP_AUDIT_DAYS", default_value_t = 365, value_name = "DAYS")]
    keep_audit_days: u32,
}

impl AccessArgs {
    /// A configuration with what the arguments mean.
    pub(super) fn config(&self, defaults: Config) -> Config {
        Config {
            keys: self.keys,
            key_secret_file: self.key_secret_file.clone(),
            tokens: self.tokens.config(),
            requests_per_minute: self.requests_per_minute,
            quotas: self.quotas.quotas(self.keys),
            keep_audit: Duration::from_hours(u64::from(self.keep_audit_days) * 24),
            ..defaults
        }
    }
}
