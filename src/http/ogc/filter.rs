//! Filters of a request: CQL2, and a parameter for each property (OGC API Features part 3).

use std::collections::BTreeMap;

use serde::Deserialize;
use utoipa::openapi::RefOr;
use utoipa::openapi::path::{Parameter, ParameterBuilder, ParameterIn, ParameterStyle};
use utoipa::openapi::schema::{ObjectBuilder, Schema, Type};
use utoipa::{IntoParams, PartialSchema, ToSchema};

use crate::coordinates::{Crs, Transform};
use crate::cql2::{self, Comparison, Expression, Filter, FilterCoordinates, FilterError, Operator};
use crate::features::query::queryables;
use crate::features::{Collection, CollectionSchema, Kind, Property};
use crate::http::problem::Problem;

/// The language of a filter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(try_from = "String")]
pub enum FilterLanguage {
    #[default]
    Text,
    Json,
}

/// Their names. GDAL looks for the last one, which drafts of the standard had for the text.
const LANGUAGES: [(&str, FilterLanguage); 3] =
    [("cql2-text", FilterLanguage::Text), ("cql2-json", FilterLanguage::Json), ("cql-text", FilterLanguage::Text)];

impl TryFrom<String> for FilterLanguage {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let known = LANGUAGES.iter().find(|(name, _)| *name == text);
        known.map(|&(_, language)| language).ok_or("must be cql2-text or cql2-json")
    }
}

impl PartialSchema for FilterLanguage {
    fn schema() -> RefOr<Schema> {
        let names = LANGUAGES.map(|(name, _)| name);
        ObjectBuilder::new().schema_type(Type::String).enum_values(Some(names)).default(Some(names[0].into())).into()
    }
}

impl ToSchema for FilterLanguage {}

impl FilterLanguage {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Text => "cql2-text",
            Self::Json => "cql2-json",
        }
    }

    fn read(self, filter: &str) -> Result<Expression, FilterError> {
        match self {
            Self::Text => cql2::read_text(filter),
            Self::Json => cql2::read_json(filter),
        }
    }
}

/// The filter on a collection whose shapes are in the coordinates that `transform` leads to.
///
/// # Errors
/// 400 with what is wrong, and where.
pub fn filter(
    collection: Collection,
    filter: &str,
    language: FilterLanguage,
    transform: &Transform,
) -> Result<Filter, Problem> {
    let to_data = |position| transform.inverse(position).into();
    let coordinates = FilterCoordinates { are_degrees: transform.crs() == Crs::Crs84, to_data: &to_data };
    let bound = language.read(filter).and_then(|read| Filter::new(&read, &queryables(collection), coordinates));
    bound.map_err(|error| Problem::parameter("filter", error.to_string()))
}

/// The filter that properties are equal to these values.
///
/// # Errors
/// 400 where the collection has no such property, or the value is none of its kind.
pub fn equal(collection: Collection, values: &[(String, String)]) -> Result<Vec<Filter>, Problem> {
    let unmoved = FilterCoordinates { are_degrees: false, to_data: &|position| position };
    let equal = |(name, value): &(String, String)| {
        let wrong = |detail: String| Problem::parameter(name, detail);
        let property = scalar(collection, name);
        let property = property.ok_or_else(|| wrong(format!("is not a property of {}", collection.id())))?;
        let value = literal(property, value).map_err(|detail| wrong(detail.to_owned()))?;
        let sides = vec![Expression::Property(name.clone()), value];
        let equal = Expression::call(Operator::Comparison(Comparison::Equal), sides);
        Filter::new(&equal, &queryables(collection), unmoved).map_err(|error| wrong(error.to_string()))
    };
    values.iter().map(equal).collect()
}

/// The value that a text is of a property.
fn literal(property: &Property, text: &str) -> Result<Expression, &'static str> {
    match property.kind {
        Kind::Boolean => text.parse().map(Expression::Boolean).map_err(|_| "must be true or false"),
        Kind::Integer => {
            let number = text.parse().ok().filter(|number: &f64| number.is_finite() && number.fract() == 0.0);
            number.map(Expression::Number).ok_or("must be a whole number")
        }
        Kind::Number => {
            let number = text.parse().ok().filter(|number: &f64| number.is_finite());
            number.map(Expression::Number).ok_or("must be a number")
        }
        _ => Ok(Expression::Text(text.to_owned())),
    }
}

/// Name of the parameter by which clients count: a property of this name is compared in a `filter` only.
const PAGING: &str = "offset";

/// Whether a property has a parameter of its own.
fn has_parameter(property: &Property) -> bool {
    property.kind.is_scalar() && property.name != PAGING
}

/// A property that has a parameter of its own.
fn scalar(collection: Collection, name: &str) -> Option<&'static Property> {
    let schema = CollectionSchema::of(collection);
    schema.find(name).map(|index| &schema.properties[index]).filter(|property| has_parameter(property))
}

/// Whether a collection has a parameter of this name for a property, or no collection has.
pub fn may_have_parameter(collection: Collection, name: &str) -> bool {
    scalar(collection, name).is_some() || !is_property(name)
}

/// Whether a collection has a property of this name that has a parameter of its own.
pub fn is_property(name: &str) -> bool {
    Collection::ALL.into_iter().any(|collection| scalar(collection, name).is_some())
}

/// The parameters for properties, in the document: those of all collections.
#[derive(Debug)]
pub struct PropertyParameters;

impl IntoParams for PropertyParameters {
    fn into_params(_: impl Fn() -> Option<ParameterIn>) -> Vec<Parameter> {
        let mut collections: BTreeMap<&str, Vec<(Collection, &Property)>> = BTreeMap::new();
        for collection in Collection::ALL {
            let having = CollectionSchema::of(collection).properties.iter().filter(|property| has_parameter(property));
            having.for_each(|property| collections.entry(property.name).or_default().push((collection, property)));
        }
        collections.into_iter().map(|(name, having)| parameter(name, &having)).collect()
    }
}

fn parameter(name: &str, having: &[(Collection, &Property)]) -> Parameter {
    let ids: Vec<&str> = having.iter().map(|(collection, _)| collection.id()).collect();
    let data_type = match having[0].1.kind {
        kind if having.iter().any(|(_, property)| property.kind != kind) => Type::String,
        Kind::Boolean => Type::Boolean,
        Kind::Integer => Type::Integer,
        Kind::Number => Type::Number,
        _ => Type::String,
    };
    ParameterBuilder::new()
        .name(name)
        .parameter_in(ParameterIn::Query)
        .required(utoipa::openapi::Required::False)
        .description(Some(format!(
            "Only features of which this property is equal to it. A property of {}",
            ids.join(", ")
        )))
        .style(Some(ParameterStyle::Form))
        .explode(Some(false))
        .schema(Some(ObjectBuilder::new().schema_type(data_type)))
        .build()
}
