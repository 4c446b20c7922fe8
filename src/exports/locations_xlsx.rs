//! Storage locations as a spreadsheet.
//!
//! Source: ECMA-376 (Office Open XML), through the crate `rust_xlsxwriter`. Method: the columns of the generic CSV
//! profile, numbers as numbers, texts as texts, never as formulas; the head stays in sight and filters. The time of the
//! file is that of the version, so that the same version gives the same bytes. Limits: 1,048,575 locations.

use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, Worksheet, XlsxError};

use super::location_sheet::{ALL, InventoryOptions, LocationLine, lines};
use super::source::{ExportError, ExportSource};
use crate::features::Value;

/// Rows of a sheet of Excel without the head.
const MOST_ROWS: usize = 1_048_575;

/// The locations of a map as a workbook with one sheet.
///
/// # Errors
/// [`ExportError::TooManyRows`] when they do not fit a sheet.
#[allow(clippy::missing_panics_doc, reason = "a small sheet of short texts is always valid")]
pub fn locations(source: &ExportSource<'_>) -> Result<Vec<u8>, ExportError> {
    let rows = source.layout.locations.len();
    if rows > MOST_ROWS {
        return Err(ExportError::TooManyRows { rows, most: MOST_ROWS });
    }
    let options = InventoryOptions::default();
    Ok(write(source, &lines(source, &options)).expect("rows and texts are within the limits of a sheet"))
}

fn write(source: &ExportSource<'_>, lines: &[LocationLine<'_>]) -> Result<Vec<u8>, XlsxError> {
    let mut workbook = Workbook::new();
    let created = ExcelDateTime::from_timestamp(source.created.as_second())?;
    workbook.set_properties(&DocProperties::new().set_title(source.name).set_creation_datetime(&created));
    let sheet = workbook.add_worksheet().set_name("Locations")?;
    let bold = Format::new().set_bold();
    for (column, (name, read)) in (0_u16..).zip(ALL) {
        sheet.write_string_with_format(0, column, *name, &bold)?;
        for (row, line) in (1..).zip(lines) {
            cell(sheet, row, column, read(line))?;
        }
    }
    sheet.set_freeze_panes(1, 0)?;
    sheet.autofilter(0, 0, lines.len() as u32, ALL.len() as u16 - 1)?;
    workbook.save_to_buffer()
}

fn cell(sheet: &mut Worksheet, row: u32, column: u16, value: Value<'_>) -> Result<(), XlsxError> {
    match value {
        Value::Text(text) => sheet.write_string(row, column, text)?,
        Value::Integer(number) => sheet.write_number(row, column, number as f64)?,
        Value::Number(number) => sheet.write_number(row, column, number)?,
        _ => return Ok(()),
    };
    Ok(())
}
