//! The human level of a map: categories with suggestions, and the labels in force.

use std::collections::BTreeMap;
use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use jiff::Timestamp;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use stillage_core::semantics::Assignment;
use stillage_core::spec::AnnotationMethod;
use utoipa::ToSchema;
use uuid::Uuid;

use crate::app::{App, Caller, MapContext, NewSemantics, SemanticsOrigin, SemanticsRecord};
use crate::http::docs::refusals::{NotAnalysed, NotFound, PreconditionRequired};
use crate::http::extract::conditional::{EntityTag, IfMatch, IfNoneMatch};
use crate::http::extract::{JsonBody, MapPath, Path, pointer_step};
use crate::http::links::{Base, JSON, Link};
use crate::http::problem::Problem;

/// A category of places, as the person who names it needs to see it.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Category)]
#[serde(rename_all = "camelCase")]
pub struct CategoryView {
    /// The category: a key of the assignment.
    id: u8,
    /// Whether it is a cluster of free cells, or stands for faces without any.
    kind: CategoryKind,
    /// Free cells that carry it (clusters), or cells of its faces (the others).
    cells: usize,
    /// Area of those cells, square metres.
    area_m2: f64,
    /// Mean of each feature over the measured cells, by name; lengths in metres.
    #[schema(value_type = std::collections::BTreeMap<String, f64>)]
    mean_features: serde_json::Map<String, serde_json::Value>,
    /// Faces whose category it is.
    faces: usize,
    /// Area of those faces, square metres.
    faces_area_m2: f64,
    /// Share of the cells of those faces that are free.
    free_fraction: f64,
    /// Share that is occupied.
    occupied_fraction: f64,
    /// Share that is unknown.
    unknown_fraction: f64,
    /// Label in force.
    #[schema(example = "co")]
    label: String,
    suggestion: SuggestionView,
}

/// What a category is made of.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum CategoryKind {
    /// Free cells that look alike.
    Cluster,
    /// Faces that hold obstacles and no free cell.
    Occupied,
    /// Faces among known places that hold no known cell.
    Unknown,
    /// Unexplored faces around the site.
    Outside,
}

/// A proposed label.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Suggestion)]
#[serde(rename_all = "camelCase")]
pub struct SuggestionView {
    #[schema(example = "co")]
    label: String,
    /// 0 to 1.
    confidence: f64,
    /// Why, for people.
    reason: String,
    /// Long over short side of its faces, on average.
    elongation: f64,
    /// Median area of its faces, square metres.
    median_area_m2: f64,
    /// Share of the length of their edges that one could pass.
    open_fraction: f64,
}

/// The categories of a map.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct CategoryList {
    categories: Vec<CategoryView>,
    /// The rule set whose labels are meant.
    rule_set: String,
    links: Vec<Link>,
}

/// List categories
///
/// What there is to name: each category with its extent, its features, the label in force and a suggested one.
#[utoipa::path(get, path = "/v1/maps/{mapId}/categories", tag = "semantics", operation_id = "listCategories",
    params(MapPath),
    responses((status = 200, description = "The categories", body = CategoryList,
        headers(("ETag" = String, description = "Changes with the analysis and the labels"))),
        NotFound, NotAnalysed))]
pub async fn categories(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let version = context.semantics.version.to_string();
    let tag = EntityTag::of_content(&["categories", &context.analysis_id.to_string(), &version]);
    Ok(tag.answer(&if_none_match, || {
        let links = vec![
            base.link("self", &format!("/v1/maps/{}/categories", path.map_id), JSON),
            base.link("related", &format!("/v1/maps/{}/semantics", path.map_id), JSON).titled("Labels in force"),
        ];
        let categories = 0..context.analysis.face_categories.count() as u8;
        let categories = categories.map(|category| CategoryView::new(&context, category)).collect();
        Json(CategoryList { categories, rule_set: context.semantics.rule_set.clone(), links }).into_response()
    }))
}

impl CategoryView {
    fn new(context: &MapContext, id: u8) -> Self {
        let (analysis, rules) = (&context.analysis, &context.semantic.rule_set);
        let (map, kinds) = (&analysis.categories, &analysis.face_categories);
        // Where faces are clustered, a category has no cells of its own.
        let votes = analysis.options.annotation.method == AnnotationMethod::Vote;
        let cluster = map.categories.get(usize::from(id)).filter(|_| votes);
        let faces = || analysis.faces.iter().skip(1).filter(|face| face.category == id);
        let cells = cluster.map_or_else(|| faces().map(|face| face.cells).sum(), |cluster| cluster.cells);
        let names = map.feature_names.iter();
        let means = cluster.map(|cluster| cluster.mean_features.as_slice()).unwrap_or_default();
        let suggestion = context.suggestions.iter().find(|suggestion| suggestion.category == id);
        let evidence = suggestion.map(|suggestion| suggestion.evidence.clone()).unwrap_or_default();
        let unidentified = &rules.label(rules.unidentified()).id;
        Self {
            id,
            kind: match cluster {
                _ if usize::from(id) < kinds.clusters => CategoryKind::Cluster,
                _ if id == kinds.occupied() => CategoryKind::Occupied,
                _ if id == kinds.unknown() => CategoryKind::Unknown,
                _ => CategoryKind::Outside,
            },
            cells,
            area_m2: cells as f64 * analysis.frame.resolution * analysis.frame.resolution,
            mean_features: names.zip(means).map(|(name, &mean)| (name.clone(), mean.into())).collect(),
            faces: faces().count(),
            faces_area_m2: faces().map(|face| face.area).sum(),
            free_fraction: evidence.free_fraction,
            occupied_fraction: evidence.occupied_fraction,
            unknown_fraction: evidence.unknown_fraction,
            label: context.semantics.assignment.assignment.get(&id).unwrap_or(unidentified).clone(),
            suggestion: SuggestionView {
                label: suggestion.map_or(unidentified, |suggestion| &rules.label(suggestion.label).id).clone(),
                confidence: suggestion.map_or(0.0, |suggestion| suggestion.confidence),
                reason: suggestion.map(|suggestion| suggestion.reason.clone()).unwrap_or_default(),
                elongation: evidence.elongation,
                median_area_m2: evidence.median_area,
                open_fraction: evidence.open_fraction,
            },
        }
    }
}

/// The labels of a map.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Semantics)]
#[serde(rename_all = "camelCase")]
pub struct SemanticsView {
    #[schema(example = "warehouse")]
    rule_set: String,
    /// Label by category.
    #[schema(value_type = BTreeMap<String, String>, example = json!({"0": "co", "1": "pc"}))]
    assignment: BTreeMap<u8, String>,
    overrides: Vec<OverrideView>,
    /// 0 is the suggestion; assigned versions count from 1.
    version: u64,
    origin: OriginView,
    #[schema(value_type = String, format = DateTime)]
    created: Timestamp,
}

/// The label of a single face, stronger than that of its category.
#[derive(Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = LabelOverride)]
#[serde(deny_unknown_fields)]
pub struct OverrideView {
    /// Id of the face.
    face: u32,
    #[schema(example = "ju")]
    label: String,
}

/// Who decided: nobody yet (the suggestion is in force), or a person.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum OriginView {
    /// Nobody yet.
    Suggested,
    /// A person.
    Assigned,
}

impl From<SemanticsRecord> for SemanticsView {
    fn from(record: SemanticsRecord) -> Self {
        let overrides = record.assignment.overrides.into_iter().map(|(face, label)| OverrideView { face, label });
        Self {
            rule_set: record.rule_set,
            assignment: record.assignment.assignment,
            overrides: overrides.collect(),
            version: record.version,
            origin: match record.origin {
                SemanticsOrigin::Suggested => OriginView::Suggested,
                SemanticsOrigin::Assigned => OriginView::Assigned,
            },
            created: record.created,
        }
    }
}

/// The tag of the labels in force. Version 0 is the suggestion of whatever analysis is in force, so that is in it too.
fn tag(analysis: Uuid, record: &SemanticsRecord) -> EntityTag {
    EntityTag::of_content(&["semantics", &analysis.to_string(), &record.version.to_string()])
}

/// New labels of a map. What a read adds (`version`, `origin`, `created`) may be sent back and is ignored.
#[derive(Debug, Deserialize, ToSchema)]
#[schema(as = NewSemantics)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct SemanticsBody {
    /// The rule set; the one in force when absent.
    #[schema(example = "warehouse")]
    rule_set: Option<String>,
    /// Label by category. Categories that are not named become the rule set's unidentified label.
    #[serde(default)]
    #[schema(example = json!({"0": "co", "1": "pc"}))]
    assignment: BTreeMap<String, String>,
    #[serde(default)]
    overrides: Vec<OverrideView>,
    #[serde(default, rename = "version")]
    #[schema(read_only, value_type = serde_json::Value)]
    _version: IgnoredAny,
    #[serde(default, rename = "origin")]
    #[schema(read_only, value_type = serde_json::Value)]
    _origin: IgnoredAny,
    #[serde(default, rename = "created")]
    #[schema(read_only, value_type = serde_json::Value)]
    _created: IgnoredAny,
}

impl SemanticsBody {
    fn into_assignment(self) -> Result<Assignment, Problem> {
        let mut overrides = BTreeMap::new();
        for (index, OverrideView { face, label }) in self.overrides.into_iter().enumerate() {
            if overrides.insert(face, label).is_some() {
                return Err(Problem::invalid(
                    format!("/overrides/{index}/face"),
                    format!("face {face} is named twice"),
                ));
            }
        }
        let mut assignment = BTreeMap::new();
        for (category, label) in self.assignment {
            let number = category.parse().ok().filter(|number: &u8| number.to_string() == category);
            let unknown =
                || Problem::invalid(format!("/assignment/{}", pointer_step(&category)), "there is no such category");
            assignment.insert(number.ok_or_else(unknown)?, label);
        }
        Ok(Assignment { assignment, overrides })
    }
}

/// Labels in force
///
/// Until a person assigns labels, the suggestion is in force (version 0, origin `suggested`).
#[utoipa::path(get, path = "/v1/maps/{mapId}/semantics", tag = "semantics", operation_id = "getSemantics",
    params(MapPath),
    responses((status = 200, description = "The labels", body = SemanticsView,
        headers(("ETag" = String, description = "Changes with them"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let answer = || Json(SemanticsView::from(context.semantics.clone())).into_response();
    Ok(tag(context.analysis_id, &context.semantics).answer(&if_none_match, answer))
}

/// Assign labels
///
/// Makes a new version, which is in force at once: labels, cogency, connectivity, places and locations follow from it
/// in milliseconds, without a job.
#[utoipa::path(put, path = "/v1/maps/{mapId}/semantics", tag = "semantics", operation_id = "assignSemantics",
    params(MapPath, ("If-Match" = Option<String>, Header, description = "The ETag that was read; 428 without it")),
    request_body = SemanticsBody,
    responses((status = 200, description = "The labels as they are now", body = SemanticsView,
            headers(("ETag" = String, description = "Changes with them"))),
        NotFound, NotAnalysed, PreconditionRequired))]
pub async fn assign(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_match: IfMatch,
    JsonBody(body): JsonBody<SemanticsBody>,
) -> Result<Response, Problem> {
    let map = path.map_id.0;
    let faces: Vec<u32> = body.overrides.iter().map(|entry| entry.face).collect();
    let new = NewSemantics { rule_set: body.rule_set.clone(), assignment: body.into_assignment()? };
    let context = app.context(&caller, map).await?;
    let if_match = if_match.against(&tag(context.analysis_id, &context.semantics), context.semantics.version)?;
    let record = app.put_semantics(&caller, map, new, if_match).await;
    let record = record.map_err(|error| Problem::from(error).map_pointers(|pointer| list_pointer(pointer, &faces)))?;
    let headers = [(header::ETAG, tag(context.analysis_id, &record).header())];
    Ok((headers, Json(SemanticsView::from(record))).into_response())
}

/// The core names an override by its face (`/overrides/12`); in the request it is an entry of a list.
fn list_pointer(pointer: &str, faces: &[u32]) -> String {
    let face = pointer.strip_prefix("/overrides/").and_then(|rest| rest.split('/').next()?.parse::<u32>().ok());
    match face.and_then(|face| faces.iter().position(|&entry| entry == face)) {
        Some(index) => format!("/overrides/{index}"),
        None => pointer.to_owned(),
    }
}

/// The versions of the labels of a map.
#[derive(Debug, Serialize, ToSchema)]
pub struct SemanticsHistory {
    /// Newest first.
    versions: Vec<SemanticsView>,
    links: Vec<Link>,
}

/// Versions of the labels
///
/// Every version that a person made, newest first.
#[utoipa::path(get, path = "/v1/maps/{mapId}/semantics/versions", tag = "semantics",
    operation_id = "listSemanticsVersions", params(MapPath),
    responses((status = 200, description = "The versions", body = SemanticsHistory),
        NotFound))]
pub async fn versions(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
) -> Result<Json<SemanticsHistory>, Problem> {
    let versions = app.semantics_versions(&caller, path.map_id.0).await?.into_iter().map(Into::into).collect();
    let links = vec![
        base.link("self", &format!("/v1/maps/{}/semantics/versions", path.map_id), JSON),
        base.link("latest-version", &format!("/v1/maps/{}/semantics", path.map_id), JSON),
    ];
    Ok(Json(SemanticsHistory { versions, links }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_is_overridden_once() {
        let body: SemanticsBody = serde_json::from_str(
            r#"{"overrides": [{"face": 3, "label": "co"}, {"face": 3, "label": "ju"}], "version": 4, "origin": "assigned"}"#,
        )
        .expect("is a body");
        let problem = body.into_assignment().expect_err("is refused");
        assert_eq!(problem.errors()[0].pointer.as_deref(), Some("/overrides/1/face"));
    }

    #[test]
    fn pointers_lead_into_the_list() {
        assert_eq!(list_pointer("/overrides/12", &[7, 12]), "/overrides/1");
        assert_eq!(list_pointer("/assignment/9", &[7, 12]), "/assignment/9");
    }
}
