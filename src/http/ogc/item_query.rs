//! Which feature a client asks for, and how it is to be written.

use serde::Deserialize;
use utoipa::IntoParams;

use super::collections::CollectionId;
use super::items_format::Format;
use super::profile::GeoJsonProfile;
use crate::coordinates::{Georeference, Transform};
use crate::features::Collection;
use crate::features::query::PropertySelection;
use crate::http::extract::crs::CrsName;
use crate::http::links::encode;
use crate::http::problem::Problem;
use crate::views::id::Id;

/// `/v1/maps/{mapId}/collections/{collectionId}/items/{featureId}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
#[allow(clippy::struct_field_names, reason = "they are the names in the path")]
pub struct FeaturePath {
    /// The map.
    pub map_id: Id,
    /// The collection.
    pub collection_id: CollectionId,
    /// The feature: a number, or the code of a location.
    #[param(example = "5")]
    pub feature_id: String,
}

/// How to write a feature.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct ItemQuery {
    /// Only these properties; all when absent. They come in the order of the schema.
    #[param(value_type = Option<Vec<String>>, style = Form, explode = false, min_items = 1, example = json!(["id"]))]
    properties: Option<String>,
    /// Profiles of GeoJSON, the most wanted first: `rfc7946` (the default), `jsonfg` or `jsonfg-plus`, or their URIs. A link
    /// `profile` says which one the answer has.
    #[param(value_type = Option<Vec<String>>, style = Form, explode = false, min_items = 1, example = json!(["jsonfg"]))]
    profile: Option<String>,
    /// System of the coordinates of the answer; CRS84 when absent.
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    pub crs: CrsName,
}

impl ItemQuery {
    /// Which properties are written.
    ///
    /// # Errors
    /// 400 where the collection has none of such a name.
    pub fn properties(&self, collection: Collection) -> Result<PropertySelection, Problem> {
        properties(self.properties.as_deref(), collection)
    }

    /// The profile in which the answer is written.
    pub fn profile(&self, format: Format) -> Option<GeoJsonProfile> {
        GeoJsonProfile::chosen(self.profile.as_deref(), format)
    }

    /// From the map frame to the coordinates of the answer.
    ///
    /// # Errors
    /// 400 where the map does not answer in them.
    pub fn transform(&self, georeference: Option<Georeference>) -> Result<Transform, Problem> {
        self.crs.transform(georeference).map_err(|detail| Problem::parameter("crs", detail))
    }

    /// The query string of the answer in a format.
    pub fn parameters(&self, format: Format) -> String {
        let mut parameters = Vec::new();
        parameters.extend(self.properties.as_ref().map(|names| format!("properties={}", encode(names))));
        parameters.extend(self.profile.as_ref().map(|names| format!("profile={}", encode(names))));
        if self.crs != CrsName::default() {
            parameters.push(format!("crs={}", encode(&self.crs.uri())));
        }
        if format != Format::GeoJson {
            parameters.push(format!("f={}", format.name()));
        }
        parameters.join("&")
    }
}

/// The properties that a client names; all where it names none.
///
/// # Errors
/// 400 where the collection has none of such a name.
pub fn properties(names: Option<&str>, collection: Collection) -> Result<PropertySelection, Problem> {
    let read = |names| PropertySelection::read(names, collection);
    let selection = names.map_or_else(|| Ok(PropertySelection::all(collection)), read);
    selection.map_err(|detail| Problem::parameter("properties", detail))
}
