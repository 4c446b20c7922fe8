//! What a browser has in place of a key or a token, once somebody signed in with one: `<who>.<end>.<seal>`.
//!
//! Cookies go to every port of a host, so a key has no business in one. A session opens this service alone, ends by itself, and
//! ends with its key, or at the time at which its token does.

use base64::Engine as _;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use jiff::{SignedDuration, Timestamp};

use super::key_secret::KeySecret;
use super::scope::Scopes;
use super::token::TokenBearer;
use crate::records::Tenant;

/// How long somebody stays signed in: a working day, and the hours before and after.
pub const SESSION: SignedDuration = SignedDuration::from_hours(12);

/// What the seals of sessions are made for, so that they are no hashes of keys.
const CONTEXT: &str = "stillage 2026-11-29 seals of browser sessions";

/// What stands before whoever showed a token; ids of keys have no colon.
const BEARER: &str = "sub:";

/// That somebody signed in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Session {
    /// With a key.
    OfKey {
        /// Public part of the key.
        key: String,
        /// When it ends, to the second.
        end: Timestamp,
    },
    /// With a token, which need not be shown again.
    OfToken(TokenBearer),
}

impl Session {
    /// Its text, which only whoever knows the secret can make.
    #[must_use]
    pub fn seal(&self, secret: &KeySecret) -> String {
        let text = match self {
            Self::OfKey { key, end } => format!("{key}.{}", end.as_second()),
            Self::OfToken(TokenBearer { tenant, scopes, subject, end }) => {
                let bearer = format!("{tenant}\n{scopes}\n{subject}");
                format!("{BEARER}{}.{}", BASE64_URL_SAFE_NO_PAD.encode(bearer), end.as_second())
            }
        };
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
        let (who, end) = text.split_once('.')?;
        let end = Timestamp::from_second(end.parse().ok()?).ok()?;
        if end <= now {
            return None;
        }
        let Some(bearer) = who.strip_prefix(BEARER) else { return Some(Self::OfKey { key: who.to_owned(), end }) };
        let bearer = String::from_utf8(BASE64_URL_SAFE_NO_PAD.decode(bearer).ok()?).ok()?;
        let mut parts = bearer.splitn(3, '\n');
        let (tenant, scopes, subject) = (parts.next()?, parts.next()?, parts.next()?);
        let (tenant, scopes) = (Tenant::new(tenant), Scopes::of_words(scopes));
        Some(Self::OfToken(TokenBearer { tenant, scopes, subject: subject.to_owned(), end }))
    }
}

fn seal(text: &str, secret: &KeySecret) -> blake3::Hash {
    blake3::keyed_hash(&blake3::derive_key(CONTEXT, secret.bytes()), text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::access::Scope;

    fn time(second: i64) -> Timestamp {
        Timestamp::from_second(second).expect("a time")
    }

    #[test]
    fn a_session_is_read_until_it_ends_and_cannot_be_made_up() {
        let (secret, session) = (KeySecret::of([3; 32]), Session::OfKey { key: "5f0c".into(), end: time(1_000) });
        let text = session.seal(&secret);
        assert_eq!(Session::read(&text, &secret, time(999)), Some(session));
        assert_eq!(Session::read(&text, &secret, time(1_000)), None);
        assert_eq!(Session::read(&text, &KeySecret::of([4; 32]), time(0)), None);
        for wrong in [text.replace("1000", "2000"), text.replace("5f0c", "5f0d"), text[..9].to_owned(), String::new()] {
            assert_eq!(Session::read(&wrong, &secret, time(0)), None, "{wrong}");
        }
    }

    #[test]
    fn a_session_of_a_token_tells_who_showed_it() {
        let (tenant, scopes) = (Tenant::new("north.7"), [Scope::Read, Scope::Write].into_iter().collect());
        for subject in ["anna", "a.b;c\n\u{e4}"] {
            let bearer = TokenBearer { tenant: tenant.clone(), scopes, subject: subject.into(), end: time(1_000) };
            let (secret, session) = (KeySecret::of([3; 32]), Session::OfToken(bearer));
            let text = session.seal(&secret);
            assert!(text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b".:-_".contains(&byte)), "{text}");
            assert_eq!(Session::read(&text, &secret, time(999)), Some(session));
            assert_eq!(Session::read(&text, &secret, time(1_000)), None);
        }
    }
}
