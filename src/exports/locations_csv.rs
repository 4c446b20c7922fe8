//! Storage locations as CSV for inventory systems.
//!
//! | profile | for | source of its columns |
//! | --- | --- | --- |
//! | generic | spreadsheets and own programs | the properties of a location |
//! | odoo | Odoo, import of `stock.location` | `addons/stock/models/stock_location.py`, github.com/odoo/odoo |
//! | sap-ewm | SAP EWM, transaction /SCWM/SBUP | fields of table /SCWM/LAGP |
//! | business-central | Microsoft Dynamics 365 Business Central, table Bin (7354) | its captions |
//!
//! Method: CSV after RFC 4180, a row for each location; text that a spreadsheet would run as a formula is preceded by
//! an apostrophe. Coordinates are metres of the map frame; SAP EWM computes distances from them, Odoo takes whole
//! numbers for corridor, shelf and height. Limits: a map is flat, so every location lies on level 0; codes of up to 18
//! characters fit all of these systems.

use super::location_sheet::{ALL, InventoryOptions, SheetColumn, lines};
use super::source::ExportSource;
use crate::formats::csv;

/// The inventory system that a table is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Profile {
    /// All that is known of a location.
    #[default]
    Generic,
    /// Odoo.
    Odoo,
    /// SAP Extended Warehouse Management.
    SapEwm,
    /// Microsoft Dynamics 365 Business Central.
    BusinessCentral,
}

/// Level of every location: goods on the floor.
const FLOOR: u32 = 0;

const ODOO: &[SheetColumn] = &[
    ("name", |line| line.location.code.as_str().into()),
    ("location_id", |line| line.options.warehouse.as_str().into()),
    ("usage", |_| "internal".into()),
    ("barcode", |line| line.location.code.as_str().into()),
    ("posx", |line| line.location.aisle.into()),
    ("posy", |line| line.location.bay.into()),
    ("posz", |_| FLOOR.into()),
];

const SAP_EWM: &[SheetColumn] = &[
    ("LGNUM", |line| line.options.warehouse.as_str().into()),
    ("LGTYP", |line| line.options.storage_type.as_str().into()),
    ("LGPLA", |line| line.location.code.as_str().into()),
    ("AISLE", |line| line.location.aisle.into()),
    ("STACK", |line| line.location.bay.into()),
    ("LVL_V", |_| FLOOR.into()),
    ("X_CORD", |line| line.center[0].into()),
    ("Y_CORD", |line| line.center[1].into()),
    ("Z_CORD", |_| FLOOR.into()),
    ("DEPTH", |line| line.location.depth_in_row.into()),
];

const BUSINESS_CENTRAL: &[SheetColumn] = &[
    ("Location Code", |line| line.options.warehouse.as_str().into()),
    ("Code", |line| line.location.code.as_str().into()),
    ("Description", |line| line.label.into()),
    ("Zone Code", |line| line.options.storage_type.as_str().into()),
];

impl Profile {
    /// All profiles.
    pub const ALL: [Self; 4] = [Self::Generic, Self::Odoo, Self::SapEwm, Self::BusinessCentral];

    /// Its name in requests and files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Generic => "generic",
            Self::Odoo => "odoo",
            Self::SapEwm => "sap-ewm",
            Self::BusinessCentral => "business-central",
        }
    }

    /// Most characters that the system takes for a name of a warehouse, of a storage type or of a zone.
    pub(super) const fn longest_name(self) -> usize {
        match self {
            Self::Generic | Self::Odoo => 64,
            Self::SapEwm => 4,
            Self::BusinessCentral => 10,
        }
    }

    const fn columns(self) -> &'static [SheetColumn] {
        match self {
            Self::Generic => ALL,
            Self::Odoo => ODOO,
            Self::SapEwm => SAP_EWM,
            Self::BusinessCentral => BUSINESS_CENTRAL,
        }
    }
}

/// The locations of a map for an inventory system.
#[must_use]
pub fn locations(source: &ExportSource<'_>, profile: Profile, options: &InventoryOptions) -> Vec<u8> {
    let columns = profile.columns();
    let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    let lines = lines(source, options);
    csv::table(&names, lines.iter().map(|line| columns.iter().map(|(_, read)| read(line)).collect::<Vec<_>>()))
}
