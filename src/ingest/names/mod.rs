//! Names and codes that people bring along: a table of points (CSV), or labelled polygons (GeoJSON).

mod areas;
mod row;
mod table;

pub use areas::name_areas;
pub use row::{NameRow, NameTarget, NamedCollection};
pub use table::name_table;
