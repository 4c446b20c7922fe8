//! A service that is shared rather than copied.

use std::sync::Arc;
use std::task::{Context, Poll};

use axum::extract::Request;
use tower::util::Oneshot;
use tower::{Service, ServiceExt as _};

/// A service that is copied for a request only when the request reaches it. Each middleware that is a function copies all
/// that lies below it for each request, so that a stack of them costs the square of its height; between them, this makes
/// the copies small.
#[derive(Debug)]
pub struct SharedService<S>(Arc<S>);

impl<S> SharedService<S> {
    /// Shares a service.
    pub fn new(service: S) -> Self {
        Self(Arc::new(service))
    }
}

impl<S> Clone for SharedService<S> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<S: Service<Request> + Clone> Service<Request> for SharedService<S> {
    type Response = S::Response;
    type Error = S::Error;
    type Future = Oneshot<S, Request>;

    fn poll_ready(&mut self, _: &mut Context<'_>) -> Poll<Result<(), S::Error>> {
        // The copy waits until it is ready.
        Poll::Ready(Ok(()))
    }

    fn call(&mut self, request: Request) -> Self::Future {
        S::clone(&self.0).oneshot(request)
    }
}
