//! Tokens of an identity provider, and its keys, which may change while the service runs.

use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::{AppError, Caller};
use crate::access::{NoKeySet, TokenKeySet, TokenRefusal, verify_token};
use crate::blocking::off_the_runtime;
use crate::config::TokenConfig;
use crate::store::now;

/// The keys are read again at most this often, where a token is not signed with one that is known.
const PAUSE: Duration = Duration::from_mins(1);

/// The longest set of keys that is read, bytes.
const MAX_BYTES: u64 = 1 << 20;

/// How long the provider may take to answer.
const PATIENCE: Duration = Duration::from_secs(10);

/// Why the keys of the provider are not known.
#[derive(Debug, thiserror::Error)]
#[error("--jwt-keys {place}: {reason}")]
pub struct NoTokenKeys {
    place: String,
    reason: String,
}

/// What tokens are checked with.
#[derive(Debug)]
pub(super) struct TokenDoor {
    config: TokenConfig,
    keys: Mutex<(Arc<TokenKeySet>, Instant)>,
}

impl TokenDoor {
    /// Reads the keys for the first time.
    pub(super) async fn open(config: TokenConfig) -> Result<Self, NoTokenKeys> {
        let keys = read(&config.keys).await?;
        Ok(Self { config, keys: Mutex::new((Arc::new(keys), Instant::now())) })
    }

    /// Who shows a token.
    pub(super) async fn caller(&self, token: &str) -> Result<Caller, AppError> {
        let verify = |keys: &TokenKeySet| verify_token(token, keys, &self.config.rules, now());
        let mut verified = verify(&self.known());
        if verified == Err(TokenRefusal::Signature) && self.read_again().await {
            verified = verify(&self.known());
        }
        verified.map(Caller::with_token).map_err(|refusal| AppError::Unauthorized(refusal.to_string()))
    }

    fn known(&self) -> Arc<TokenKeySet> {
        Arc::clone(&self.keys.lock().unwrap_or_else(PoisonError::into_inner).0)
    }

    /// Reads the keys once more, unless somebody did a moment ago. What cannot be read leaves those that are known.
    async fn read_again(&self) -> bool {
        {
            let mut keys = self.keys.lock().unwrap_or_else(PoisonError::into_inner);
            if keys.1.elapsed() < PAUSE {
                return false;
            }
            keys.1 = Instant::now();
        }
        match read(&self.config.keys).await {
            Ok(new) => {
                self.keys.lock().unwrap_or_else(PoisonError::into_inner).0 = Arc::new(new);
                true
            }
            Err(error) => {
                tracing::warn!(%error, "the keys of the identity provider could not be read again");
                false
            }
        }
    }
}

/// Reads the keys from a file or an address.
async fn read(place: &str) -> Result<TokenKeySet, NoTokenKeys> {
    let failed = |reason: String| NoTokenKeys { place: place.to_owned(), reason };
    let from = place.to_owned();
    let text = off_the_runtime(move || fetch(&from)).await.map_err(failed)?;
    TokenKeySet::read(&text).map_err(|NoKeySet| failed(NoKeySet.to_string()))
}

fn fetch(place: &str) -> Result<Vec<u8>, String> {
    let is_of_this_machine = ["http://127.0.0.1:", "http://localhost:"].iter().any(|begin| place.starts_with(begin));
    if place.starts_with("http://") && !is_of_this_machine {
        return Err("keys can be exchanged on the way over plain HTTP: use https".to_owned());
    }
    if !place.starts_with("https://") && !is_of_this_machine {
        return std::fs::read(Path::new(place)).map_err(|error| error.to_string());
    }
    let agent: ureq::Agent = ureq::Agent::config_builder().timeout_global(Some(PATIENCE)).build().into();
    let mut answer = agent.get(place).call().map_err(|error| error.to_string())?;
    answer.body_mut().with_config().limit(MAX_BYTES).read_to_vec().map_err(|error| error.to_string())
}
