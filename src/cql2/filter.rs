//! A filter that is ready to select.

use super::binding::{Binder, FilterCoordinates};
use super::error::FilterError;
use super::evaluation::condition::Condition;
use super::expression::Expression;
use super::value::{Filterable, Queryable};

/// A condition that things are selected by.
#[derive(Debug, Clone)]
pub struct Filter(Condition);

impl Filter {
    /// Binds an expression to the properties of the things it will be asked of. O(length), and O(n²) of the positions of
    /// each ring.
    ///
    /// # Errors
    /// A name that is none of the queryables, a value of the wrong type, a function that is not known, an invalid
    /// geometry, or more geometries than the limits.
    pub fn new(
        expression: &Expression,
        queryables: &[Queryable<'_>],
        coordinates: FilterCoordinates<'_>,
    ) -> Result<Self, FilterError> {
        Binder::new(queryables, coordinates).condition(expression).map(Self)
    }

    /// Whether a thing is selected: the condition is true, not merely unknown.
    #[must_use]
    pub fn selects(&self, thing: &dyn Filterable) -> bool {
        self.0.holds(thing) == Some(true)
    }
}
