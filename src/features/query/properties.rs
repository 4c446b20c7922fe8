//! Which properties of features are written.

use crate::did_you_mean::did_you_mean;
use crate::features::collection::Collection;
use crate::features::feature::Feature;
use crate::features::property::Property;
use crate::features::schema::CollectionSchema;
use crate::features::value::Value;

/// Some properties of a collection, or all, in the order of its schema.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PropertySelection {
    collection: Collection,
    /// Their indices in the schema, ascending.
    indices: Vec<usize>,
    are_named: bool,
}

impl PropertySelection {
    /// All properties.
    #[must_use]
    pub fn all(collection: Collection) -> Self {
        let indices = (0..CollectionSchema::of(collection).properties.len()).collect();
        Self { collection, indices, are_named: false }
    }

    /// The properties of a list of names: `label,areaM2`. Their order and repetitions say nothing.
    ///
    /// # Errors
    /// When the collection has no such property.
    pub fn read(list: &str, collection: Collection) -> Result<Self, String> {
        let schema = CollectionSchema::of(collection);
        let index = |name: &str| schema.find(name).ok_or_else(|| unknown(name, collection));
        let mut indices = list.split(',').map(index).collect::<Result<Vec<_>, _>>()?;
        indices.sort_unstable();
        indices.dedup();
        Ok(Self { collection, indices, are_named: true })
    }

    /// The collection that has them.
    #[must_use]
    pub const fn collection(&self) -> Collection {
        self.collection
    }

    /// Whether they were selected by name.
    #[must_use]
    pub const fn are_named(&self) -> bool {
        self.are_named
    }

    /// The properties.
    #[must_use]
    pub fn properties(&self) -> impl ExactSizeIterator<Item = &'static Property> {
        self.indices.iter().map(|&index| &CollectionSchema::of(self.collection).properties[index])
    }

    /// The properties, each with its value of a feature of the collection.
    pub fn values<'a>(&self, feature: &'a Feature) -> impl Iterator<Item = (&'static Property, Value<'a>)> {
        self.properties().zip(&self.indices).map(|(property, &index)| (property, feature.row.value(index)))
    }
}

fn unknown(name: &str, collection: Collection) -> String {
    /// Longest name that is repeated in a refusal, characters.
    const REPEATED: usize = 40;
    let names = CollectionSchema::of(collection).properties.iter().map(|property| property.name);
    let meant = did_you_mean(name, names).map(|names| format!(": did you mean {names}?")).unwrap_or_default();
    let name: String = name.chars().take(REPEATED).collect();
    format!("{name:?} is not a property of {}{meant}", collection.id())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(list: &str) -> Vec<&'static str> {
        let selection = PropertySelection::read(list, Collection::Faces).expect("are properties");
        selection.properties().map(|property| property.name).collect()
    }

    #[test]
    fn properties_come_in_the_order_of_the_schema() {
        assert_eq!(names("areaM2,label,id,label"), ["id", "label", "areaM2"]);
        let all = PropertySelection::all(Collection::Faces);
        assert_eq!(all.properties().len(), CollectionSchema::of(Collection::Faces).properties.len());
        assert!(!all.are_named() && PropertySelection::read("label", Collection::Faces).expect("is one").are_named());
    }

    #[test]
    fn an_unknown_name_is_told_with_those_near_to_it() {
        let refused = |list: &str| PropertySelection::read(list, Collection::Vertices).unwrap_err();
        assert_eq!(refused("id,edge"), "\"edge\" is not a property of vertices: did you mean edges or id?");
        for empty in ["", "id,", ",id"] {
            assert!(refused(empty).starts_with("\"\" is not a property"), "{empty}");
        }
        assert!(refused(&"x".repeat(1_000)).len() < 120);
    }
}
