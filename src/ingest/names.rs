//! Names and codes that people bring along: a table of points (CSV), or labelled polygons (GeoJSON).
//!
//! The table has a header; columns are separated by `,` or `;` (then numbers may have a decimal comma). It has `x` and `y`
//! and one or more of `code`, `name` and `groups` (separated by `|`); the other columns of the table of locations that
//! this service writes may stay in it. Empty cells say nothing. Rows count as spreadsheets count them: the header is row 1.
//!
//! A polygon has the properties `code`, `name` or `groups`, and `collection` (`locations` when absent); others are left out.

use serde_json::Value;
use stillage_core::Point;
use stillage_core::geometry::ring_area;
use stillage_core::layout::check_code;
use stillage_core::registry::{AreaRings, checked_groups, checked_name};

use super::IngestError;
use super::geojson::{Coordinates, area, features};

/// Columns that say something.
const READ: [&str; 5] = ["x", "y", "code", "name", "groups"];

/// A name with the ground it is for.
#[derive(Debug, Clone, PartialEq)]
pub struct NameRow {
    /// JSON pointer: `/rows/7` or `/features/3`.
    pub pointer: String,
    /// The ground.
    pub target: NameTarget,
    /// The code.
    pub code: Option<String>,
    /// The name.
    pub name: Option<String>,
    /// The groups.
    pub groups: Option<Vec<String>>,
}

/// What a name is for. Map frame, metres.
#[derive(Debug, Clone, PartialEq)]
pub enum NameTarget {
    /// The location that holds this point.
    Point(Point),
    /// What this area covers best.
    Area {
        /// Of which collection.
        collection: NamedCollection,
        /// Outlines and holes.
        rings: AreaRings,
    },
}

/// A collection whose features can have names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NamedCollection {
    /// Locations.
    Locations,
    /// Places.
    Places,
    /// Aisles.
    Aisles,
    /// Rows.
    Rows,
}

impl NameRow {
    /// What the row is called when people are told about it: `row 7`, `feature 3`.
    #[must_use]
    pub fn words(&self) -> String {
        self.pointer.trim_start_matches('/').replacen("s/", " ", 1)
    }

    /// A problem with one part of the row.
    fn problem(&self, part: &str, detail: &str) -> IngestError {
        let slash = if part.is_empty() { "" } else { "/" };
        IngestError::invalid(format!("{}{slash}{part}", self.pointer), format!("{}: {detail}", self.words()))
    }

    fn take_code(&mut self, code: &str) -> Result<(), IngestError> {
        check_code(code).map_err(|problem| self.problem("code", &problem.to_string()))?;
        self.code = Some(code.to_owned());
        Ok(())
    }

    fn take_name(&mut self, name: &str) -> Result<(), IngestError> {
        let checked = checked_name(name);
        self.name = Some(checked.map_err(|detail| self.problem("name", &format!("the name {detail}")))?);
        Ok(())
    }

    fn take_groups<'a>(&mut self, groups: impl Iterator<Item = &'a str>) -> Result<(), IngestError> {
        let checked = checked_groups(groups);
        self.groups = Some(checked.map_err(|detail| self.problem("groups", &format!("the groups {detail}")))?);
        Ok(())
    }
}

/// Reads a table of points. `to_map` leads from the coordinates of the table to the map frame; `also` are the columns that
/// may stay in it.
///
/// # Errors
/// Everything that is wrong, with the number of its row.
pub fn name_table(bytes: &[u8], also: &[&str], to_map: Coordinates<'_>) -> Result<Vec<NameRow>, Vec<IngestError>> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let header = bytes.split(|&byte| byte == b'\n').next().unwrap_or_default();
    let separator = if header.contains(&b';') { b';' } else { b',' };
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(bytes);
    let unreadable = |error: &csv::Error| vec![IngestError::invalid("", format!("the table cannot be read: {error}"))];
    let mut lines = Lines { bytes, at: 0, line: 1 };
    let mut records = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| unreadable(&error))?;
        let start = record.position().map_or(0, csv::Position::byte);
        records.push((lines.line_at(start as usize), record));
    }
    let Some(((_, header), rows)) = records.split_first() else {
        return Err(vec![IngestError::invalid(
            "",
            "the table is empty: its first row names the columns x, y and code",
        )]);
    };
    let columns = columns(header, also)?;
    let reader = TableReader { columns, decimal_comma: separator == b';', to_map };
    gather(
        rows.iter()
            .filter(|(_, row)| row.iter().any(|cell| !cell.is_empty()))
            .map(|(line, row)| reader.row(*line, row)),
    )
}

/// Counts the lines of a table. (The reader's own count is behind where lines end with two characters or are empty.)
struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u64,
}

impl Lines<'_> {
    /// The line of the record that is read from a byte on, which is not before that of the last call.
    fn line_at(&mut self, start: usize) -> u64 {
        let is_end = |byte: u8| byte == b'\n' || byte == b'\r';
        while let Some(&byte) = self.bytes.get(self.at).filter(|&&byte| self.at < start || is_end(byte)) {
            let is_half = byte == b'\r' && self.bytes.get(self.at + 1) == Some(&b'\n');
            self.line += u64::from(is_end(byte) && !is_half);
            self.at += 1;
        }
        self.line
    }
}

/// Names in a table, in their order.
fn columns(header: &csv::StringRecord, also: &[&str]) -> Result<Vec<String>, Vec<IngestError>> {
    let names: Vec<String> = header.iter().map(str::to_ascii_lowercase).collect();
    let wrong = |detail: String| Err(vec![IngestError::invalid("/rows/1", format!("row 1: {detail}"))]);
    let is_known =
        |name: &String| READ.contains(&name.as_str()) || also.iter().any(|known| known.eq_ignore_ascii_case(name));
    if let Some(unknown) = names.iter().find(|name| !is_known(name)) {
        return wrong(format!(
            "there is no column {unknown:?}: the first row names x, y and code, and perhaps name, groups"
        ));
    }
    if let Some(missing) = ["x", "y"].into_iter().find(|wanted| !names.iter().any(|name| name == wanted)) {
        return wrong(format!("the column {missing} is missing: the first row names x, y and code"));
    }
    if !names.iter().any(|name| READ[2..].contains(&name.as_str())) {
        return wrong("there is no column code, name or groups: nothing would be named".to_owned());
    }
    if let Some(twice) = READ.into_iter().find(|wanted| names.iter().filter(|name| name == wanted).count() > 1) {
        return wrong(format!("the column {twice} is there twice"));
    }
    Ok(names)
}

struct TableReader<'a> {
    columns: Vec<String>,
    decimal_comma: bool,
    to_map: Coordinates<'a>,
}

impl TableReader<'_> {
    fn row(&self, line: u64, record: &csv::StringRecord) -> Result<NameRow, IngestError> {
        let pointer = format!("/rows/{line}");
        let target = NameTarget::Point(Point::origin());
        let mut row = NameRow { pointer, target, code: None, name: None, groups: None };
        if record.len() > self.columns.len() {
            let detail = format!("{} cells for {} columns", record.len(), self.columns.len());
            return Err(row.problem("", &detail));
        }
        let cell = |name: &str| {
            let index = self.columns.iter().position(|column| column == name)?;
            record.get(index).filter(|cell| !cell.is_empty())
        };
        let number = |name: &str| {
            let text = cell(name).unwrap_or_default();
            let plain = if self.decimal_comma { text.replace(',', ".") } else { text.to_owned() };
            let number = plain.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or_else(|| row.problem(name, &format!("{text:?} is no number")))
        };
        let position = [number("x")?, number("y")?];
        row.target = NameTarget::Point((self.to_map)(position));
        if let Some(code) = cell("code") {
            row.take_code(plain_text(code))?;
        }
        if let Some(name) = cell("name") {
            row.take_name(plain_text(name))?;
        }
        if let Some(groups) = cell("groups") {
            row.take_groups(plain_text(groups).split('|').filter(|group| !group.trim().is_empty()))?;
        }
        Ok(row)
    }
}

/// A text without the apostrophe that keeps spreadsheets from taking it for a formula.
fn plain_text(cell: &str) -> &str {
    cell.strip_prefix('\'').filter(|rest| rest.starts_with(['=', '+', '-', '@'])).unwrap_or(cell)
}

/// Reads labelled polygons. `to_map` leads from their coordinates to the map frame.
///
/// # Errors
/// Everything that is wrong, by its JSON pointer.
pub fn name_areas(document: &Value, to_map: Coordinates<'_>) -> Result<Vec<NameRow>, Vec<IngestError>> {
    let features = features(document).map_err(|error| vec![error])?;
    gather(
        features.iter().enumerate().map(|(index, feature)| named_area(feature, &format!("/features/{index}"), to_map)),
    )
}

fn named_area(feature: &Value, pointer: &str, to_map: Coordinates<'_>) -> Result<NameRow, IngestError> {
    let properties = &feature["properties"];
    let text = |name: &str| match &properties[name] {
        Value::Null => Ok(None),
        Value::String(text) => Ok(Some(text.as_str())),
        _ => Err(IngestError::invalid(format!("{pointer}/properties/{name}"), "must be a text")),
    };
    let collection = match text("collection")? {
        None | Some("locations") => NamedCollection::Locations,
        Some("places") => NamedCollection::Places,
        Some("aisles") => NamedCollection::Aisles,
        Some("rows") => NamedCollection::Rows,
        Some(other) => {
            let detail = format!("{other:?} has no names: locations, places, aisles and rows have");
            return Err(IngestError::invalid(format!("{pointer}/properties/collection"), detail));
        }
    };
    let rings = area(feature, pointer, to_map)?.into_iter().flat_map(oriented).collect();
    let target = NameTarget::Area { collection, rings };
    let mut row = NameRow { pointer: pointer.to_owned(), target, code: None, name: None, groups: None };
    if let Some(code) = text("code")? {
        if collection != NamedCollection::Locations {
            return Err(row.problem("properties/code", "only locations have a code: give it a name"));
        }
        row.take_code(code)?;
    }
    if let Some(name) = text("name")? {
        row.take_name(name)?;
    }
    if let Some(groups) = properties["groups"].as_array() {
        row.take_groups(groups.iter().map(|group| group.as_str().unwrap_or_default()))?;
    }
    if row.code.is_none() && row.name.is_none() && row.groups.is_none() {
        return Err(row.problem("properties", "has no code, name or groups"));
    }
    Ok(row)
}

/// The outline of a polygon counter-clockwise, its holes clockwise.
fn oriented(polygon: Vec<Vec<Point>>) -> impl Iterator<Item = Vec<Point>> {
    polygon.into_iter().enumerate().map(|(index, mut ring)| {
        if (ring_area(&ring) > 0.0) != (index == 0) {
            ring.reverse();
        }
        ring
    })
}

/// All rows, or all that is wrong.
fn gather(rows: impl Iterator<Item = Result<NameRow, IngestError>>) -> Result<Vec<NameRow>, Vec<IngestError>> {
    let (mut good, mut wrong) = (Vec::new(), Vec::new());
    for row in rows {
        match row {
            Ok(row) => good.push(row),
            Err(error) => wrong.push(error),
        }
    }
    if good.is_empty() && wrong.is_empty() {
        wrong.push(IngestError::invalid("", "there is nothing in it to name"));
    }
    if wrong.is_empty() { Ok(good) } else { Err(wrong) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn table(text: &str) -> Result<Vec<NameRow>, Vec<String>> {
        let rows = name_table(text.as_bytes(), &["widthM"], &Point::from);
        rows.map_err(|errors| errors.into_iter().map(|error| format!("{} {}", error.pointer, error.message)).collect())
    }

    #[test]
    fn tables_come_as_spreadsheets_write_them() {
        let plain = table("x,y,code,name,groups,widthM\n1.5,-2,A-1,\"Gate, left\",fast|cold,0.9\n\n3,4,,'=1,,\n")
            .expect("is a table");
        assert_eq!(plain[0].target, NameTarget::Point(Point::new(1.5, -2.0)));
        assert_eq!((plain[0].code.as_deref(), plain[0].name.as_deref()), (Some("A-1"), Some("Gate, left")));
        assert_eq!(plain[0].groups.as_deref(), Some(["fast".to_owned(), "cold".to_owned()].as_slice()));
        assert_eq!((plain[1].words().as_str(), plain[1].name.as_deref()), ("row 4", Some("=1")));
        let german = table("\u{feff}Code;X;Y\r\nA-1;1,5;-2\r\n").expect("is a table");
        assert_eq!(german[0].target, plain[0].target);
    }

    #[test]
    fn everything_wrong_is_told_by_its_row() {
        let wrong = |text: &str| table(text).expect_err("is wrong").join("\n");
        assert_eq!(
            wrong("x,y,code\n1,y,A\n1,2,1234567890123456789\n1,2,B,C\n"),
            "/rows/2/y row 2: \"y\" is no number\n\
             /rows/3/code row 3: a code has 1 to 18 characters, this one has 19\n\
             /rows/4 row 4: 4 cells for 3 columns"
        );
        assert!(wrong("").contains("is empty"));
        assert!(wrong("x,y\n1,2").contains("nothing would be named"));
        assert!(wrong("x,code\n1,A").contains("the column y is missing"));
        assert!(wrong("x,y,kode\n1,2,A").contains("no column \"kode\""));
        assert!(wrong("x,y,code\n").contains("nothing in it"));
    }

    #[test]
    fn polygons_carry_their_labels() {
        let feature = |properties: Value| {
            json!({"type": "Feature", "properties": properties,
                "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]]}})
        };
        let read = |properties: Value| {
            name_areas(&json!({"type": "FeatureCollection", "features": [feature(properties)]}), &Point::from)
        };
        let rows = read(json!({"name": "Cold store", "collection": "places", "fill": "#123456"})).expect("is right");
        let NameTarget::Area { collection, rings } = &rows[0].target else { panic!("it is an area") };
        assert_eq!((*collection, rings[0].len()), (NamedCollection::Places, 4));
        let pointer = |properties: Value| read(properties).expect_err("is wrong")[0].pointer.clone();
        assert_eq!(pointer(json!({"code": "A", "collection": "places"})), "/features/0/properties/code");
        assert_eq!(pointer(json!({"code": "A", "collection": "faces"})), "/features/0/properties/collection");
        assert_eq!(pointer(json!({"fill": "red"})), "/features/0/properties");
    }
}
