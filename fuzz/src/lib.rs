//! What strangers send, read as the service reads it: a function for each kind, which takes any bytes.
//!
//! Each either reads the bytes or refuses them in few words, and may do nothing else: panic, run for ever, or fill the
//! memory. `cargo fuzz run TARGET` looks for bytes that make one do so; `tests/fuzz` of the program gives each what is kept in
//! `corpus/TARGET`. `docs/reliability.md` has the commands and what was found.

mod areas;
mod choices;
mod filters;
mod maps;
mod protocol;
mod service;

pub use areas::{corrections, names, truth};
pub use choices::{options, rule_set};
pub use filters::{filter_json, filter_text};
pub use maps::{map_image, map_message, map_metadata};
pub use protocol::{heads, token};
pub use service::request;

/// Reads bytes.
type Reader = fn(&[u8]);

/// The functions by their names, which are those of their folders in `corpus`.
pub const TARGETS: [(&str, Reader); 13] = [
    ("corrections", corrections),
    ("filter_json", filter_json),
    ("filter_text", filter_text),
    ("heads", heads),
    ("map_image", map_image),
    ("map_message", map_message),
    ("map_metadata", map_metadata),
    ("names", names),
    ("options", options),
    ("request", request),
    ("rule_set", rule_set),
    ("token", token),
    ("truth", truth),
];

/// Longest refusal, bytes: some sentences, and of the input a few words.
const LONGEST_REFUSAL: usize = 600;

/// A refusal is short, however long the input is.
fn check_refusal(refusal: &impl std::fmt::Display) {
    let words = refusal.to_string();
    assert!(!words.is_empty() && words.len() <= LONGEST_REFUSAL, "{} bytes: {words}", words.len());
}
