//! The order of features by their properties.

use std::cmp::Ordering;

use crate::features::feature::Feature;
use crate::features::schema::CollectionSchema;

/// A property to sort by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SortKey {
    /// Its index in the schema.
    property: usize,
    is_descending: bool,
}

impl SortKey {
    /// Reads a property with its direction, as `sortby` has it (OGC 20-004r1): `areaM2` or `+areaM2` ascending,
    /// `-areaM2` descending.
    ///
    /// # Errors
    /// When the collection has no such property, or its values have no order.
    pub fn read(text: &str, schema: &CollectionSchema) -> Result<Self, String> {
        let (is_descending, name) = match text.strip_prefix('-') {
            Some(name) => (true, name),
            // A plus sign that was not encoded arrives as a space.
            None => (false, text.strip_prefix(['+', ' ']).unwrap_or(text)),
        };
        let property = schema.find(name).filter(|&index| schema.properties[index].kind.is_scalar());
        let property = property.ok_or_else(|| {
            let sortable = schema.properties.iter().filter(|property| property.kind.is_scalar());
            let names: Vec<&str> = sortable.map(|property| property.name).collect();
            format!("{name:?} is none of the properties that can be sorted by: {}", names.join(", "))
        })?;
        Ok(Self { property, is_descending })
    }
}

/// The order of two features: by the first key in which they differ, then by id. Features without a value come last in
/// both directions.
pub(super) fn compare(keys: &[SortKey], first: &Feature, second: &Feature) -> Ordering {
    let by_key = |key: &SortKey| {
        let (one, other) = (first.row.value(key.property), second.row.value(key.property));
        let order = one.compare(&other);
        let both = !one.is_null() && !other.is_null();
        if key.is_descending && both { order.reverse() } else { order }
    };
    let different = keys.iter().map(by_key).find(|order| order.is_ne());
    different.unwrap_or_else(|| first.id.cmp(&second.id))
}
