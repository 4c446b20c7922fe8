//! A message as `ros2 topic echo` and `rostopic echo` print it: YAML, a mapping with `info` and `data` in its first column.
//!
//! `data` may be millions of numbers, which a YAML reader would take for millions of nodes: it is cut out of the text and
//! read as the list that it is, the rest is a small document. Of several messages the first is read. Cost: O(bytes).

use super::cells::cell;
use super::parts::MessageParts;
use crate::ingest::IngestError;
use crate::ingest::document::{self, Fields, Node};

/// Whether a text has the keys of a message in its first column.
pub(super) fn is_message(text: &str) -> bool {
    let has = |key: &str| text.lines().any(|line| line.starts_with(key));
    has("info:") && has("data:")
}

/// Reads the first message of a text.
pub(super) fn read(text: &str) -> Result<MessageParts, IngestError> {
    let (before, from_data) = split_at_data(text);
    let (list, after) = split_list(from_data);
    let cells = cells(list)?;
    let after = after.lines().take_while(|line| !line.starts_with("---")).collect::<Vec<_>>().join("\n");
    let rest = document::parse(format!("{before}\n{after}").as_bytes(), "")?;
    let info = Fields::of(&rest, "")?.find("info").cloned();
    Ok(MessageParts { pointer: String::new(), info, data: Some(cells) })
}

/// What lies before the key `data`, without the marks of documents, and what follows the key.
fn split_at_data(text: &str) -> (&str, &str) {
    const KEY: &str = "data:";
    let at = if text.starts_with(KEY) { Some(0) } else { text.find("\ndata:").map(|at| at + 1) };
    let (before, from_data) = text.split_at(at.unwrap_or(text.len()));
    (before.trim_start().trim_start_matches("---"), from_data.strip_prefix(KEY).unwrap_or_default())
}

/// The list in brackets or behind dashes, and what follows it.
fn split_list(text: &str) -> (&str, &str) {
    if text.trim_start().starts_with('[') {
        return text.split_at(text.find(']').map_or(text.len(), |end| end + 1));
    }
    let first = text.find('\n').map_or(text.len(), |end| end + 1);
    let belongs = |line: &&str| line.trim().is_empty() || line.starts_with([' ', '\t']) || line.starts_with("- ");
    let list = text[first..].split_inclusive('\n').take_while(belongs).map(str::len).sum::<usize>();
    text.split_at(first + list)
}

fn cells(list: &str) -> Result<Vec<i8>, IngestError> {
    let list = list.trim();
    let (inner, separator) = match list.strip_prefix('[') {
        Some(inner) => (inner.strip_suffix(']').unwrap_or(inner), ','),
        None => (list, '\n'),
    };
    let without_mark = |item: &str| item.trim().strip_prefix("- ").unwrap_or(item.trim()).trim().to_owned();
    let mut cells = Vec::new();
    for item in inner.split(separator).map(without_mark).filter(|item| !item.is_empty()) {
        let bare = item.trim_matches(['\'', '"']);
        if bare == "..." {
            let message = format!(
                "the message is cut after {} cells, as `topic echo` does: print it whole, with `ros2 topic echo \
                 --full-length --once`",
                cells.len()
            );
            return Err(IngestError::invalid("/data", message));
        }
        if bare.starts_with("<array") {
            let message = "the message was printed without its cells: leave out --no-arr";
            return Err(IngestError::invalid("/data", message));
        }
        let value = bare.parse().map_or_else(|_| Node::Text(bare.to_owned()), Node::Number);
        cells.push(cell(cells.len(), &value).map_err(|message| IngestError::invalid("/data", message))?);
    }
    Ok(cells)
}
