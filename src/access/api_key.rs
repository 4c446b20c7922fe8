//! A key as people carry it: `stillage_<id>_<secret>`.
//!
//! The id is public, finds the row of the key and stands in lists and logs. The secret has 256 random bits, so that nothing is
//! to be gained by a slow hash. The prefix lets scanners find keys that were left in repositories.

use std::fmt;

use super::key_secret::KeySecret;
use super::random::random_digits;

/// What every key begins with.
const PREFIX: &str = "stillage";
/// Random bytes of an id: two of a million keys are the same once in half a billion times.
const ID_BYTES: usize = 8;
/// Random bytes of a secret.
const SECRET_BYTES: usize = 32;

/// A key.
#[derive(Clone, PartialEq, Eq)]
pub struct ApiKey {
    id: String,
    secret: String,
}

/// What is stored of a key's secret: its keyed hash. Two of them are compared in constant time.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct KeyHash(blake3::Hash);

impl ApiKey {
    /// A new key.
    ///
    /// # Errors
    /// When the system has no random bytes.
    pub fn generate() -> std::io::Result<Self> {
        Ok(Self { id: random_digits(ID_BYTES)?, secret: random_digits(SECRET_BYTES)? })
    }

    /// Reads a key; `None` where the text cannot be one.
    #[must_use]
    pub fn read(text: &str) -> Option<Self> {
        let (id, secret) = text.strip_prefix(PREFIX)?.strip_prefix('_')?.split_once('_')?;
        let are_digits = |text: &str, bytes: usize| {
            text.len() == 2 * bytes && text.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f'))
        };
        let is_key = are_digits(id, ID_BYTES) && are_digits(secret, SECRET_BYTES);
        is_key.then(|| Self { id: id.to_owned(), secret: secret.to_owned() })
    }

    /// Its public part.
    #[must_use]
    pub fn id(&self) -> &str {
        &self.id
    }

    /// The whole key, to be shown once.
    #[must_use]
    pub fn reveal(&self) -> String {
        format!("{PREFIX}_{}_{}", self.id, self.secret)
    }

    /// What is stored of it. The id is in the hash, so that a row's hash fits no other row.
    #[must_use]
    pub fn hash(&self, secret: &KeySecret) -> KeyHash {
        KeyHash(blake3::keyed_hash(secret.bytes(), self.reveal().as_bytes()))
    }
}

impl fmt::Debug for ApiKey {
    /// Without the secret.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("ApiKey").field("id", &self.id).finish_non_exhaustive()
    }
}

impl KeyHash {
    /// Reads a hash that was stored.
    #[must_use]
    pub fn from_digits(digits: &str) -> Option<Self> {
        blake3::Hash::from_hex(digits).ok().map(Self)
    }
}

impl fmt::Display for KeyHash {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0.to_hex())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_read_as_it_was_shown_and_nothing_else_is_a_key() {
        let key = ApiKey::generate().expect("there are random bytes");
        let shown = key.reveal();
        assert_eq!(ApiKey::read(&shown), Some(key.clone()));
        assert_ne!(ApiKey::generate().expect("there are random bytes").id(), key.id());
        let upper = shown.to_uppercase();
        for text in ["", "stillage_", &shown[1..], &shown[..shown.len() - 1], &format!("{shown}0"), &upper] {
            assert_eq!(ApiKey::read(text), None, "{text}");
        }
        assert!(!format!("{key:?}").contains(&key.secret));
    }

    #[test]
    fn the_hash_depends_on_the_key_and_on_the_secret_of_the_service() {
        let (one, other) = (KeySecret::of([1; 32]), KeySecret::of([2; 32]));
        let key = ApiKey::generate().expect("there are random bytes");
        let hash = key.hash(&one);
        assert_eq!(KeyHash::from_digits(&hash.to_string()), Some(hash.clone()));
        assert_ne!(key.hash(&other), hash);
        assert_ne!(ApiKey { id: "0".repeat(16), ..key }.hash(&one), hash);
    }
}
