//! Who has which key.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::AppError;
use super::tokens::TokenDoor;
use crate::access::{KeyHash, KeySecret};
use crate::config::{Config, KeyRule};
use crate::records::KeyRecord;

/// How long a key is known without a look into the database: a key that is revoked opens nothing after this time, on every
/// process. A new one works at once.
const KNOWN_FOR: Duration = Duration::from_secs(1);

/// Keys known at the same time.
const MOST_KNOWN: usize = 10_000;

/// What keys are checked with, and those that were seen a moment ago.
#[derive(Debug)]
pub(super) struct Keyring {
    pub(super) secret: KeySecret,
    /// `None` where no tokens are taken.
    pub(super) tokens: Option<TokenDoor>,
    known: Mutex<HashMap<String, (Instant, KeyRecord, KeyHash)>>,
}

impl Keyring {
    /// The keyring of a configuration, with the keys of its identity provider; `None` where requests need no key. In the folder
    /// of SQLite the secret is made where it is missing. Processes that share a database share its file, too, which none of
    /// them may make for itself.
    pub(super) async fn open(config: &Config) -> Result<Option<Self>, AppError> {
        if config.keys == KeyRule::None {
            return Ok(None);
        }
        let is_own = config.key_secret_file.is_none();
        let secret = config
            .key_secret_path()
            .and_then(|path| if is_own { KeySecret::read_or_make(&path) } else { KeySecret::read(&path) });
        let secret = secret.map_err(|error| AppError::Internal(Box::new(error)))?;
        let tokens = match config.tokens.clone() {
            Some(config) => Some(TokenDoor::open(config).await.map_err(|error| AppError::Internal(Box::new(error)))?),
            None => None,
        };
        Ok(Some(Self { secret, tokens, known: Mutex::default() }))
    }

    pub(super) fn recall(&self, id: &str) -> Option<(KeyRecord, KeyHash)> {
        let known = self.known();
        let (seen, record, hash) = known.get(id)?;
        (seen.elapsed() < KNOWN_FOR).then(|| (record.clone(), hash.clone()))
    }

    pub(super) fn remember(&self, record: KeyRecord, hash: KeyHash) {
        let mut known = self.known();
        if known.len() >= MOST_KNOWN {
            known.clear();
        }
        known.insert(record.id.clone(), (Instant::now(), record, hash));
    }

    fn known(&self) -> MutexGuard<'_, HashMap<String, (Instant, KeyRecord, KeyHash)>> {
        // Every statement above leaves it whole.
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
