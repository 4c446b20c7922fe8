//! The storage locations as a table for spreadsheets and inventory systems.

use crate::features::rows::locations::LocationRow;
use crate::features::{Feature, Row, Value};

/// Reads a cell off a location.
type ReadCell = fn(&LocationRow) -> Value<'_>;

/// The columns: the properties of a location that are no lists, its centre and its approach spread out. Their order is
/// what importers rely on: new columns come last.
const COLUMNS: [(&str, ReadCell); 17] = [
    ("code", |location| location.code.as_str().into()),
    ("label", |location| location.label.id.as_str().into()),
    ("labelName", |location| location.label.name.as_str().into()),
    ("aisle", |location| location.aisle.into()),
    ("bay", |location| location.bay.into()),
    ("side", |location| location.side.into()),
    ("x", |location| location.centre[0].into()),
    ("y", |location| location.centre[1].into()),
    ("widthM", |location| location.width.into()),
    ("depthM", |location| location.depth.into()),
    ("headingDeg", |location| location.heading.into()),
    ("occupancy", |location| location.occupancy.into()),
    ("accessFrom", |location| location.access_from.into()),
    ("approachX", |location| location.approach.map(|pose| pose.x).into()),
    ("approachY", |location| location.approach.map(|pose| pose.y).into()),
    ("approachHeadingDeg", |location| location.approach.map(|pose| pose.heading_deg).into()),
    ("face", |location| location.face.into()),
];

/// Storage locations as CSV (RFC 4180), a row each; positions are map-frame metres. Features of other collections have
/// no row.
///
/// Text that a spreadsheet would run as a formula is preceded by an apostrophe.
#[must_use]
#[allow(clippy::missing_panics_doc, reason = "memory takes every byte")]
pub fn locations<'a>(features: impl IntoIterator<Item = &'a Feature>) -> Vec<u8> {
    let mut writer = csv::WriterBuilder::new().terminator(csv::Terminator::CRLF).from_writer(Vec::new());
    let mut write =
        |record: &[String]| writer.write_record(record).expect("rows of equal length always fit into memory");
    write(&COLUMNS.map(|(name, _)| name.to_owned()));
    for feature in features {
        if let Row::Location(location) = &feature.row {
            write(&COLUMNS.map(|(_, value)| cell(value(location))));
        }
    }
    writer.into_inner().expect("a buffer in memory takes every byte")
}

fn cell(value: Value<'_>) -> String {
    match value {
        Value::Null => String::new(),
        Value::Text(text) => harmless(text),
        other => serde_json::to_string(&other).expect("a number is JSON"),
    }
}

/// Text that no spreadsheet takes for a formula (OWASP, CSV injection).
fn harmless(text: &str) -> String {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r']) { format!("'{text}") } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_defused_and_numbers_are_not() {
        let cases = [
            (Value::Text("=1+1"), "'=1+1"),
            (Value::Text("+1"), "'+1"),
            (Value::Text("-1"), "'-1"),
            (Value::Text("@SUM(A1)"), "'@SUM(A1)"),
            (Value::Text("\t=1"), "'\t=1"),
            (Value::Text("\r=1"), "'\r=1"),
            (Value::Text("01-002"), "01-002"),
            ((-1.5).into(), "-1.5"),
            (Value::Null, ""),
        ];
        for (value, text) in cases {
            assert_eq!(cell(value), text);
        }
    }
}
