//! Who has which key.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::{App, AppError, Caller};
use crate::access::{ApiKey, KeyHash, KeySecret, KeySecretError};
use crate::config::{Config, KeyRule};
use crate::records::KeyRecord;
use crate::store::now;

/// How long a key is known without a look into the database: a key that is revoked opens nothing after this time, on every
/// process. A new one works at once.
const KNOWN_FOR: Duration = Duration::from_secs(1);

/// Keys known at the same time.
const MOST_KNOWN: usize = 10_000;

/// What keys are checked with, and those that were seen a moment ago.
#[derive(Debug)]
pub(super) struct Keyring {
    secret: KeySecret,
    known: Mutex<HashMap<KeyHash, (KeyRecord, Instant)>>,
}

impl Keyring {
    /// The keyring of a configuration; `None` where requests need no key. In the folder of SQLite the secret is made where
    /// it is missing. Processes that share a database share its file, too, which none of them may make for itself.
    pub(super) fn of(config: &Config) -> Result<Option<Self>, KeySecretError> {
        if config.keys == KeyRule::None {
            return Ok(None);
        }
        let path = config.key_secret_path()?;
        let is_own = config.key_secret_file.is_none();
        let secret = if is_own { KeySecret::read_or_make(&path)? } else { KeySecret::read(&path)? };
        Ok(Some(Self { secret, known: Mutex::default() }))
    }

    fn recall(&self, hash: &KeyHash) -> Option<KeyRecord> {
        let known = self.known();
        let (record, seen) = known.get(hash)?;
        (seen.elapsed() < KNOWN_FOR).then(|| record.clone())
    }

    fn remember(&self, hash: KeyHash, record: KeyRecord) {
        let mut known = self.known();
        if known.len() >= MOST_KNOWN {
            known.clear();
        }
        known.insert(hash, (record, Instant::now()));
    }

    fn known(&self) -> MutexGuard<'_, HashMap<KeyHash, (KeyRecord, Instant)>> {
        // Every statement above leaves it whole.
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl App {
    /// Whether requests need a key.
    #[must_use]
    pub const fn needs_keys(&self) -> bool {
        self.keyring.is_some()
    }

    /// Who has a key; anybody where none is needed.
    ///
    /// # Errors
    /// [`AppError::Unauthorized`] where it opens nothing.
    pub async fn sign_in(&self, key: &str) -> Result<Caller, AppError> {
        let Some(keyring) = &self.keyring else { return Ok(Caller::local()) };
        let unknown = || AppError::Unauthorized("this key is not known here".to_owned());
        let key = ApiKey::read(key).ok_or_else(unknown)?;
        let hash = key.hash(&keyring.secret);
        let record = match keyring.recall(&hash) {
            Some(record) => record,
            None => {
                let found = self.store.keys().key(key.id()).await?;
                // Two hashes are compared in constant time.
                let (record, _) = found.filter(|(_, stored)| *stored == hash).ok_or_else(unknown)?;
                keyring.remember(hash, record.clone());
                record
            }
        };
        if record.is_valid_at(now()) {
            return Ok(Caller::with_key(&record));
        }
        Err(AppError::Unauthorized(match (record.revoked, record.expires) {
            (None, Some(end)) => format!("key {} ended at {end}: ask for a new one", record.id),
            _ => format!("key {} was revoked", record.id),
        }))
    }
}
