//! A table of points (CSV).
//!
//! It has a header; columns are separated by `,` or `;` (then numbers may have a decimal comma). It has `x` and `y`
//! and one or more of `code`, `name` and `groups` (separated by `|`); the other columns of the table of locations that
//! this service writes may stay in it. Empty cells say nothing. Rows count as spreadsheets count them: the header is row 1.

use stillage_core::Point;
use stillage_core::excerpt;

use super::row::{NameRow, NameTarget, gather};
use crate::ingest::IngestError;
use crate::ingest::geojson::Coordinates;

/// Columns that say something.
const READ: [&str; 5] = ["x", "y", "code", "name", "groups"];

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
    let mut lines = Lines { bytes, at: 0, line: 1 };
    let mut records = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| vec![unreadable(&error, &mut lines)])?;
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

/// A row with bytes that are no text: the only thing that the reader does not take.
fn unreadable(error: &csv::Error, lines: &mut Lines<'_>) -> IngestError {
    let line = lines.line_at(error.position().map_or(0, |start| start.byte() as usize));
    let detail = format!("row {line}: is not UTF-8: save the table as \"CSV UTF-8\"");
    IngestError::invalid(format!("/rows/{line}"), detail)
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
            "there is no column {:?}: the first row names x, y and code, and perhaps name, groups",
            excerpt(unknown)
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
            number.ok_or_else(|| row.problem(name, &format!("{:?} is no number", excerpt(text))))
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

#[cfg(test)]
mod tests {
    use super::*;

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
    fn a_table_in_another_encoding_is_refused_by_its_row() {
        let errors =
            name_table(b"x,y,name\r\n1,2,Hall\r\n\r\n3,4,B\xfcro\r\n", &[], &Point::from).expect_err("is wrong");
        let words = "row 4: is not UTF-8: save the table as \"CSV UTF-8\"";
        assert_eq!(errors, [IngestError::invalid("/rows/4", words)]);
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
        let long = wrong(&format!("x,y,{}\n{0},2,A", "code".repeat(5_000)));
        assert!(long.len() < 200, "{long}");
    }
}
