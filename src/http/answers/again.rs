//! The middleware that gives answers again.

use std::fmt;
use std::sync::Arc;

use axum::body::{Body, to_bytes};
use axum::extract::{Request, State};
use axum::http::{HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use metrics::{Counter, Gauge};
use tokio::runtime::Handle;

use super::answer_cache::AnswerCache;
use super::question::Question;
use super::remembered::Remembered;
use crate::access::Scope;
use crate::app::{App, Caller};
use crate::blocking::off_the_runtime;
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::measures::{CACHE_ANSWERS, CACHE_BYTES};

/// What the middleware works with.
#[derive(Clone)]
pub struct Again {
    app: Arc<App>,
    answers: Arc<AnswerCache>,
    hits: Counter,
    misses: Counter,
    bytes: Gauge,
}

impl fmt::Debug for Again {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Again").field("answers", &self.answers).finish_non_exhaustive()
    }
}

impl Again {
    /// No answers yet.
    pub fn new(app: Arc<App>) -> Self {
        let answers = Arc::new(AnswerCache::new(app.config().cached_answer_bytes));
        let [hits, misses] = ["hit", "miss"].map(|found| app.measures().counter(CACHE_ANSWERS, &[("found", found)]));
        let bytes = app.measures().gauge(CACHE_BYTES, &[]);
        bytes.set(0.0);
        Self { app, answers, hits, misses, bytes }
    }

    /// The answer that was kept for a question, if its map is still in the state it was made of.
    async fn find(&self, question: &Question, caller: &Caller) -> Option<Arc<Remembered>> {
        let remembered = self.answers.find(question)?;
        let moment = remembered.tag.moment()?;
        let state = self.app.map_state(caller, moment.map).await.ok()?;
        (state == Some(moment.state)).then_some(remembered)
    }
}

/// Middleware: an answer that was given before is given again. It lies around the compression, so that an answer is
/// compressed once for each coding. `HEAD` gets the head of what `GET` gets, length and coding too (RFC 9110, 9.3.2).
pub async fn again(State(again): State<Again>, mut request: Request, next: Next) -> Response {
    let reader = request.extensions().get::<Caller>().filter(|caller| caller.may(Scope::Read)).cloned();
    let (Some(question), Some(caller)) = (Question::of(&request), reader) else { return next.run(request).await };
    let is_head = *request.method() == Method::HEAD;
    *request.method_mut() = Method::GET;
    let answer = answer(&again, question, &caller, request, next).await;
    if is_head { answer.map(|_| Body::empty()) } else { answer }
}

async fn answer(again: &Again, question: Question, caller: &Caller, request: Request, next: Next) -> Response {
    let if_none_match = IfNoneMatch::read(request.headers());
    if let Some(answer) = again.find(&question, caller).await.and_then(|remembered| remembered.answer(&if_none_match)) {
        again.hits.increment(1);
        return answer;
    }
    let response = next.run(request).await;
    let is_kept = matches!(response.status(), StatusCode::OK | StatusCode::NOT_MODIFIED);
    match response.extensions().get::<EntityTag>().cloned() {
        Some(tag) if is_kept => {
            again.misses.increment(1);
            let response = kept(&again.answers, question, tag, response).await;
            again.bytes.set(again.answers.bytes() as f64);
            response
        }
        _ => response,
    }
}

async fn kept(answers: &AnswerCache, question: Question, tag: EntityTag, response: Response) -> Response {
    let (mut parts, body) = response.into_parts();
    let body = to_bytes(body, usize::MAX);
    // Reading a body that is compressed on the way takes longer than a moment.
    let runtime = Handle::current();
    let body = if parts.headers.contains_key(header::CONTENT_ENCODING) {
        off_the_runtime(move || runtime.block_on(body)).await
    } else {
        body.await
    };
    let body = match body {
        Ok(body) => body,
        Err(error) => {
            tracing::error!(%error, "an answer could not be written");
            return StatusCode::INTERNAL_SERVER_ERROR.into_response();
        }
    };
    if parts.status == StatusCode::OK {
        parts.headers.insert(header::CONTENT_LENGTH, HeaderValue::from(body.len()));
    }
    answers.keep(question, Remembered::of(tag, &parts, &body));
    Response::from_parts(parts, Body::from(body))
}
