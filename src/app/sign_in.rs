//! Who shows a key, a token or a session.

use super::keyring::Keyring;
use super::{App, AppError, Caller};
use crate::access::{ApiKey, KeyHash, SESSION, Scope, Session, is_token};
use crate::records::KeyRecord;
use crate::store::now;

/// What somebody shows who asks.
#[derive(Debug, Clone)]
pub enum Credential {
    /// A key, or a token of an identity provider.
    Key(String),
    /// A session of a browser.
    Session(String),
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
        let (id, hash, end) = match shown {
            Credential::Key(text) if is_token(text) => {
                let tokens = keyring.tokens.as_ref().ok_or_else(|| refused("no tokens are taken here: send a key"))?;
                return tokens.caller(text).await;
            }
            Credential::Key(text) => {
                let key = ApiKey::read(text).ok_or_else(|| refused("this key is not known here"))?;
                (key.id().to_owned(), Some(key.hash(&keyring.secret)), None)
            }
            Credential::Session(text) => {
                let ended = || refused("the session has ended: sign in again");
                match Session::read(text, &keyring.secret, now()).ok_or_else(ended)? {
                    Session::OfKey { key, end } => (key, None, Some(end)),
                    Session::OfToken(bearer) if keyring.tokens.is_some() => return Ok(Caller::with_token(bearer)),
                    Session::OfToken(_) => return Err(ended()),
                }
            }
        };
        // Two hashes are compared in constant time.
        let found = self.known_key(keyring, &id).await?.filter(|(_, stored)| hash.is_none_or(|hash| hash == *stored));
        let (record, _) = found.ok_or_else(|| refused("this key is not known here"))?;
        if record.is_valid_at(now()) {
            return Ok(Caller::with_key(&record).until(end));
        }
        Err(AppError::Unauthorized(match (record.revoked, record.expires) {
            (None, Some(end)) => format!("key {} ended at {end}: ask for a new one", record.id),
            _ => format!("key {} was revoked", record.id),
        }))
    }

    /// Whether a caller who signed in a while ago may still do something: keys are revoked, and keys, tokens and sessions end.
    ///
    /// # Errors
    /// When the database does not answer.
    pub async fn still_may(&self, caller: &Caller, scope: Scope) -> Result<bool, AppError> {
        let Some(keyring) = &self.keyring else { return Ok(true) };
        if caller.has_ended_at(now()) || !caller.may(scope) {
            return Ok(false);
        }
        let Some(id) = caller.key() else { return Ok(true) };
        let found = self.known_key(keyring, id).await?;
        Ok(found.is_some_and(|(key, _)| key.is_valid_at(now()) && key.scopes.has(scope)))
    }

    /// A session for a caller who signed in; `None` where nobody has to.
    #[must_use]
    pub fn session(&self, caller: &Caller) -> Option<String> {
        let keyring = self.keyring.as_ref()?;
        let end = now().checked_add(SESSION).ok()?;
        Some(caller.session(end)?.seal(&keyring.secret))
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
