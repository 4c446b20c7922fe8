//! The storage locations as a table for spreadsheets and inventory systems.

use serde_json::{Map, Value};

use super::MapView;
use super::semantics::location_properties;

/// The columns: the properties of a location, its centre and approach pose spread out.
const COLUMNS: [&str; 17] = [
    "code",
    "label",
    "labelName",
    "aisle",
    "bay",
    "side",
    "x",
    "y",
    "widthM",
    "depthM",
    "headingDeg",
    "occupancy",
    "accessFrom",
    "approachX",
    "approachY",
    "approachHeadingDeg",
    "face",
];

/// The storage locations as CSV (RFC 4180), a row each by code; positions are map-frame metres.
///
/// Text that a spreadsheet would run as a formula is preceded by an apostrophe.
#[must_use]
#[allow(clippy::missing_panics_doc, reason = "memory takes every byte")]
pub fn locations_csv(view: &MapView<'_>) -> Vec<u8> {
    let mut writer = csv::WriterBuilder::new().terminator(csv::Terminator::CRLF).from_writer(Vec::new());
    let mut write =
        |record: &[String]| writer.write_record(record).expect("rows of equal length always fit into memory");
    write(&COLUMNS.map(str::to_owned));
    for location in view.locations {
        let properties = location_properties(view, location);
        write(&COLUMNS.map(|column| cell(value(&properties, column))));
    }
    writer.into_inner().expect("a buffer in memory takes every byte")
}

/// The value of a column.
fn value<'a>(properties: &'a Map<String, Value>, column: &str) -> &'a Value {
    match column {
        "x" => &properties["centre"][0],
        "y" => &properties["centre"][1],
        "approachX" => &properties["approach"]["x"],
        "approachY" => &properties["approach"]["y"],
        "approachHeadingDeg" => &properties["approach"]["headingDeg"],
        other => &properties[other],
    }
}

fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => harmless(text),
        other => other.to_string(),
    }
}

/// Text that no spreadsheet takes for a formula (OWASP, CSV injection).
fn harmless(text: &str) -> String {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r']) { format!("'{text}") } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn formulas_are_defused_and_numbers_are_not() {
        let cases = [
            (json!("=1+1"), "'=1+1"),
            (json!("+1"), "'+1"),
            (json!("-1"), "'-1"),
            (json!("@SUM(A1)"), "'@SUM(A1)"),
            (json!("\t=1"), "'\t=1"),
            (json!("\r=1"), "'\r=1"),
            (json!("01-002"), "01-002"),
            (json!(-1.5), "-1.5"),
            (Value::Null, ""),
        ];
        for (value, text) in cases {
            assert_eq!(cell(&value), text);
        }
    }
}
