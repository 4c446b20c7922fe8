//! Features as tables for spreadsheets and inventory systems.

use super::wkt;
use crate::coordinates::Transform;
use crate::features::query::PropertySelection;
use crate::features::rows::locations::LocationRow;
use crate::features::{Feature, Row, Value};

/// Reads a cell off a location.
pub(crate) type ReadCell = fn(&LocationRow) -> Value<'_>;

/// The columns: the properties of a location that are no lists of ids, its centre and its approach spread out. Their order is
/// what importers rely on: new columns come last.
pub(crate) const COLUMNS: [(&str, ReadCell); 20] = [
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
    ("name", |location| location.naming.name.as_deref().into()),
    ("groups", |location| location.naming.groups.as_slice().into()),
    ("stale", |location| location.stale.into()),
];

/// Storage locations as CSV, a row each; positions are map-frame metres. Features of other collections have no row.
#[must_use]
pub fn locations<'a>(features: impl IntoIterator<Item = &'a Feature>) -> Vec<u8> {
    let rows = features.into_iter().filter_map(|feature| match &feature.row {
        Row::Location(location) => Some(COLUMNS.map(|(_, read)| read(location))),
        _ => None,
    });
    table(&COLUMNS.map(|(name, _)| name), rows)
}

/// Features as CSV, a row each: these properties, lists and poses as JSON, then the shape as well-known text in the
/// coordinates of the transform.
#[must_use]
pub fn collection<'a>(
    properties: &PropertySelection,
    features: impl IntoIterator<Item = &'a Feature>,
    transform: &Transform,
) -> Vec<u8> {
    let names: Vec<&str> = properties.properties().map(|property| property.name).chain(["geometry"]).collect();
    records(
        &names,
        features.into_iter().map(|feature| {
            let values = properties.values(feature).map(|(_, value)| cell(value));
            values.chain([wkt::geometry(&feature.geometry, transform)]).collect::<Vec<_>>()
        }),
    )
}

/// A table as CSV (RFC 4180); each row has a value for each name.
///
/// Text that a spreadsheet would run as a formula is preceded by an apostrophe.
pub(crate) fn table<'a, R: AsRef<[Value<'a>]>>(names: &[&str], rows: impl IntoIterator<Item = R>) -> Vec<u8> {
    records(names, rows.into_iter().map(|row| row.as_ref().iter().map(|&value| cell(value)).collect::<Vec<_>>()))
}

fn records(names: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> Vec<u8> {
    const FITS: &str = "rows of equal length always fit into memory";
    let mut writer = csv::WriterBuilder::new().terminator(csv::Terminator::CRLF).from_writer(Vec::new());
    writer.write_record(names).expect(FITS);
    for row in rows {
        writer.write_record(row).expect(FITS);
    }
    writer.into_inner().expect("a buffer in memory takes every byte")
}

fn cell(value: Value<'_>) -> String {
    match value {
        Value::Null => String::new(),
        Value::Text(text) => harmless(text),
        Value::Texts(texts) => harmless(&texts.join("|")),
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
