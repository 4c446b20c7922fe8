//! What a browser has in place of a key, once somebody signed in with one: `<id of the key>.<end>.<seal>`.
//!
//! Cookies go to every port of a host, so a key has no business in one. A session opens this service alone, ends by itself, and
//! ends with its key.

use jiff::{SignedDuration, Timestamp};

use super::key_secret::KeySecret;

/// How long somebody stays signed in: a working day, and the hours before and after.
pub const SESSION: SignedDuration = SignedDuration::from_hours(12);

/// What the seals of sessions are made for, so that they are no hashes of keys.
const CONTEXT: &str = "stillage 2026-11-29 seals of browser sessions";

/// That somebody signed in with a key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Session {
    /// Public part of the key.
    pub key: String,
    /// When it ends, to the second.
    pub end: Timestamp,
}

impl Session {
    /// Its text, which only whoever knows the secret can make.
    #[must_use]
    pub fn seal(&self, secret: &KeySecret) -> String {
        let text = format!("{}.{}", self.key, self.end.as_second());
        format!("{text}.{}", seal(&text, secret).to_hex())
    }

    /// Reads a text that was sealed with the secret and has not ended.
    #[must_use]
    pub fn read(text: &str, secret: &KeySecret, now: Timestamp) -> Option<Self> {
        let (text, sealed) = text.rsplit_once('.')?;
        let sealed = blake3::Hash::from_hex(sealed).ok()?;
        // Two hashes are compared in constant time.
        if sealed != seal(text, secret) {
            return None;
        }
        let (key, end) = text.split_once('.')?;
        let end = Timestamp::from_second(end.parse().ok()?).ok()?;
        (now < end).then(|| Self { key: key.to_owned(), end })
    }
}

fn seal(text: &str, secret: &KeySecret) -> blake3::Hash {
    blake3::keyed_hash(&blake3::derive_key(CONTEXT, secret.bytes()), text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_session_is_read_until_it_ends_and_cannot_be_made_up() {
        let time = |second| Timestamp::from_second(second).expect("a time");
        let (secret, session) = (KeySecret::of([3; 32]), Session { key: "5f0c".into(), end: time(1_000) });
        let text = session.seal(&secret);
        assert_eq!(Session::read(&text, &secret, time(999)), Some(session));
        assert_eq!(Session::read(&text, &secret, time(1_000)), None);
        assert_eq!(Session::read(&text, &KeySecret::of([4; 32]), time(0)), None);
        for wrong in [text.replace("1000", "2000"), text.replace("5f0c", "5f0d"), text[..9].to_owned(), String::new()] {
            assert_eq!(Session::read(&wrong, &secret, time(0)), None, "{wrong}");
        }
    }
}
