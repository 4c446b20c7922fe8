//! Jobs in the shape of OGC API Processes.

use std::sync::Arc;
use std::time::Duration;

use axum::Json;
use axum::extract::{RawQuery, State};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};

use crate::app::{App, Caller, JobFilter, JobRecord, JobState};
use crate::http::docs::refusals::{Conflict, NotFound};
use crate::http::extract::datetime::Datetime;
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{ListLimit, Path, Query};
use crate::http::links::{Base, JSON};
use crate::http::page;
use crate::http::paging::{cut, next_header};
use crate::http::problem::Problem;
use crate::views::id::Id;
use crate::views::job::{JobStatus, JobView};
use crate::views::link::Link;

/// The job as the client sees it.
pub(super) fn view(base: &Base, job: JobRecord) -> JobView {
    let path = format!("/v1/jobs/{}", job.id);
    let mut links = vec![
        base.link("self", &path, JSON),
        base.link("monitor", &format!("{path}/events"), "text/event-stream"),
        base.link("related", &format!("/v1/maps/{}", job.map), JSON).titled("The map"),
    ];
    if job.state == JobState::Successful {
        links.push(base.link("http://www.opengis.net/def/rel/ogc/1.0/results", &format!("{path}/results"), JSON));
    }
    JobView::new(job, links)
}

/// 202 with the address of the job.
#[must_use]
pub fn accepted(base: &Base, job: JobRecord) -> Response {
    let location = [(header::LOCATION, format!("/v1/jobs/{}", job.id))];
    (StatusCode::ACCEPTED, location, Json(view(base, job))).into_response()
}

/// `/v1/jobs/{jobId}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
pub struct JobPath {
    /// The job.
    pub job_id: Id,
}

/// Which jobs to list.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct JobQuery {
    /// States, separated by commas.
    #[param(value_type = Option<Vec<JobStatus>>, style = Form, explode = false, min_items = 1)]
    status: Option<States>,
    /// Ids of processes, separated by commas.
    #[serde(rename = "processID")]
    #[param(rename = "processID", example = "semantic-map")]
    process_id: Option<String>,
    /// Type of the jobs: all are `process`.
    #[serde(rename = "type")]
    #[param(inline, rename = "type")]
    _type: Option<JobType>,
    /// When they were accepted: a time, a day, or an interval such as `2026-01-01/..`.
    #[param(value_type = Option<String>, example = "2026-01-01T00:00:00Z/..")]
    datetime: Option<Datetime>,
    /// Seconds that they took at least, or have been running for.
    #[param(value_type = Option<u32>, rename = "minDuration")]
    min_duration: Option<u32>,
    /// Seconds that they took at most, or have been running for.
    #[param(value_type = Option<u32>, rename = "maxDuration")]
    max_duration: Option<u32>,
    /// Most entries of the answer, and never more than 1,000.
    #[serde(default)]
    #[param(value_type = Option<u32>, minimum = 1, default = 100)]
    limit: ListLimit,
    /// Id of the last job of the page before: taken from the `next` link.
    after: Option<Id>,
}

impl JobQuery {
    /// What the store is asked for: one job more than the page has.
    fn filter(self) -> JobFilter {
        let seconds = |seconds: u32| Duration::from_secs(seconds.into());
        JobFilter {
            states: self.status.map(|states| states.0).unwrap_or_default(),
            processes: self.process_id.iter().flat_map(|ids| ids.split(',')).map(str::to_owned).collect(),
            map: None,
            created_from: self.datetime.and_then(|time| time.start),
            created_to: self.datetime.and_then(|time| time.end),
            min_duration: self.min_duration.map(seconds),
            max_duration: self.max_duration.map(seconds),
            limit: self.limit.0 + 1,
            after: self.after.map(|id| id.0),
        }
    }
}

/// Type of a job.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum JobType {
    /// A run of a process.
    Process,
}

/// A list of states as a parameter.
#[derive(Debug, Deserialize)]
#[serde(try_from = "String")]
struct States(Vec<JobState>);

impl TryFrom<String> for States {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let state = |name: &str| match name {
            "accepted" => Ok(JobState::Accepted),
            "running" => Ok(JobState::Running),
            "successful" => Ok(JobState::Successful),
            "failed" => Ok(JobState::Failed),
            "dismissed" => Ok(JobState::Dismissed),
            _ => Err(format!("{name:?} is none of accepted, running, successful, failed, dismissed")),
        };
        text.split(',').map(state).collect::<Result<_, _>>().map(Self)
    }
}

/// A page of jobs.
#[derive(Debug, Serialize, ToSchema)]
pub struct JobList {
    jobs: Vec<JobView>,
    links: Vec<Link>,
}

/// List jobs
///
/// Newest first.
#[utoipa::path(get, path = "/v1/jobs", tag = "jobs", operation_id = "listJobs", params(JobQuery),
    responses((status = 200, description = "A page of jobs",
        content((JobList = "application/json"), (String = "text/html")),
        headers(("Link" = Option<String>, description = "The next page")))))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    RawQuery(asked): RawQuery,
    Query(query): Query<JobQuery>,
    accept: Accept,
) -> Result<Response, Problem> {
    let limit = query.limit.0;
    let (jobs, more) = cut(app.jobs(&caller, query.filter()).await?, limit);
    let asked = asked.unwrap_or_default();
    let next = jobs.last().filter(|_| more).map(|last| {
        // The same question, from the last job on.
        let kept = asked.split('&').filter(|pair| !pair.is_empty() && !pair.starts_with("after="));
        let pairs: Vec<String> = kept.map(str::to_owned).chain([format!("after={}", last.id)]).collect();
        base.link("next", &format!("/v1/jobs?{}", pairs.join("&")), JSON)
    });
    let headers = next_header(next.as_ref());
    let links = std::iter::once(base.link("self", "/v1/jobs", JSON)).chain(next).collect();
    let jobs = jobs.into_iter().map(|job| view(&base, job)).collect();
    Ok((headers, page::answer(&accept, "Jobs", &JobList { jobs, links })).into_response())
}

/// A job
#[utoipa::path(get, path = "/v1/jobs/{jobId}", tag = "jobs", operation_id = "getJob", params(JobPath),
    responses((status = 200, description = "The job", content((JobView = "application/json"), (String = "text/html"))),
        NotFound))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<JobPath>,
    accept: Accept,
) -> Result<Response, Problem> {
    let job = app.job(&caller, path.job_id.0).await?;
    let mut response = page::answer(&accept, "Job", &view(&base, job));
    response.headers_mut().insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    Ok(response)
}

/// Dismiss a job
///
/// A queued job is dismissed at once, a running one within a second. A job that is over stays as it is: 409.
#[utoipa::path(delete, path = "/v1/jobs/{jobId}", tag = "jobs", operation_id = "dismissJob", params(JobPath),
    responses((status = 200, description = "The job, dismissed or about to be", body = JobView),
        NotFound, Conflict))]
pub async fn dismiss(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<JobPath>,
) -> Result<Json<JobView>, Problem> {
    Ok(Json(view(&base, app.dismiss_job(&caller, path.job_id.0).await?)))
}

/// Run a job once more
///
/// A job that failed or was dismissed waits again, with all its attempts. Any other stays as it is: 409.
#[utoipa::path(post, path = "/v1/jobs/{jobId}/retry", tag = "jobs", operation_id = "retryJob", params(JobPath),
    responses((status = 202, description = "It waits", body = JobView,
            headers(("Location" = String, description = "The job"))),
        NotFound, Conflict))]
pub async fn retry(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<JobPath>,
) -> Result<Response, Problem> {
    Ok(accepted(&base, app.retry_job(&caller, path.job_id.0).await?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_are_listed_with_commas() {
        let states = States::try_from("running,failed".to_owned()).expect("are states");
        assert_eq!(states.0, [JobState::Running, JobState::Failed]);
        let refused = States::try_from("runing".to_owned()).expect_err("is none");
        assert_eq!(refused, "\"runing\" is none of accepted, running, successful, failed, dismissed");
    }
}
