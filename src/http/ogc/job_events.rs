//! The progress of a job as server-sent events.

use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;

use axum::Extension;
use axum::extract::{Request, State};
use axum::http::StatusCode;
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures::{Stream, StreamExt as _};
use jiff::Timestamp;
use utoipa::ToSchema;

use super::event_streams::EventStreams;
use super::jobs::{JobPath, view};
use crate::access::Scope;
use crate::app::{App, AppError, Caller, JobRecord};
use crate::http::ClientAddress;
use crate::http::docs::refusals::NotFound;
use crate::http::extract::Path;
use crate::http::links::Base;
use crate::http::problem::Problem;

/// How often an idle stream of events says that it is still there.
const HEARTBEAT: Duration = Duration::from_secs(15);

/// How soon a client comes back to a stream that broke off.
const RETRY: Duration = Duration::from_secs(2);

/// How long a stream on which nothing happens goes on before it is asked whether its client may still see it. A key is known
/// for a second, so that a revoked one is told after eleven.
const RECHECK: Duration = Duration::from_secs(10);

/// One event of the stream, field by field.
#[derive(Debug, ToSchema)]
#[allow(dead_code, reason = "it describes the lines of the stream")]
pub struct JobEvent {
    /// `progress`
    #[schema(example = "progress")]
    event: String,
    /// Ascends with the changes of the job.
    id: String,
    /// Milliseconds until a client comes back to a stream that broke off.
    retry: u32,
    /// The job, as JSON.
    data: String,
}

/// Watch a job
///
/// Server-sent events: `progress` with the job as its data and its time of change as its id. The stream ends with the
/// final state: `dismissed` where the map is deleted; and within some ten seconds where the key is revoked, or key, token or
/// session end. A client that comes back with `Last-Event-ID` is sent what is newer; when nothing more will come, 204
/// tells it to stay away.
#[utoipa::path(get, path = "/v1/jobs/{jobId}/events", tag = "jobs", operation_id = "watchJob",
    params(JobPath, ("Last-Event-ID" = Option<String>, Header, description = "Id of the last event that arrived")),
    responses((status = 200, description = "The events", body = JobEvent, content_type = "text/event-stream"),
        (status = 204, description = "The job is over, and the client knows"),
        NotFound))]
pub async fn events(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<JobPath>,
    Extension(streams): Extension<Arc<EventStreams>>,
    request: Request,
) -> Result<Response, Problem> {
    let headers = request.headers();
    let job = app.job(&caller, path.job_id.0).await?;
    let last = headers.get("last-event-id").and_then(|id| id.to_str().ok()?.parse::<i64>().ok());
    if job.state.is_final() && last.is_some_and(|last| last >= event_id(&job)) {
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    let place = streams.take(ClientAddress::of(&request))?;
    let events = watch(app, caller, base, job, last).inspect(move |_| {
        // The stream has its place as long as it lives.
        let _ = &place;
    });
    let events = Sse::new(events);
    // Proxies that buffer would hold the events back.
    let headers = [("x-accel-buffering", "no"), ("cache-control", "no-store")];
    Ok((headers, events.keep_alive(KeepAlive::new().interval(HEARTBEAT))).into_response())
}

/// Ids of events ascend with the changes of the job.
fn event_id(job: &JobRecord) -> i64 {
    job.updated.as_microsecond()
}

/// The states of a job from `last` on, up to the final one, as long as the caller may see them.
fn watch(
    app: Arc<App>,
    caller: Caller,
    base: Base,
    job: JobRecord,
    last: Option<i64>,
) -> impl Stream<Item = Result<Event, Infallible>> {
    struct Watching {
        changes: tokio::sync::watch::Receiver<u64>,
        last: Option<i64>,
        /// The job as it was read last.
        job: JobRecord,
        over: bool,
    }
    let start = Watching { changes: app.job_changes(), last, job, over: false };
    futures::stream::unfold(start, move |mut watching| {
        let (app, caller, base) = (Arc::clone(&app), caller.clone(), base.clone());
        async move {
            while !watching.over && !app.is_stopping() && app.still_may(&caller, Scope::Read).await.unwrap_or(false) {
                // Marked before the job is read: a change after the reading wakes again.
                watching.changes.mark_unchanged();
                let job = match app.job(&caller, watching.job.id).await {
                    Ok(job) => job,
                    Err(AppError::NotFound { .. }) => watching.job.clone().deleted(Timestamp::now()),
                    Err(_) => return None,
                };
                watching.job = job.clone();
                if watching.last.is_none_or(|last| event_id(&job) > last) {
                    watching.last = Some(event_id(&job));
                    watching.over = job.state.is_final();
                    let event = Event::default().event("progress").id(event_id(&job).to_string()).retry(RETRY);
                    let event = event.json_data(view(&base, job)).ok()?;
                    return Some((Ok(event), watching));
                }
                watching.over = job.state.is_final();
                if !watching.over
                    && let Ok(changed) = tokio::time::timeout(RECHECK, watching.changes.changed()).await
                {
                    changed.ok()?;
                }
            }
            None
        }
    })
}
