//! CQL2, the filter language of OGC API (OGC 21-065r2): read as text or JSON, checked, and evaluated.
//!
//! | file | what it has |
//! | --- | --- |
//! | `text`, `json` | the two encodings; both give the same expression |
//! | `expression`, `operator`, `instant`, `shape` | what a filter says |
//! | `binding` | names become places in a list, types are checked, shapes move into the coordinates of the data |
//! | `evaluation` | whether a condition holds for one thing |
//! | `filter`, `value` | the filter, and what it reads of the things it selects |
//! | `limits`, `error` | how much a filter may ask for, and what is wrong with it |
//!
//! All classes of the standard are here: comparisons, LIKE, BETWEEN and IN, CASEI, ACCENTI, all spatial, temporal and
//! array functions, arithmetic, and properties on both sides. It has no functions of its own.
//!
//! Pure: nothing here knows HTTP or the features of a map.

mod binding;
mod error;
mod evaluation;
mod expression;
mod filter;
mod instant;
mod json;
mod limits;
mod operator;
mod shape;
mod text;
mod value;

#[cfg(test)]
mod tests;

pub use binding::FilterCoordinates;
pub use error::FilterError;
pub use expression::Expression;
pub use filter::Filter;
pub use instant::{Instant, IntervalEnd, Period};
pub use json::read as read_json;
pub use operator::{Arithmetic, ArrayRelation, Comparison, Operator, SpatialRelation, TemporalRelation};
pub use text::read as read_text;
pub use value::{FilterValue, Filterable, Located, Queryable, ValueType};
