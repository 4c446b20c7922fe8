//! What a change of the labels would do, without doing it.

use std::sync::Arc;

use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use stillage_core::compare::LabelChange;
use utoipa::IntoParams;

use super::semantics::in_list;
use super::semantics_body::{self, SemanticsPatchBody};
use crate::app::{App, Caller, LabelPreview};
use crate::blocking::off_the_runtime;
use crate::coordinates::Transform;
use crate::features::{Collection, Feature, FeatureId};
use crate::formats::geojson::{self, GeoJsonFeature};
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::crs::{CONTENT_CRS, CrsName};
use crate::http::extract::{JsonBody, Limit, MapPath, Path, Query};
use crate::http::links::GEO_JSON;
use crate::http::problem::Problem;
use crate::views::label_preview::{LabelPreviewView, PreviewCounts, RelabelledFace};

/// Parameters of a preview.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct PreviewQuery {
    /// System of the coordinates of the answer; CRS84 when absent.
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
    /// Most faces of the answer, and never more than 10,000; all of them are counted.
    #[serde(default)]
    #[param(value_type = Option<u32>, minimum = 1, default = 1000)]
    limit: Limit<1_000, 10_000>,
}

/// Preview labels
///
/// What a change of the labels would do, which is as in `PATCH …/semantics` (labels as they are read may be sent, too, and a
/// rule set that is not stored in the place of its id):
/// counts of faces, locations, edges and links before and after, and the faces whose label would change as GeoJSON features
/// with `label` and `previousLabel`. Nothing is stored.
#[utoipa::path(post, path = "/v1/maps/{mapId}/semantics/preview", tag = "semantics", operation_id = "previewSemantics",
    params(MapPath, PreviewQuery),
    request_body(content((SemanticsPatchBody = "application/json"),
        (SemanticsPatchBody = "application/merge-patch+json"))),
    responses((status = 200, description = "What would change", body = LabelPreviewView,
            content_type = "application/geo+json",
            headers(("Content-Crs" = String, description = "System of the coordinates"))),
        NotFound, NotAnalysed))]
pub async fn create(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    Query(query): Query<PreviewQuery>,
    JsonBody(body): JsonBody<SemanticsPatchBody>,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let transform =
        query.crs.transform(context.record.georeference).map_err(|detail| Problem::parameter("crs", detail))?;
    let faces = body.listed_faces();
    let change = semantics_body::of_patch(body, &context)?;
    let preview = app.preview_semantics(&caller, context, change).await;
    let preview = preview.map_err(|error| in_list(faces)(Problem::from(error)))?;
    let headers = [(header::CONTENT_TYPE, GEO_JSON.parse().expect("is a header")), (CONTENT_CRS, query.crs.header())];
    let body = off_the_runtime(move || written(&preview, query.limit.0 as usize, &transform)).await;
    Ok((headers, body).into_response())
}

/// The GeoJSON of a preview with so many faces.
fn written(preview: &LabelPreview, limit: usize, transform: &Transform) -> Vec<u8> {
    let faces = preview.before.features(Collection::Faces);
    let shape = |change: &LabelChange| -> Option<&Feature> {
        let id = FeatureId::Number(change.face.into());
        faces.binary_search_by(|face| face.id.cmp(&id)).ok().map(|index| &faces[index])
    };
    let told: Vec<(&Feature, RelabelledFace<'_>)> = preview
        .faces
        .iter()
        .filter_map(|change| {
            let (label, previous_label) = (change.now.as_deref(), change.before.as_deref());
            Some((shape(change)?, RelabelledFace { label, previous_label }))
        })
        .take(limit)
        .collect();
    let documents = told.iter().map(|(face, properties)| GeoJsonFeature {
        id: Some(&face.id),
        geometry: &face.geometry,
        properties,
        members: &[],
    });
    let (matched, returned, counts) = (preview.faces.len(), told.len(), PreviewCounts::of(preview));
    let members = [("numberMatched", &matched as _), ("numberReturned", &returned as _), ("counts", &counts as _)];
    geojson::document_collection(documents, transform, &members)
}
