//! Who has which key.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::tokens::TokenDoor;
use super::{App, AppError, Caller};
use crate::access::{ApiKey, KeyHash, KeySecret, SESSION, Session, is_token};
use crate::config::{Config, KeyRule};
use crate::records::KeyRecord;
use crate::store::now;

/// How long a key is known without a look into the database: a key that is revoked opens nothing after this time, on every
/// process. A new one works at once.
const KNOWN_FOR: Duration = Duration::from_secs(1);

/// Keys known at the same time.
const MOST_KNOWN: usize = 10_000;

/// What somebody shows who asks.
#[derive(Debug, Clone)]
pub enum Credential {
    /// A key, or a token of an identity provider.
    Key(String),
    /// A session of a browser.
    Session(String),
}

/// What keys are checked with, and those that were seen a moment ago.
#[derive(Debug)]
pub(super) struct Keyring {
    secret: KeySecret,
    /// `None` where no tokens are taken.
    tokens: Option<TokenDoor>,
    known: Mutex<HashMap<String, (Instant, KeyRecord, KeyHash)>>,
}

impl Keyring {
    /// The keyring of a configuration, with the keys of its identity provider; `None` where requests need no key. In the folder of SQLite the secret is made where
    /// it is missing. Processes that share a database share its file, too, which none of them may make for itself.
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

    fn recall(&self, id: &str) -> Option<(KeyRecord, KeyHash)> {
        let known = self.known();
        let (seen, record, hash) = known.get(id)?;
        (seen.elapsed() < KNOWN_FOR).then(|| (record.clone(), hash.clone()))
    }

    fn remember(&self, record: KeyRecord, hash: KeyHash) {
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

impl App {
    /// Whether requests need a key.
    #[must_use]
    pub const fn needs_keys(&self) -> bool {
        self.keyring.is_some()
    }

    /// Who shows something; anybody where nothing is needed.
    ///
    /// # Errors
    /// [`AppError::Unauthorized`] where it opens nothing.
    pub async fn sign_in(&self, shown: &Credential) -> Result<Caller, AppError> {
        let Some(keyring) = &self.keyring else { return Ok(Caller::local()) };
        let refused = |reason: &str| AppError::Unauthorized(reason.to_owned());
        let (id, hash) = match shown {
            Credential::Key(text) if is_token(text) => {
                let tokens = keyring.tokens.as_ref().ok_or_else(|| refused("no tokens are taken here: send a key"))?;
                return tokens.caller(text).await;
            }
            Credential::Key(text) => {
                let key = ApiKey::read(text).ok_or_else(|| refused("this key is not known here"))?;
                (key.id().to_owned(), Some(key.hash(&keyring.secret)))
            }
            Credential::Session(text) => {
                let session = Session::read(text, &keyring.secret, now());
                (session.ok_or_else(|| refused("the session has ended: sign in again"))?.key, None)
            }
        };
        // Two hashes are compared in constant time.
        let found = self.known_key(keyring, &id).await?.filter(|(_, stored)| hash.is_none_or(|hash| hash == *stored));
        let (record, _) = found.ok_or_else(|| refused("this key is not known here"))?;
        if record.is_valid_at(now()) {
            return Ok(Caller::with_key(&record));
        }
        Err(AppError::Unauthorized(match (record.revoked, record.expires) {
            (None, Some(end)) => format!("key {} ended at {end}: ask for a new one", record.id),
            _ => format!("key {} was revoked", record.id),
        }))
    }

    /// A session for a caller who signed in with a key; `None` for others.
    #[must_use]
    pub fn session(&self, caller: &Caller) -> Option<String> {
        let keyring = self.keyring.as_ref()?;
        let end = now().checked_add(SESSION).ok()?;
        Some(Session { key: caller.key()?.to_owned(), end }.seal(&keyring.secret))
    }

    async fn known_key(&self, keyring: &Keyring, id: &str) -> Result<Option<(KeyRecord, KeyHash)>, AppError> {
        if let Some(known) = keyring.recall(id) {
            return Ok(Some(known));
        }
        let found = self.store.keys().key(id).await?;
        if let Some((record, hash)) = &found {
            keyring.remember(record.clone(), hash.clone());
        }
        Ok(found)
    }
}
