//! Bodies of requests, until they are there.

use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use hyper::body::{Body, Bytes, Frame, Incoming, SizeHint};

use super::waiting::Waiting;

/// A body for which the connection waits; once it is there, the service works.
#[derive(Debug)]
pub(super) struct AwaitedBody {
    body: Incoming,
    waiting: Arc<Waiting>,
}

impl AwaitedBody {
    pub(super) const fn new(body: Incoming, waiting: Arc<Waiting>) -> Self {
        Self { body, waiting }
    }
}

impl Body for AwaitedBody {
    type Data = Bytes;
    type Error = hyper::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, hyper::Error>>> {
        let frame = Pin::new(&mut self.body).poll_frame(context);
        if matches!(frame, Poll::Ready(None)) || self.body.is_end_stream() {
            self.waiting.work();
        }
        frame
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}
