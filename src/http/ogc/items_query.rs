//! Which features a client asks for, and how they are to be written.

use std::collections::BTreeSet;

use serde::Deserialize;
use utoipa::{IntoParams, ToSchema};

use crate::coordinates::{Crs, Georeference, Transform};
use crate::features::query::{BoxSelection, FeatureQuery, SortKey};
use crate::features::{Collection, CollectionSchema};
use crate::http::extract::Limit;
use crate::http::extract::bbox::Bbox;
use crate::http::extract::crs::CrsName;
use crate::http::extract::negotiation::Accept;
use crate::http::links::{CSV, GEO_JSON, encode};
use crate::http::problem::Problem;

/// Most features of a page where nothing is said.
const DEFAULT_LIMIT: u32 = 1_000;

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
    /// Properties to sort by, the most important first; `-` before a name sorts downwards. By id when absent. Features
    /// without a value come last.
    #[param(value_type = Option<Vec<String>>, style = Form, explode = false, min_items = 1, example = json!(["id"]))]
    sortby: Option<String>,
    /// System of the coordinates of the answer; CRS84 when absent.
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
    /// Most features of the answer. A table is whole when absent.
    #[param(value_type = Option<u32>, minimum = 1, maximum = 10_000, default = 1000)]
    limit: Option<Limit<DEFAULT_LIMIT, 10_000>>,
    /// Id of the last feature of the page before: taken from the `next` link.
    #[param(max_length = 64)]
    after: Option<String>,
    /// Format, where `Accept` cannot be set. Only the locations are served as CSV.
    #[param(inline)]
    f: Option<Format>,
}

/// Format of the items.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    Json,
    Csv,
}

impl ItemsQuery {
    /// The format of the answer: what `f` says, else what the client accepts.
    ///
    /// # Errors
    /// 400 where the collection is not served in it.
    pub fn format(&self, collection: Collection, accept: &Accept) -> Result<Format, Problem> {
        let has_table = collection == Collection::Locations;
        match self.f {
            Some(Format::Csv) if !has_table => Err(Problem::parameter("f", "only the locations are served as CSV")),
            Some(format) => Ok(format),
            None if has_table && accept.prefers(CSV, GEO_JSON) => Ok(Format::Csv),
            None => Ok(Format::Json),
        }
    }

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
        let transform = Transform::new(self.bbox_crs.0, georeference);
        let within = self.bbox.map(|bbox| BoxSelection::new(bbox.0, transform));
        let after = self.after.as_deref().map(|id| schema.feature_id(id));
        let limit = match (self.limit, format) {
            (Some(limit), _) => limit.0 as usize,
            (None, Format::Json) => DEFAULT_LIMIT as usize,
            (None, Format::Csv) => usize::MAX,
        };
        Ok(FeatureQuery {
            ids: ids.transpose().map_err(|detail| Problem::parameter("ids", detail))?,
            within: within.transpose().map_err(|detail| Problem::parameter("bbox", detail))?,
            sort: sort.transpose().map_err(|detail| Problem::parameter("sortby", detail))?.unwrap_or_default(),
            after: after.transpose().map_err(|detail| Problem::parameter("after", detail))?,
            limit,
        })
    }

    /// The system of the coordinates of the answer.
    pub const fn crs(&self) -> Crs {
        self.crs.0
    }

    /// Id of the last feature of the page before.
    pub fn after(&self) -> Option<&str> {
        self.after.as_deref()
    }

    /// The query string of a page of the same selection.
    pub fn parameters(&self, format: Format, after: Option<&str>) -> String {
        let mut parameters = Vec::new();
        parameters.extend(self.ids.as_ref().map(|ids| format!("ids={}", encode(ids))));
        if let Some(bbox) = self.bbox {
            parameters.push(format!("bbox={bbox}"));
            parameters.push(format!("bbox-crs={}", encode(self.bbox_crs.uri())));
        }
        parameters.extend(self.sortby.as_ref().map(|keys| format!("sortby={}", encode(keys))));
        if self.crs != CrsName::default() {
            parameters.push(format!("crs={}", encode(self.crs.uri())));
        }
        match (self.limit, format) {
            (Some(limit), _) => parameters.push(format!("limit={}", limit.0)),
            (None, Format::Json) => parameters.push(format!("limit={DEFAULT_LIMIT}")),
            (None, Format::Csv) => {}
        }
        parameters.extend(after.map(|after| format!("after={}", encode(after))));
        if format == Format::Csv {
            parameters.push("f=csv".to_owned());
        }
        parameters.join("&")
    }
}
