//! Which requests are worked on now, later, or not at all.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::bodies::BodyRoom;
use super::gate::Gate;
use crate::config::Config;
use crate::measures::{HTTP_BODIES, Measures};

pub use super::gate::Turn;

/// Requests with a turn for each core where most of them only read: some wait for the database.
const TURNS_OF_A_CORE: usize = 8;

/// How requests of a group of routes are let in.
#[derive(Debug, Clone)]
pub struct Entrance {
    gate: Arc<Gate>,
    bodies: Arc<BodyRoom>,
    /// Longest body, bytes.
    body_bytes: usize,
}

/// The entrances of the service.
#[derive(Debug, Clone)]
pub struct Entrances {
    /// To routes that answer within milliseconds.
    pub light: Entrance,
    /// To routes that compute: pictures, routes, exports, comparisons, previews.
    pub heavy: Entrance,
    /// To routes that take maps.
    pub uploads: Entrance,
}

impl Entrances {
    /// The entrances of a configuration, for bodies of these lengths.
    #[must_use]
    pub fn new(config: &Config, body_bytes: usize, upload_bytes: usize, measures: &Measures) -> Self {
        let held = measures.gauge(HTTP_BODIES, &[]);
        let bodies = BodyRoom::new(config.upload_folder(), config.max_uploading_bytes, held);
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let entrance = |turns: usize, places: usize, body_bytes| {
            let gate = Arc::new(Gate::new(turns, places.max(turns)));
            Entrance { gate, bodies: Arc::clone(&bodies), body_bytes }
        };
        Self {
            light: entrance(TURNS_OF_A_CORE * cores, config.max_requests, body_bytes),
            heavy: entrance(cores, config.max_heavy_requests, body_bytes),
            // The whole map is in memory from here on.
            uploads: entrance(cores, config.max_heavy_requests, upload_bytes),
        }
    }
}

/// Middleware: the body is received, then the request has its turn, which ends when its answer is written.
pub async fn admit(State(entrance): State<Entrance>, mut request: Request, next: Next) -> Response {
    if !request.method().is_safe() {
        request = match entrance.bodies.receive(request, entrance.body_bytes).await {
            Ok(request) => request,
            Err(problem) => return problem.into_response(),
        };
    }
    let turn = match entrance.gate.turn().await {
        Ok(turn) => turn,
        Err(problem) => return problem.into_response(),
    };
    request.extensions_mut().insert(turn.clone());
    let mut response = next.run(request).await;
    response.extensions_mut().insert(turn);
    response
}
