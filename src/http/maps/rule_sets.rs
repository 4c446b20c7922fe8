//! Rule sets: labels with their functionality and connect-ability, and the cogency that follows.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use utoipa::IntoParams;

use crate::app::{App, Caller, RuleSetRecord};
use crate::http::docs::refusals::{Conflict, NotFound, PreconditionRequired};
use crate::http::extract::conditional::{EntityTag, IfMatch, IfNoneMatch};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{JsonBody, Path};
use crate::http::links::{Base, JSON};
use crate::http::page;
use crate::http::problem::{Problem, ProblemType};
use crate::views::rule_set::{RuleSetBody, RuleSetList, RuleSetView};

fn view(base: &Base, record: RuleSetRecord) -> RuleSetView {
    let links = vec![
        base.link("self", &format!("/v1/rule-sets/{}", record.id), JSON),
        base.link("related", &format!("/v1/rule-sets/{}/matrix", record.id), JSON)
            .titled("Cogency of every pair of labels"),
        base.link("collection", "/v1/rule-sets", JSON),
    ];
    RuleSetView::new(record, links)
}

fn answer(base: &Base, record: RuleSetRecord) -> Response {
    let tag = [(header::ETAG, tag(&record).header())];
    (tag, Json(view(base, record))).into_response()
}

/// The tag of a rule set. Versions count anew when a rule set is deleted and made again, so the content is in it too.
fn tag(record: &RuleSetRecord) -> EntityTag {
    tag_of("rule-set", record)
}

/// The tag of what is made of a rule set.
pub fn tag_of(kind: &str, record: &RuleSetRecord) -> EntityTag {
    let draft = serde_json::to_string(&record.draft).expect("labels and rules are plain data");
    EntityTag::of_content(&[kind, &record.version.to_string(), &draft])
}

/// `/v1/rule-sets/{ruleSetId}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
pub struct RuleSetPath {
    /// The rule set: `site`, `warehouse` and `office` are built in.
    #[param(example = "site")]
    pub rule_set_id: String,
}

/// List rule sets
///
/// Built in: `site`, the default, and of the two tables that it joins `warehouse` (Table II of the paper) and `office`
/// (Table IV).
#[utoipa::path(get, path = "/v1/rule-sets", tag = "semantics", operation_id = "listRuleSets",
    responses((status = 200, description = "The rule sets",
        content((RuleSetList = "application/json"), (String = "text/html")))))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    accept: Accept,
) -> Result<Response, Problem> {
    let rule_sets = app.rule_sets(&caller).await?.into_iter().map(|record| view(&base, record)).collect();
    let links = vec![base.link("self", "/v1/rule-sets", JSON)];
    Ok(page::answer(&accept, "Rule sets", &RuleSetList { rule_sets, links }))
}

/// Create a rule set
#[utoipa::path(post, path = "/v1/rule-sets", tag = "semantics", operation_id = "createRuleSet",
    request_body = RuleSetBody,
    responses(
        (status = 201, description = "Created", body = RuleSetView,
            headers(("Location" = String, description = "The rule set"), ("ETag" = String, description = "Changes with the rule set"))),
        Conflict))]
pub async fn create(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    JsonBody(body): JsonBody<RuleSetBody>,
) -> Result<Response, Problem> {
    let id = body.id.clone().filter(|id| is_rule_set_id(id)).ok_or_else(|| {
        Problem::invalid("/id", "must have 1 to 64 lower-case letters, digits and hyphens, and not begin with a hyphen")
    })?;
    let record = app.create_rule_set(&caller, &id, body.into_draft()).await?;
    let location = [(header::LOCATION, format!("/v1/rule-sets/{id}"))];
    Ok((StatusCode::CREATED, location, answer(&base, record)).into_response())
}

fn is_rule_set_id(id: &str) -> bool {
    let plain = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
    (1..=64).contains(&id.len()) && id.bytes().all(plain) && !id.starts_with('-')
}

/// A rule set
#[utoipa::path(get, path = "/v1/rule-sets/{ruleSetId}", tag = "semantics", operation_id = "getRuleSet",
    params(RuleSetPath),
    responses((status = 200, description = "The rule set",
        content((RuleSetView = "application/json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the rule set"))),
        NotFound))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<RuleSetPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let record = app.rule_set(&caller, &path.rule_set_id).await?;
    let tag = tag_of(&page::kind("rule-set", &accept), &record);
    Ok(tag.answer(&if_none_match, || page::answer(&accept, "Rule set", &view(&base, record))))
}

/// The rule set that a write is meant for, once it may be written.
async fn writable(app: &App, caller: &Caller, id: &str) -> Result<RuleSetRecord, Problem> {
    let record = app.rule_set(caller, id).await?;
    if record.built_in {
        let detail = format!("rule set {id} is built in: create one of your own instead");
        return Err(Problem::new(ProblemType::ReadOnly, detail));
    }
    Ok(record)
}

/// Replace a rule set
///
/// Maps keep the rules they were labelled with until they are labelled again.
#[utoipa::path(put, path = "/v1/rule-sets/{ruleSetId}", tag = "semantics", operation_id = "replaceRuleSet",
    params(RuleSetPath, ("If-Match" = Option<String>, Header, description = "The ETag that was read; 428 without it")),
    request_body = RuleSetBody,
    responses((status = 200, description = "The rule set as it is now", body = RuleSetView,
            headers(("ETag" = String, description = "Changes with the rule set"))),
        NotFound, PreconditionRequired))]
pub async fn replace(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<RuleSetPath>,
    if_match: IfMatch,
    JsonBody(body): JsonBody<RuleSetBody>,
) -> Result<Response, Problem> {
    let current = writable(&app, &caller, &path.rule_set_id).await?;
    if body.id.as_ref().is_some_and(|id| *id != path.rule_set_id) {
        return Err(Problem::invalid("/id", format!("differs from the id of the address, {}", path.rule_set_id)));
    }
    let if_match = if_match.against(&tag(&current), current.version)?;
    let record = app.put_rule_set(&caller, &path.rule_set_id, body.into_draft(), if_match).await?;
    Ok(answer(&base, record))
}

/// Delete a rule set
///
/// Maps keep the rules they were labelled with.
#[utoipa::path(delete, path = "/v1/rule-sets/{ruleSetId}", tag = "semantics", operation_id = "deleteRuleSet",
    params(RuleSetPath, ("If-Match" = Option<String>, Header, description = "The ETag that was read; 428 without it")),
    responses((status = 204, description = "Deleted"),
        NotFound, PreconditionRequired))]
pub async fn delete(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<RuleSetPath>,
    if_match: IfMatch,
) -> Result<StatusCode, Problem> {
    let current = writable(&app, &caller, &path.rule_set_id).await?;
    let if_match = if_match.against(&tag(&current), current.version)?;
    app.delete_rule_set(&caller, &path.rule_set_id, if_match).await?;
    Ok(StatusCode::NO_CONTENT)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_of_rule_sets_are_plain() {
        for id in ["site", "hall-3", "7"] {
            assert!(is_rule_set_id(id), "{id}");
        }
        for id in ["", "-a", "Hall", "a/b", "ä", &"a".repeat(65)] {
            assert!(!is_rule_set_id(id), "{id}");
        }
    }
}
