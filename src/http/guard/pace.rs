//! Bodies have to keep a pace.

use std::future::Future;
use std::pin::Pin;
use std::task::{Context, Poll};

use axum::body::{Body, BodyDataStream, Bytes};
use axum::extract::Request;
use axum::middleware::Next;
use axum::response::Response;
use futures::Stream;
use tokio::time::Instant;

use crate::pace::{Pace, PaceLimits, SLOWEST, STANDSTILL};

/// Middleware: a body has to keep its [`Pace`]; [`Paced`] ends the slow ones.
pub async fn at_pace(request: Request, next: Next) -> Response {
    let is_read = request.method().is_safe();
    let paced = |body| Body::from_stream(Paced::new(body, PaceLimits::default()));
    next.run(if is_read { request } else { request.map(paced) }).await
}

/// The body arrived below its pace.
#[derive(Debug, thiserror::Error)]
#[error("the body arrived too slowly: nothing came for {STANDSTILL:?}, or less than {SLOWEST} bytes per second")]
pub struct TooSlow;

/// A body that fails once it falls behind its pace.
struct Paced {
    body: BodyDataStream,
    pace: Pace,
    timer: Pin<Box<tokio::time::Sleep>>,
}

impl Paced {
    fn new(body: Body, limits: PaceLimits) -> Self {
        let pace = Pace::new(limits, Instant::now());
        Self { body: body.into_data_stream(), pace, timer: Box::pin(tokio::time::sleep_until(pace.deadline())) }
    }
}

impl Stream for Paced {
    type Item = Result<Bytes, axum::BoxError>;

    fn poll_next(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<Self::Item>> {
        if let Poll::Ready(chunk) = Pin::new(&mut self.body).poll_next(context) {
            if let Some(Ok(bytes)) = &chunk {
                self.pace.moved(bytes.len(), Instant::now());
                let deadline = self.pace.deadline();
                self.timer.as_mut().reset(deadline);
            }
            return Poll::Ready(chunk.map(|chunk| chunk.map_err(Into::into)));
        }
        self.timer.as_mut().poll(context).map(|()| Some(Err(TooSlow.into())))
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    const LIMITS: PaceLimits = PaceLimits { standstill: Duration::from_millis(100), bytes_per_second: 10_000.0 };

    /// Reads a body of chunks that come every millisecond, and then pauses.
    async fn read(chunk: usize, pause: Duration) -> Result<usize, axum::Error> {
        let chunks = futures::stream::unfold(0, move |sent| async move {
            tokio::time::sleep(if sent == 150 { pause } else { Duration::from_millis(1) }).await;
            (sent <= 150).then(|| (Ok::<_, std::io::Error>(vec![0_u8; chunk]), sent + 1))
        });
        let paced = Paced::new(Body::from_stream(chunks), LIMITS);
        axum::body::to_bytes(Body::from_stream(paced), usize::MAX).await.map(|bytes| bytes.len())
    }

    #[tokio::test]
    async fn a_trickle_is_ended_and_a_flow_is_not() {
        assert!(read(1, Duration::ZERO).await.is_err());
        assert_eq!(read(10_000, Duration::ZERO).await.expect("is fast enough"), 1_510_000);
    }

    #[tokio::test]
    async fn what_came_fast_gives_no_time_to_stand_still() {
        assert!(read(10_000, LIMITS.standstill * 3).await.is_err());
    }
}
