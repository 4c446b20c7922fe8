//! A small document, YAML or JSON, as a tree that keeps what loaders need to complain well.
//!
//! Both notations become the same [`Node`]: numbers stay apart from text, duplicate keys survive, and numbers may be
//! NaN or infinite, so that every complaint is made in one place and with a pointer.

use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use stillage_core::analysis::Diagnostic;

use super::IngestError;

/// Largest metadata document, bytes. A `map_server` file has some 150.
const MAX_BYTES: usize = 64 << 10;
/// Deepest nesting, and most nodes, of a document.
const MAX_DEPTH: usize = 16;
const MAX_NODES: usize = 1_000;

/// A value of a document.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Node {
    Null,
    Bool(bool),
    Number(f64),
    Text(String),
    List(Vec<Self>),
    /// In the order of the document, duplicates included.
    Mapping(Vec<(String, Self)>),
}

impl Node {
    /// What it is, for a complaint.
    fn kind(&self) -> &'static str {
        match self {
            Self::Null => "empty",
            Self::Bool(_) => "true or false",
            Self::Number(_) => "a number",
            Self::Text(_) => "a text",
            Self::List(_) => "a list",
            Self::Mapping(_) => "a mapping",
        }
    }
}

impl<'de> Deserialize<'de> for Node {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NodeVisitor;

        impl<'de> Visitor<'de> for NodeVisitor {
            type Value = Node;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("a value")
            }
            fn visit_unit<E>(self) -> Result<Node, E> {
                Ok(Node::Null)
            }
            fn visit_none<E>(self) -> Result<Node, E> {
                Ok(Node::Null)
            }
            fn visit_some<D: Deserializer<'de>>(self, deserializer: D) -> Result<Node, D::Error> {
                Node::deserialize(deserializer)
            }
            fn visit_bool<E>(self, value: bool) -> Result<Node, E> {
                Ok(Node::Bool(value))
            }
            fn visit_i64<E>(self, value: i64) -> Result<Node, E> {
                Ok(Node::Number(value as f64))
            }
            fn visit_u64<E>(self, value: u64) -> Result<Node, E> {
                Ok(Node::Number(value as f64))
            }
            fn visit_i128<E>(self, value: i128) -> Result<Node, E> {
                Ok(Node::Number(value as f64))
            }
            fn visit_u128<E>(self, value: u128) -> Result<Node, E> {
                Ok(Node::Number(value as f64))
            }
            fn visit_f64<E>(self, value: f64) -> Result<Node, E> {
                Ok(Node::Number(value))
            }
            fn visit_str<E>(self, value: &str) -> Result<Node, E> {
                Ok(Node::Text(value.to_owned()))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Node, A::Error> {
                let mut list = Vec::new();
                while let Some(item) = items.next_element()? {
                    list.push(item);
                }
                Ok(Node::List(list))
            }
            fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Node, A::Error> {
                let mut mapping = Vec::new();
                while let Some(entry) = entries.next_entry()? {
                    mapping.push(entry);
                }
                Ok(Node::Mapping(mapping))
            }
        }

        deserializer.deserialize_any(NodeVisitor)
    }
}

/// Parses a small document, JSON where it looks like an object, else YAML.
pub(super) fn parse(bytes: &[u8], pointer: &str) -> Result<Node, IngestError> {
    if bytes.len() > MAX_BYTES {
        let message = format!("the document has {} bytes, the most is {MAX_BYTES}", bytes.len());
        return Err(IngestError::invalid(pointer, message));
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        IngestError::invalid(
            pointer,
            format!("the document is not UTF-8 text (byte {}): save it as UTF-8", error.valid_up_to()),
        )
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim_start().starts_with('{') {
        let json: Result<Node, _> = serde_json::from_str(text);
        // A YAML flow mapping opens with a brace, too.
        return match json {
            Ok(node) => Ok(node),
            Err(error) => {
                parse_yaml(text).map_err(|_| IngestError::invalid(pointer, format!("the JSON cannot be read: {error}")))
            }
        };
    }
    parse_yaml(text).map_err(|reason| IngestError::invalid(pointer, format!("the YAML cannot be read: {reason}")))
}

/// Parses YAML under a strict budget; the reason of a failure in one line.
fn parse_yaml(text: &str) -> Result<Node, String> {
    let budget = serde_saphyr::budget! {
        max_reader_input_bytes: Some(MAX_BYTES),
        max_total_scalar_bytes: MAX_BYTES,
        max_depth: MAX_DEPTH,
        flow_nesting_limit: MAX_DEPTH,
        max_nodes: MAX_NODES,
        max_events: 4 * MAX_NODES,
        max_aliases: 0,
        max_anchors: 0,
        max_merge_keys: 0,
        max_documents: 1,
    };
    let options = serde_saphyr::options! {
        budget: budget,
        with_snippet: false,
        duplicate_keys: serde_saphyr::options::DuplicateKeyPolicy::PassThrough,
        non_finite_float_policy: serde_saphyr::options::NonFiniteFloatPolicy::PassThrough,
    };
    serde_saphyr::from_str_with_options(text, options).map_err(|error| {
        let reason = error.to_string();
        reason.lines().next().unwrap_or_default().to_owned()
    })
}

/// The entries of a mapping, with their pointer.
#[derive(Debug)]
pub(super) struct Fields<'a> {
    pointer: &'a str,
    entries: &'a [(String, Node)],
}

impl<'a> Fields<'a> {
    /// The entries of a mapping without duplicates.
    pub(super) fn of(node: &'a Node, pointer: &'a str) -> Result<Self, IngestError> {
        let Node::Mapping(entries) = node else {
            return Err(IngestError::invalid(pointer, format!("expected keys with values, found {}", node.kind())));
        };
        let fields = Self { pointer, entries };
        for (index, (key, _)) in entries.iter().enumerate() {
            if entries[..index].iter().any(|(earlier, _)| earlier == key) {
                return Err(fields.wrong(key, format!("`{key}` is given twice: keep one of them")));
            }
        }
        Ok(fields)
    }

    /// The keys, in the order of the document.
    pub(super) fn keys(&self) -> impl Iterator<Item = &'a str> {
        self.entries.iter().map(|(key, _)| key.as_str())
    }

    /// The value of a key, where it is given.
    pub(super) fn find(&self, key: &str) -> Option<&'a Node> {
        self.entries.iter().find(|(name, _)| name == key).map(|(_, node)| node)
    }

    /// The value of a key that must be given.
    pub(super) fn get(&self, key: &str) -> Result<&'a Node, IngestError> {
        self.find(key).ok_or_else(|| self.wrong(key, format!("`{key}` is missing")))
    }

    /// The pointer to a key (RFC 6901).
    pub(super) fn pointer_to(&self, key: &str) -> String {
        format!("{}/{}", self.pointer, key.replace('~', "~0").replace('/', "~1"))
    }

    /// A complaint about a key.
    pub(super) fn wrong(&self, key: &str, message: String) -> IngestError {
        IngestError::invalid(self.pointer_to(key), message)
    }

    /// The finite number of a key that must be given.
    pub(super) fn number(&self, key: &str, warnings: &mut Vec<Diagnostic>) -> Result<f64, IngestError> {
        number(self.get(key)?, &self.pointer_to(key), key, warnings)
    }
}

/// A finite number. One in quotes is read as `yaml-cpp` reads it, with a warning.
pub(super) fn number(
    node: &Node,
    pointer: &str,
    name: &str,
    warnings: &mut Vec<Diagnostic>,
) -> Result<f64, IngestError> {
    let wrong =
        |found: &str| Err(IngestError::invalid(pointer, format!("{name} must be a finite number, found {found}")));
    match node {
        Node::Number(value) if value.is_finite() => Ok(*value),
        Node::Number(value) => wrong(&value.to_string()),
        Node::Text(text) => match text.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => {
                let message =
                    format!("{name} is a text, \"{text}\": it was read as the number {value}; remove the quotes");
                warnings.push(Diagnostic::new("quoted-number", message));
                Ok(value)
            }
            _ => wrong(&format!("\"{text}\"")),
        },
        other => wrong(other.kind()),
    }
}
