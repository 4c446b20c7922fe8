//! Text -> [`Node`]: JSON where it looks like an object, else YAML.
//!
//! Tags are not followed: nothing is constructed from a name. Anchors and merge keys are, a few of them. What does not
//! parse is told by its line and column, in words of this program.

use serde_saphyr::Error;

use super::node::Node;
use super::odd_numbers::kept_as_written;
use crate::ingest::IngestError;

/// Largest metadata document, bytes. A `map_server` file has some 150.
const MAX_BYTES: usize = 64 << 10;
/// Deepest nesting, and most nodes, of a document.
const MAX_DEPTH: usize = 16;
const MAX_NODES: usize = 1_000;
/// Most anchors, and as many repetitions of them, of a document.
const MAX_ANCHORS: usize = 32;

/// Parses a small document.
pub(in crate::ingest) fn parse(bytes: &[u8], pointer: &str) -> Result<Node, IngestError> {
    let refuse = |message: String| IngestError::invalid(pointer, message);
    if bytes.len() > MAX_BYTES {
        return Err(refuse(format!("the document has {} bytes, the most is {MAX_BYTES}", bytes.len())));
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        refuse(format!("the document is not UTF-8 text (byte {}): save it as UTF-8", error.valid_up_to()))
    })?;
    let text = windows_paths(text.strip_prefix('\u{feff}').unwrap_or(text));
    if text.trim_start().starts_with('{') {
        // A YAML flow mapping opens with a brace, too.
        return serde_json::from_str(&text).or_else(|error: serde_json::Error| {
            let place = format!("line {}, column {}", error.line(), error.column());
            parse_yaml(&text).map_err(|_| refuse(format!("this is neither JSON nor YAML from {place} on")))
        });
    }
    parse_yaml(&text).map_err(|reason| refuse(format!("the YAML cannot be read: {reason}")))
}

/// The text with slashes for the backslashes of paths in double quotes that are no escapes of YAML or JSON:
/// `image: "C:\maps\hall.png"` is written so on Windows, and means the path.
fn windows_paths(text: &str) -> String {
    let mended = |line: &str| -> String {
        let Some((key, quoted)) = line.split_once('"').filter(|(key, _)| key.trim_end().ends_with(':')) else {
            return line.to_owned();
        };
        let Some((path, rest)) = quoted.split_once('"').filter(|(path, _)| has_strange_escape(path)) else {
            return line.to_owned();
        };
        format!("{key}\"{}\"{rest}", path.replace('\\', "/"))
    };
    text.split_inclusive('\n').map(mended).collect()
}

/// Whether a text in double quotes has a backslash that no writer of YAML or JSON would put into a path.
fn has_strange_escape(text: &str) -> bool {
    text.split('\\').skip(1).any(|rest| {
        let digits = match rest.chars().next() {
            // Two in a row stand for one.
            None | Some('/') => return false,
            Some('x') => 2,
            Some('u') => 4,
            Some('U') => 8,
            Some(_) => return true,
        };
        let hexadecimal = rest.chars().skip(1).take(digits).filter(char::is_ascii_hexdigit).count();
        hexadecimal < digits
    })
}

/// Parses YAML under strict limits; the reason of a failure in one line.
fn parse_yaml(text: &str) -> Result<Node, String> {
    let budget = serde_saphyr::budget! {
        max_reader_input_bytes: Some(MAX_BYTES),
        max_total_scalar_bytes: MAX_BYTES,
        max_depth: MAX_DEPTH,
        flow_nesting_limit: MAX_DEPTH,
        max_nodes: MAX_NODES,
        max_events: 4 * MAX_NODES,
        max_aliases: MAX_ANCHORS,
        max_anchors: MAX_ANCHORS,
        max_merge_keys: MAX_ANCHORS,
        max_documents: 1,
    };
    let options = serde_saphyr::options! {
        budget: budget,
        alias_limits: serde_saphyr::alias_limits! {
            max_total_replayed_events: MAX_NODES,
            max_replay_stack_depth: 4,
        },
        with_snippet: false,
        leading_zero_numbers_as_strings: true,
        underscored_numbers_as_strings: true,
        ignore_binary_tag_for_string: true,
        duplicate_keys: serde_saphyr::options::DuplicateKeyPolicy::PassThrough,
        non_finite_float_policy: serde_saphyr::options::NonFiniteFloatPolicy::PassThrough,
    };
    serde_saphyr::from_str_with_options(&kept_as_written(text), options).map_err(|error| reason(&error))
}

/// Why YAML is refused. The reader's own words name its settings, which nobody outside can change.
fn reason(error: &Error) -> String {
    use serde_saphyr::budget::BudgetBreach::{Documents, InputBytes, Nodes};
    let place = error
        .location()
        .map_or_else(String::new, |place| format!(" (line {}, column {})", place.line(), place.column()));
    match error {
        Error::Budget { breach: Documents { .. }, .. } | Error::MultipleDocuments { .. } => {
            format!("it holds more than one document{place}: keep one, without a second `---`")
        }
        Error::Budget { breach: Nodes { .. } | InputBytes { .. }, .. } => {
            format!("it has more than {MAX_NODES} values{place}: a map_server file has seven")
        }
        Error::Budget { .. }
        | Error::AliasReplayCounterOverflow { .. }
        | Error::AliasReplayLimitExceeded { .. }
        | Error::AliasExpansionLimitExceeded { .. }
        | Error::AliasReplayStackDepthExceeded { .. } => {
            format!("it repeats (`&`, `*`) or nests more than a map_server file needs{place}: write the values out")
        }
        Error::UnknownAnchor { .. } => format!("`*` names no anchor (`&`) before it{place}: write the value out"),
        _ => format!(
            "it is no YAML that can be read{place}: check the indentation, brackets and quotes there, and nest less deep than {MAX_DEPTH}"
        ),
    }
}
