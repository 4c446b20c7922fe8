//! Who may ask, and what: keys, tokens, the scopes they have, and how fast they may ask. Knows neither HTTP nor the store.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `rate` | how fast somebody may ask |
//! | `session` | what a browser has in place of a key or token |
//! | `token` | tokens of an identity provider |
//! | `scope` | what a key is good for |
//! | `api_key` | a key as people carry it |
//! | `key_secret` | what turns a key into the hash that is stored |
//! | `expiry` | when a key ends, as people write it |

mod api_key;
mod expiry;
mod key_secret;
mod random;
mod rate;
mod scope;
mod session;
mod token;

pub use api_key::{ApiKey, KeyHash};
pub use expiry::Expiry;
pub use key_secret::{KEY_SECRET_FILE, KeySecret, KeySecretError};
pub use rate::{Allowance, RateLimiter, WINDOW};
pub use scope::{Scope, Scopes};
pub use session::{SESSION, Session};
pub use token::{NoKeySet, TokenBearer, TokenKeySet, TokenRefusal, TokenRules, is_token, verify as verify_token};
