//! Processes: what jobs compute, and jobs by way of them (OGC API Processes part 1).

use std::sync::Arc;
use std::time::Duration;

use axum::extract::State;
use axum::http::{HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};
use axum::{Extension, Json};
use serde::Deserialize;
use serde_json::json;
use utoipa::IntoParams;
use uuid::Uuid;

use super::execution_body::{Analysed, ExecuteBody, Execution};
use super::jobs::{self, JobPath};
use crate::app::{ANALYSIS, AnalysisTicket, App, AppError, Caller, JobState};
use crate::http::docs::refusals::{NoSpace, NotFound};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::prefer::Prefer;
use crate::http::extract::{JsonBody, Path};
use crate::http::guard::admission::Turn;
use crate::http::links::{Base, GEO_JSON, HTML, JSON};
use crate::http::page;
use crate::http::problem::Problem;
use crate::views::job::JobView;
use crate::views::process::{ProcessList, ProcessSummaryView, ProcessView, ResultsView};

/// Longest time in which a synchronous execution is waited for: below that in which proxies give up.
const PATIENCE: Duration = Duration::from_secs(25);

fn summary(base: &Base) -> ProcessSummaryView {
    let path = format!("/v1/processes/{}", ANALYSIS.id);
    let links = vec![
        base.link("self", &path, JSON),
        base.link("alternate", &format!("{path}?f=html"), HTML),
        base.link("http://www.opengis.net/def/rel/ogc/1.0/execute", &format!("{path}/execution"), JSON)
            .titled("POST executes it"),
        base.link("http://www.opengis.net/def/rel/ogc/1.0/job-list", "/v1/jobs", JSON),
    ];
    ProcessSummaryView::new(&ANALYSIS, links)
}

/// `/v1/processes/{processId}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
pub struct ProcessPath {
    /// The process.
    #[param(example = "semantic-map")]
    process_id: String,
}

impl ProcessPath {
    /// That there is such a process.
    fn check(&self) -> Result<(), Problem> {
        if self.process_id == ANALYSIS.id {
            return Ok(());
        }
        Err(Problem::not_found(format!("there is no such process: GET /v1/processes lists {}", ANALYSIS.id)))
    }
}

/// List processes
///
/// What jobs compute.
#[utoipa::path(get, path = "/v1/processes", tag = "jobs", operation_id = "listProcesses",
    responses((status = 200, description = "The processes",
        content((ProcessList = "application/json"), (String = "text/html")))))]
pub async fn list(base: Base, accept: Accept) -> Response {
    let links = vec![base.link("self", "/v1/processes", JSON)];
    page::answer(&accept, "Processes", &ProcessList { processes: vec![summary(&base)], links })
}

/// A process
///
/// Its inputs and outputs.
#[utoipa::path(get, path = "/v1/processes/{processId}", tag = "jobs", operation_id = "getProcess", params(ProcessPath),
    responses((status = 200, description = "The process",
        content((ProcessView = "application/json"), (String = "text/html"))),
        NotFound))]
pub async fn get(base: Base, Path(path): Path<ProcessPath>, accept: Accept) -> Result<Response, Problem> {
    path.check()?;
    let options = base.link("describedby", "/openapi-3.0.json#/components/schemas/AnalysisOptions", JSON).href;
    Ok(page::answer(&accept, ANALYSIS.title, &ProcessView::analysis(summary(&base), &options)))
}

/// Execute a process
///
/// Analyses a map that was uploaded (`mapId`), or one that is sent. The results are waited for, up to 25 seconds
/// (`Prefer: wait=N` for less); with `Prefer: respond-async`, or where they take longer, the answer is the job that makes
/// them. What was analysed before is answered at once.
#[utoipa::path(post, path = "/v1/processes/{processId}/execution", tag = "jobs", operation_id = "execute",
    params(ProcessPath,
        ("Prefer" = Option<String>, Header, description = "`respond-async`, `respond-sync`, `wait=N` in seconds (RFC 7240)")),
    request_body = ExecuteBody,
    responses(
        (status = 200, description = "The results", body = ResultsView),
        (status = 201, description = "The job that makes them", body = JobView,
            headers(("Location" = String, description = "The job"),
                ("Preference-Applied" = Option<String>, description = "`respond-async` where that was asked for"))),
        NotFound, NoSpace))]
pub async fn execute(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<ProcessPath>,
    prefer: Prefer,
    Extension(turn): Extension<Turn>,
    JsonBody(body): JsonBody<ExecuteBody>,
) -> Result<Response, Problem> {
    path.check()?;
    let execution = body.read()?;
    let asked = match &execution.analysed {
        Analysed::Stored(map, options) => app.create_analysis(&caller, *map, options.clone(), false).await,
        Analysed::Sent(map) => {
            app.create_map(&caller, map.clone()).await.map(|(job, _)| AnalysisTicket::Job(Box::new(job)))
        }
    };
    let ticket = asked.map_err(|error| match error {
        AppError::NotFound { id, .. } => Problem::invalid("/inputs/mapId", format!("there is no map {id}")),
        error => Problem::from(error).map_pointers(|pointer| execution.pointer(pointer)),
    })?;
    let job = match ticket {
        AnalysisTicket::Existing(record) => return Ok(answer(&base, record.map, record.id, &execution)),
        AnalysisTicket::Job(job) => {
            turn.end();
            app.job_within(&caller, job.id, prefer.patience(PATIENCE)).await?
        }
    };
    if let (JobState::Successful, Some(analysis)) = (job.state, job.analysis()) {
        return Ok(answer(&base, job.map, analysis, &execution));
    }
    let mut response = jobs::accepted(&base, job);
    *response.status_mut() = StatusCode::CREATED;
    if prefer.is_async {
        response.headers_mut().insert("preference-applied", HeaderValue::from_static("respond-async"));
    }
    Ok(response)
}

/// What an execution asked for.
fn answer(base: &Base, map: Uuid, analysis: Uuid, execution: &Execution) -> Response {
    let results = results(base, map, analysis, |output| execution.wants(output));
    match execution.raw_output() {
        None => Json(results).into_response(),
        Some(output) => Json(&json!(results)[output]).into_response(),
    }
}

fn results(base: &Base, map: Uuid, analysis: Uuid, wants: impl Fn(&str) -> bool) -> ResultsView {
    let link = |output: &str, below: &str, media_type| {
        wants(output).then(|| base.link("item", &format!("/v1/maps/{map}{below}"), media_type))
    };
    ResultsView {
        analysis: link("analysis", &format!("/analyses/{analysis}"), JSON),
        map: link("map", "", JSON),
        faces: link("faces", "/collections/faces/items", GEO_JSON),
        locations: link("locations", "/collections/locations/items", GEO_JSON),
    }
}

/// Results of a job
///
/// 404 until the job is successful, and where it has none because it failed or was dismissed; the problem says which.
#[utoipa::path(get, path = "/v1/jobs/{jobId}/results", tag = "jobs", operation_id = "getJobResults", params(JobPath),
    responses((status = 200, description = "The results",
        content((ResultsView = "application/json"), (String = "text/html"))),
        NotFound))]
pub async fn of_job(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<JobPath>,
    accept: Accept,
) -> Result<Response, Problem> {
    let job = app.job(&caller, path.job_id.0).await?;
    match (job.state, job.analysis()) {
        (JobState::Successful, Some(analysis)) => {
            Ok(page::answer(&accept, "Results of a job", &results(&base, job.map, analysis, |_| true)))
        }
        (state, _) if state.is_final() => {
            Err(Problem::not_found(format!("the job has no results, it is {}: {}", state.name(), job.message)))
        }
        (state, _) => Err(Problem::not_found(format!("the results are not there yet: the job is {}", state.name()))),
    }
}
