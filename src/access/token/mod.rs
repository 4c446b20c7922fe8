//! Tokens of an identity provider: JWT (RFC 7519) signed with its keys (RFC 7515, 7517).
//!
//! What a token says of itself decides nothing: of the three algorithms, which are fixed, its key decides which one is used, and
//! only signatures are believed. What is not known is refused (`none`, `HS256`, `crit`).
//!
//! | file | what it holds |
//! | --- | --- |
//! | `rules` | which tokens are taken, and what they tell |
//! | `verify` | header, signature and claims of a token |
//! | `key_set` | the public keys of the provider |
//! | `claims` | what a token says, and whether it holds now and here |

mod claims;
mod key_set;
mod rules;
#[cfg(test)]
mod tests;
mod verify;

pub use key_set::{NoKeySet, TokenKeySet};
pub use rules::{TokenBearer, TokenRefusal, TokenRules};
pub use verify::{is_token, verify};
