//! The human level of a map: categories with suggestions, and the labels in force.

use std::collections::BTreeMap;
use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use stillage_core::Point;
use stillage_core::layout::LayoutOptions;
use stillage_core::semantics::Assignment;
use uuid::Uuid;

use crate::app::{App, Caller, MapContext, NewSemantics, SemanticsRecord};
use crate::http::docs::refusals::{NotAnalysed, NotFound, PreconditionRequired};
use crate::http::extract::conditional::{EntityTag, IfMatch, IfNoneMatch};
use crate::http::extract::{JsonBody, MapPath, Path, pointer_step};
use crate::http::links::{Base, JSON};
use crate::http::problem::Problem;
use crate::views::category::{CategoryList, CategoryView};
use crate::views::layout::LayoutView;
use crate::views::semantics::{OverrideView, SemanticsBody, SemanticsHistory, SemanticsView};

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
    tag.answer_computed(&if_none_match, move || {
        let links = vec![
            base.link("self", &format!("/v1/maps/{}/categories", path.map_id), JSON),
            base.link("related", &format!("/v1/maps/{}/semantics", path.map_id), JSON).titled("Labels in force"),
        ];
        let categories = 0..context.analysis.face_categories.count() as u8;
        let categories = categories.map(|category| CategoryView::new(&context, category)).collect();
        Ok(Json(CategoryList { categories, rule_set: context.semantics.rule_set.clone(), links }).into_response())
    })
    .await
}

/// The tag of the labels in force. Version 0 is the suggestion of whatever analysis is in force, with the layout of the
/// newest decision on the site, so these are in it too.
fn tag(analysis: Uuid, record: &SemanticsRecord) -> EntityTag {
    let layout = serde_json::to_string(&record.layout).expect("a layout is plain data");
    EntityTag::of_content(&["semantics", &analysis.to_string(), &record.version.to_string(), &layout])
}

fn read_assignment(body: SemanticsBody) -> Result<Assignment, Problem> {
    let mut overrides = BTreeMap::new();
    for (index, OverrideView { face, label }) in body.overrides.into_iter().enumerate() {
        if overrides.insert(face, label).is_some() {
            return Err(Problem::invalid(format!("/overrides/{index}/face"), format!("face {face} is named twice")));
        }
    }
    let mut assignment = BTreeMap::new();
    for (category, label) in body.assignment {
        let number = category.parse().ok().filter(|number: &u8| number.to_string() == category);
        let unknown =
            || Problem::invalid(format!("/assignment/{}", pointer_step(&category)), "there is no such category");
        assignment.insert(number.ok_or_else(unknown)?, label);
    }
    Ok(Assignment { assignment, overrides })
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
    let tag = tag(context.analysis_id, &context.semantics);
    let answer =
        move || Ok(Json(SemanticsView::new(context.semantics.clone(), &context.record.to_site())).into_response());
    tag.answer_computed(&if_none_match, answer).await
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
    let context = app.context(&caller, map).await?;
    let layout = body.layout.as_ref().map(|layout| read_layout(layout, &context)).transpose()?;
    let new = NewSemantics { rule_set: body.rule_set.clone(), assignment: read_assignment(body)?, layout };
    let if_match = if_match.against(&tag(context.analysis_id, &context.semantics), context.semantics.version)?;
    let record = app.put_semantics(&caller, map, new, if_match).await;
    let record = record.map_err(|error| Problem::from(error).map_pointers(|pointer| list_pointer(pointer, &faces)))?;
    let headers = [(header::ETAG, tag(context.analysis_id, &record).header())];
    Ok((headers, Json(SemanticsView::new(record, &context.record.to_site()))).into_response())
}

/// The layout that is wished. The entrance lies in the map, or just outside it.
fn read_layout(body: &LayoutView, context: &MapContext) -> Result<LayoutOptions, Problem> {
    /// How far outside the grid an entrance may lie, metres: a map may end before the door.
    const OUTSIDE_M: f64 = 10.0;
    let wrong = |pointer: &str, detail: String| Problem::invalid(format!("/layout{pointer}"), detail);
    let layout = body.read(&context.semantics.layout, &context.record.to_site());
    let layout = layout.map_err(|unusable| wrong(unusable.pointer, unusable.detail))?;
    if let Some(entrance) = body.entrance() {
        let (grid, at) = (&context.grid, context.grid.frame().to_grid(Point::from(entrance)));
        let is_near =
            |place: f64, cells: usize| (-OUTSIDE_M..=cells as f64 * grid.resolution() + OUTSIDE_M).contains(&place);
        if !(is_near(at.x, grid.width()) && is_near(at.y, grid.height())) {
            let detail =
                format!("lies more than {OUTSIDE_M} m outside the map: give x and y in metres of the map frame");
            return Err(wrong("/entrance", detail));
        }
    }
    Ok(layout)
}

/// The core names an override by its face (`/overrides/12`); in the request it is an entry of a list.
fn list_pointer(pointer: &str, faces: &[u32]) -> String {
    let face = pointer.strip_prefix("/overrides/").and_then(|rest| rest.split('/').next()?.parse::<u32>().ok());
    match face.and_then(|face| faces.iter().position(|&entry| entry == face)) {
        Some(index) => format!("/overrides/{index}"),
        None => pointer.to_owned(),
    }
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
    let to_site = app.map(&caller, path.map_id.0).await?.to_site();
    let versions = app.semantics_versions(&caller, path.map_id.0).await?.into_iter();
    let versions = versions.map(|record| SemanticsView::new(record, &to_site)).collect();
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
        let problem = read_assignment(body).expect_err("is refused");
        assert_eq!(problem.errors()[0].pointer.as_deref(), Some("/overrides/1/face"));
    }

    #[test]
    fn pointers_lead_into_the_list() {
        assert_eq!(list_pointer("/overrides/12", &[7, 12]), "/overrides/1");
        assert_eq!(list_pointer("/assignment/9", &[7, 12]), "/assignment/9");
    }
}
