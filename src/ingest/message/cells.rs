//! `data` of a message in every form that JSON clients hold it in.
//!
//! - a list of whole numbers, `[0, 100, -1]`;
//! - a typed array that `JSON.stringify` wrote, `{"0": 0, "1": 100}`, in ascending order as JavaScript keeps it;
//! - a typed array or buffer with its name, `{"type": "Buffer", "data": [0, 100, 255]}`;
//! - the bytes as base64 text, as rosbridge sends arrays of bytes.

use std::fmt;

use base64::Engine as _;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use serde::Deserialize;
use serde::de::{Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::ingest::document::Node;

/// Begins every complaint about a cell.
pub(super) const DATA: &str = "data[";

/// Base64 with or without the padding at its end.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The cells of a message.
#[derive(Debug, PartialEq)]
pub(super) struct Cells(pub(super) Vec<i8>);

/// A cell, or the complaint about it. 255 is how an unsigned byte holds -1.
pub(super) fn cell(index: usize, value: &Node) -> Result<i8, String> {
    match value {
        Node::Number(value) if value.fract() == 0.0 && (-1.0..=100.0).contains(value) => Ok(*value as i8),
        Node::Number(255.0) => Ok(-1),
        other => Err(format!("{DATA}{index}] is {}, it must be a whole number from -1 to 100", other.brief())),
    }
}

impl<'de> Deserialize<'de> for Cells {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CellsVisitor)
    }
}

struct CellsVisitor;

impl<'de> Visitor<'de> for CellsVisitor {
    type Value = Cells;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("cells")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut values: A) -> Result<Cells, A::Error> {
        let mut cells = Vec::new();
        while let Some(value) = values.next_element::<Node>()? {
            cells.push(cell(cells.len(), &value).map_err(A::Error::custom)?);
        }
        Ok(Cells(cells))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut members: A) -> Result<Cells, A::Error> {
        let mut cells = Vec::new();
        while let Some(key) = members.next_key::<String>()? {
            match key.parse::<usize>() {
                Ok(index) if index == cells.len() => {
                    cells.push(cell(index, &members.next_value()?).map_err(A::Error::custom)?);
                }
                Ok(_) => {
                    let index = cells.len();
                    let message =
                        format!("{DATA}{index}] is missing: an object in place of the list needs every index");
                    return Err(A::Error::custom(message));
                }
                Err(_) if key == "data" => {
                    let Cells(named) = members.next_value()?;
                    cells = named;
                }
                Err(_) => {
                    members.next_value::<IgnoredAny>()?;
                }
            }
        }
        Ok(Cells(cells))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Cells, E> {
        let bytes = BASE64.decode(text).map_err(|_| {
            E::custom(format!("{DATA}0] is missing: `data` is a text, and not the base64 of the cells' bytes"))
        })?;
        let cells = bytes.iter().enumerate().map(|(index, &byte)| cell(index, &Node::Number(f64::from(byte))));
        cells.collect::<Result<_, _>>().map(Cells).map_err(E::custom)
    }
}
