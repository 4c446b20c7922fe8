//! Members of a document, read with a complaint about whatever is wrong.

use stillage_core::analysis::Diagnostic;
use stillage_core::excerpt;

use super::node::Node;
use super::numpy;
use super::odd_numbers::notation;
use crate::ingest::IngestError;

/// The entries of a mapping, with their pointer.
#[derive(Debug)]
pub(in crate::ingest) struct Fields<'a> {
    pointer: &'a str,
    entries: &'a [(String, Node)],
}

impl<'a> Fields<'a> {
    /// The entries of a mapping without duplicates.
    pub(in crate::ingest) fn of(node: &'a Node, pointer: &'a str) -> Result<Self, IngestError> {
        let Node::Mapping(entries) = node else {
            return Err(IngestError::invalid(pointer, format!("expected keys with values, found {}", node.kind())));
        };
        let fields = Self { pointer, entries };
        for (index, (key, _)) in entries.iter().enumerate() {
            if entries[..index].iter().any(|(earlier, _)| earlier == key) {
                let message = format!("`{}` is given twice: keep one of them", excerpt(key));
                return Err(fields.wrong(&excerpt(key), message));
            }
        }
        Ok(fields)
    }

    /// The keys, in the order of the document.
    pub(in crate::ingest) fn keys(&self) -> impl Iterator<Item = &'a str> {
        self.entries.iter().map(|(key, _)| key.as_str())
    }

    /// The value of a key, where it is given.
    pub(in crate::ingest) fn find(&self, key: &str) -> Option<&'a Node> {
        self.entries.iter().find(|(name, _)| name == key).map(|(_, node)| node)
    }

    /// The value of a key that must be given.
    pub(in crate::ingest) fn get(&self, key: &str) -> Result<&'a Node, IngestError> {
        self.find(key).ok_or_else(|| self.wrong(key, format!("`{key}` is missing")))
    }

    /// The pointer to a key (RFC 6901).
    pub(in crate::ingest) fn pointer_to(&self, key: &str) -> String {
        format!("{}/{}", self.pointer, key.replace('~', "~0").replace('/', "~1"))
    }

    /// A complaint about a key.
    pub(in crate::ingest) fn wrong(&self, key: &str, message: String) -> IngestError {
        IngestError::invalid(self.pointer_to(key), message)
    }

    /// The finite number of a key that must be given.
    pub(in crate::ingest) fn number(&self, key: &str, warnings: &mut Vec<Diagnostic>) -> Result<f64, IngestError> {
        number(self.get(key)?, &self.pointer_to(key), key, warnings)
    }
}

/// A finite number. One in quotes is read as `yaml-cpp` reads it, with a warning.
pub(in crate::ingest) fn number(
    node: &Node,
    pointer: &str,
    name: &str,
    warnings: &mut Vec<Diagnostic>,
) -> Result<f64, IngestError> {
    let wrong =
        |found: &str| Err(IngestError::invalid(pointer, format!("{name} must be a finite number, found {found}")));
    if let Some(value) = numpy::scalar(node).filter(|value| value.is_finite()) {
        let message =
            format!("{name} was written as a numpy scalar: it was read as {value}; write float(value) instead");
        warnings.push(Diagnostic::new("numpy-number", message));
        return Ok(value);
    }
    match node {
        Node::Number(value) if value.is_finite() => Ok(*value),
        Node::Text(text) if let Some(notation) = notation(text) => {
            let message = format!(
                "{name} is written as {} ({notation}), which not all readers take for the same number: write it as a decimal number",
                node.brief()
            );
            Err(IngestError::invalid(pointer, message))
        }
        Node::Text(text) => match text.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => {
                let message =
                    format!("{name} is a text, {}: it was read as the number {value}; remove the quotes", node.brief());
                warnings.push(Diagnostic::new("quoted-number", message));
                Ok(value)
            }
            _ => wrong(&node.brief()),
        },
        other => wrong(&other.brief()),
    }
}
