//! Which features a client asks for.

use std::collections::BTreeSet;

use axum::extract::FromRequestParts;
use axum::http::Uri;
use axum::http::request::Parts;
use serde::Deserialize;
use utoipa::IntoParams;

use super::filter::{self, FilterLanguage};
use super::item_query;
use super::items_format::Format;
use super::profile::GeoJsonProfile;
use crate::coordinates::{Georeference, Transform};
use crate::cql2::Filter;
use crate::features::query::{BoxSelection, FeatureQuery, PropertySelection, SortKey};
use crate::features::{Collection, CollectionSchema};
use crate::http::extract::bbox::Bbox;
use crate::http::extract::crs::CrsName;
use crate::http::extract::datetime::Datetime;
use crate::http::extract::{Limit, Query};
use crate::http::links::encode;
use crate::http::problem::{Problem, ProblemType};

/// Most features of a page where nothing is said.
pub const DEFAULT_LIMIT: u32 = 1_000;
/// Most features of a page.
pub const MAX_LIMIT: u32 = 10_000;

/// Which features.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct ItemsQuery {
    /// Only the features with these ids.
    #[param(value_type = Option<Vec<String>>, style = Form, explode = false, min_items = 1, example = json!(["1", "2"]))]
    ids: Option<String>,
    /// Only features that meet this box: west, south, east, north (or with heights, which do not select).
    #[param(value_type = Option<Vec<f64>>, style = Form, explode = false, min_items = 4, max_items = 6)]
    bbox: Option<Bbox>,
    /// System of the coordinates of `bbox`; CRS84 when absent.
    #[serde(default, rename = "bbox-crs")]
    #[param(value_type = Option<CrsName>, rename = "bbox-crs")]
    bbox_crs: CrsName,
    /// A time, or an interval such as `2026-01-01/..`. No feature has a time, so that it selects every feature.
    #[serde(rename = "datetime")]
    #[param(value_type = Option<String>, rename = "datetime", example = "2026-01-01T00:00:00Z/..")]
    _datetime: Option<Datetime>,
    /// A condition that selects features, in the language that `filter-lang` says: `areaM2 > 20 AND label = 'co'`.
    #[param(max_length = 32_768, example = "id < 100")]
    filter: Option<String>,
    /// The language of `filter`; `cql-text` is an old name of `cql2-text`, which is the default.
    #[serde(default, rename = "filter-lang")]
    #[param(value_type = Option<FilterLanguage>, rename = "filter-lang", inline)]
    filter_lang: FilterLanguage,
    /// System of the coordinates in `filter`; CRS84 when absent.
    #[serde(default, rename = "filter-crs")]
    #[param(value_type = Option<CrsName>, rename = "filter-crs")]
    filter_crs: CrsName,
    /// Properties to sort by, the most important first; `-` before a name sorts downwards. By id when absent. Features
    /// without a value come last.
    #[param(value_type = Option<Vec<String>>, style = Form, explode = false, min_items = 1, example = json!(["id"]))]
    sortby: Option<String>,
    /// Only these properties of the features; all when absent. They come in the order of the schema.
    #[param(value_type = Option<Vec<String>>, style = Form, explode = false, min_items = 1, example = json!(["id"]))]
    properties: Option<String>,
    /// Profiles of GeoJSON, the most wanted first: `rfc7946` (the default), `jsonfg` or `jsonfg-plus`, or their URIs. A link
    /// `profile` says which one the answer has.
    #[param(value_type = Option<Vec<String>>, style = Form, explode = false, min_items = 1, example = json!(["jsonfg"]))]
    profile: Option<String>,
    /// System of the coordinates of the answer; CRS84 when absent.
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
    /// Most features of the answer, and never more than 10,000. CSV and `FlatGeobuf` are whole when absent.
    #[param(value_type = Option<u32>, minimum = 1, default = 1000)]
    limit: Option<Limit<DEFAULT_LIMIT, MAX_LIMIT>>,
    /// Id of the last feature of the page before: taken from the `next` link.
    #[param(max_length = 64)]
    after: Option<String>,
    /// How many features are left out before the page, for clients that count; `next` links go on after a feature, so that
    /// nothing is skipped or repeated when features come and go.
    #[serde(default)]
    #[param(value_type = Option<u32>, default = 0)]
    offset: u32,
    /// Properties and what they are to be equal to, each a parameter of its own.
    #[serde(skip)]
    #[param(ignore)]
    equal: Vec<(String, String)>,
}

impl<S: Sync> FromRequestParts<S> for ItemsQuery {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Problem> {
        let query = parts.uri.query().unwrap_or_default();
        let names_property = |pair: &&str| filter::is_property(pair.split('=').next().unwrap_or_default());
        let (equal, others): (Vec<&str>, Vec<&str>) = query.split('&').partition(names_property);
        let Query(equal) = Query::read(&with_query(&equal)?)?;
        let Query(read) = Query::<Self>::read(&with_query(&others)?)?;
        Ok(Self { equal, ..read })
    }
}

/// An address with these pairs.
fn with_query(pairs: &[&str]) -> Result<Uri, Problem> {
    let address = format!("/?{}", pairs.join("&")).parse();
    address.map_err(|_| Problem::new(ProblemType::BadParameter, "the query is no part of an address"))
}

impl ItemsQuery {
    /// The question to the features of a collection.
    ///
    /// # Errors
    /// 400 with the name of the parameter that says nothing about this collection.
    pub fn question(
        &self,
        collection: Collection,
        format: Format,
        georeference: Option<Georeference>,
    ) -> Result<FeatureQuery, Problem> {
        let schema = CollectionSchema::of(collection);
        let ids = self
            .ids
            .as_deref()
            .map(|list| list.split(',').map(|id| schema.feature_id(id)).collect::<Result<BTreeSet<_>, _>>());
        let sort = self
            .sortby
            .as_deref()
            .map(|list| list.split(',').map(|key| SortKey::read(key, schema)).collect::<Result<Vec<_>, _>>());
        let transform =
            self.bbox_crs.transform(georeference).map_err(|detail| Problem::parameter("bbox-crs", detail))?;
        let within = self.bbox.map(|bbox| BoxSelection::new(bbox.0, transform));
        let filters = self.filters(collection, georeference)?;
        let after = self.after.as_deref().map(|id| schema.feature_id(id));
        let limit = match self.limit {
            Some(limit) => limit.0 as usize,
            None if format.is_whole() => usize::MAX,
            None => DEFAULT_LIMIT as usize,
        };
        Ok(FeatureQuery {
            ids: ids.transpose().map_err(|detail| Problem::parameter("ids", detail))?,
            within: within.transpose().map_err(|detail| Problem::parameter("bbox", detail))?,
            filters,
            sort: sort.transpose().map_err(|detail| Problem::parameter("sortby", detail))?.unwrap_or_default(),
            after: after.transpose().map_err(|detail| Problem::parameter("after", detail))?,
            offset: self.offset as usize,
            limit,
        })
    }

    fn filters(&self, collection: Collection, georeference: Option<Georeference>) -> Result<Vec<Filter>, Problem> {
        let transform =
            self.filter_crs.transform(georeference).map_err(|detail| Problem::parameter("filter-crs", detail))?;
        let mut filters = filter::equal(collection, &self.equal)?;
        if let Some(text) = &self.filter {
            filters.push(filter::filter(collection, text, self.filter_lang, &transform)?);
        }
        Ok(filters)
    }

    /// Which properties are written.
    ///
    /// # Errors
    /// 400 where the collection has none of such a name.
    pub fn properties(&self, collection: Collection) -> Result<PropertySelection, Problem> {
        item_query::properties(self.properties.as_deref(), collection)
    }

    /// The profile in which the answer is written.
    pub fn profile(&self, format: Format) -> Option<GeoJsonProfile> {
        GeoJsonProfile::chosen(self.profile.as_deref(), format)
    }

    /// The system of the coordinates of the answer.
    pub const fn crs(&self) -> CrsName {
        self.crs
    }

    /// From the map frame to the coordinates of the answer.
    ///
    /// # Errors
    /// 400 where the map does not answer in them.
    pub fn transform(&self, georeference: Option<Georeference>) -> Result<Transform, Problem> {
        self.crs.transform(georeference).map_err(|detail| Problem::parameter("crs", detail))
    }

    /// Id of the last feature of the page before.
    pub fn after(&self) -> Option<&str> {
        self.after.as_deref()
    }

    /// The query string of this page, or of one of the same selection after another feature.
    pub fn parameters(&self, format: Format, after: Option<&str>) -> String {
        let mut parameters = Vec::new();
        parameters.extend(self.ids.as_ref().map(|ids| format!("ids={}", encode(ids))));
        if let Some(bbox) = self.bbox {
            parameters.push(format!("bbox={bbox}"));
            parameters.push(format!("bbox-crs={}", encode(&self.bbox_crs.uri())));
        }
        parameters.extend(self.equal.iter().map(|(name, value)| format!("{name}={}", encode(value))));
        if let Some(filter) = &self.filter {
            parameters.push(format!("filter={}", encode(filter)));
            parameters.push(format!("filter-lang={}", self.filter_lang.name()));
            parameters.push(format!("filter-crs={}", encode(&self.filter_crs.uri())));
        }
        parameters.extend(self.sortby.as_ref().map(|keys| format!("sortby={}", encode(keys))));
        parameters.extend(self.properties.as_ref().map(|names| format!("properties={}", encode(names))));
        parameters.extend(self.profile.as_ref().map(|names| format!("profile={}", encode(names))));
        if self.crs != CrsName::default() {
            parameters.push(format!("crs={}", encode(&self.crs.uri())));
        }
        match self.limit {
            Some(limit) => parameters.push(format!("limit={}", limit.0)),
            None if format.is_whole() => {}
            None => parameters.push(format!("limit={DEFAULT_LIMIT}")),
        }
        if self.offset > 0 && after == self.after() {
            parameters.push(format!("offset={}", self.offset));
        }
        parameters.extend(after.map(|after| format!("after={}", encode(after))));
        if format != Format::GeoJson {
            parameters.push(format!("f={}", format.name()));
        }
        parameters.join("&")
    }
}
