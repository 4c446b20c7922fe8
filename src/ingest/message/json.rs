//! A message as JSON: bare, or in what rosbridge and service clients wrap around it.
//!
//! Looked into are `msg` (`{"op": "publish", "topic": ..., "msg": ...}`), `values` (answers of services), `map`
//! (`nav_msgs/GetMap`), `message` and `response`. `NaN` and `Infinity`, which JSON does not have and Python writes, are
//! taken as texts: in members that nothing needs they do no harm, elsewhere they are refused with the member's name.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::error::Category;

use super::cells::{Cells, DATA};
use super::parts::MessageParts;
use crate::ingest::IngestError;
use crate::ingest::document::Node;

/// Members that hold a message.
const ENVELOPES: [&str; 5] = ["msg", "values", "map", "message", "response"];
/// What Python, JavaScript and C++ print for numbers that are none.
const NO_NUMBERS: [&[u8]; 8] = [b"-Infinity", b"Infinity", b"-NaN", b"NaN", b"-nan", b"nan", b"-inf", b"inf"];

/// Reads a message.
pub(super) fn read(bytes: &[u8]) -> Result<MessageParts, IngestError> {
    let parse = |bytes: &[u8]| serde_json::from_slice::<Layer>(bytes);
    let layer = parse(bytes).or_else(|error| match quote_no_numbers(bytes) {
        Some(quoted) if error.is_syntax() => parse(&quoted),
        _ => Err(error),
    });
    let mut layer = layer.map_err(|error| refuse(&error))?;
    let mut pointer = String::new();
    while layer.info.is_none() && layer.data.is_none() {
        let Some((name, inner)) = layer.inner else { break };
        pointer.push('/');
        pointer.push_str(name);
        layer = *inner;
    }
    if layer.info.is_none() && layer.data.is_none() {
        let message = "there is no OccupancyGrid message: send the object that has `info` and `data`, alone or as the \
                       member `msg`, `map` or `values` of the answer it came in";
        return Err(IngestError::invalid("", message));
    }
    Ok(MessageParts { pointer, info: layer.info, data: layer.data.map(|Cells(cells)| cells) })
}

fn refuse(error: &serde_json::Error) -> IngestError {
    let text = error.to_string();
    let reason = text.rsplit_once(" at line ").map_or(text.as_str(), |(reason, _)| reason);
    let place = format!("line {}, column {}", error.line(), error.column());
    match error.classify() {
        Category::Data if reason.starts_with(DATA) => IngestError::invalid("/data", reason),
        Category::Data => IngestError::invalid(
            "/data",
            "`data` must be a list of whole numbers from -1 to 100, or their bytes as base64",
        ),
        Category::Eof => IngestError::invalid("", format!("the JSON is cut off at {place}: send the whole message")),
        Category::Syntax | Category::Io => {
            IngestError::invalid("", format!("this is no JSON from {place} on: send the message as JSON"))
        }
    }
}

/// The text with quotes around [`NO_NUMBERS`]; `None` where there are none outside of texts. O(bytes).
fn quote_no_numbers(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut quoted = Vec::new();
    let (mut copied, mut at, mut in_text) = (0, 0, false);
    while at < bytes.len() {
        let word = NO_NUMBERS.iter().find(|word| !in_text && bytes[at..].starts_with(word));
        match (bytes[at], word) {
            (_, Some(word)) => {
                quoted.extend_from_slice(&bytes[copied..at]);
                quoted.push(b'"');
                quoted.extend_from_slice(word);
                quoted.push(b'"');
                at += word.len();
                copied = at;
            }
            (b'\\', None) if in_text => at += 2,
            (b'"', None) => {
                in_text = !in_text;
                at += 1;
            }
            _ => at += 1,
        }
    }
    (copied > 0).then(|| {
        quoted.extend_from_slice(&bytes[copied..]);
        quoted
    })
}

/// An object that is a message, or has one in a member.
#[derive(Default)]
struct Layer {
    info: Option<Node>,
    data: Option<Cells>,
    inner: Option<(&'static str, Box<Self>)>,
}

impl<'de> Deserialize<'de> for Layer {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(LayerVisitor)
    }
}

struct LayerVisitor;

impl<'de> Visitor<'de> for LayerVisitor {
    type Value = Layer;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a message")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut members: A) -> Result<Layer, A::Error> {
        let mut layer = Layer::default();
        while let Some(key) = members.next_key::<String>()? {
            match key.as_str() {
                "info" => layer.info = Some(members.next_value()?),
                "data" => layer.data = Some(members.next_value()?),
                key => match ENVELOPES.into_iter().find(|name| *name == key) {
                    Some(name) => layer.inner = Some((name, Box::new(members.next_value()?))),
                    None => {
                        members.next_value::<IgnoredAny>()?;
                    }
                },
            }
        }
        Ok(layer)
    }

    // What stands in an envelope's place and is no object holds no message.
    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Layer, A::Error> {
        while items.next_element::<IgnoredAny>()?.is_some() {}
        Ok(Layer::default())
    }
    fn visit_str<E>(self, _: &str) -> Result<Layer, E> {
        Ok(Layer::default())
    }
    fn visit_bool<E>(self, _: bool) -> Result<Layer, E> {
        Ok(Layer::default())
    }
    fn visit_i64<E>(self, _: i64) -> Result<Layer, E> {
        Ok(Layer::default())
    }
    fn visit_u64<E>(self, _: u64) -> Result<Layer, E> {
        Ok(Layer::default())
    }
    fn visit_f64<E>(self, _: f64) -> Result<Layer, E> {
        Ok(Layer::default())
    }
    fn visit_unit<E>(self) -> Result<Layer, E> {
        Ok(Layer::default())
    }
}
