//! The bytes of a connection, watched on their way.

use std::future::Future;
use std::io::{self, IoSlice};
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::time::{Instant, Sleep};

use super::heads::HeadWatch;
use super::waiting::Waiting;
use crate::pace::{Pace, PaceLimits};

/// A stream that refuses heads which other programs may read differently ([`HeadWatch`]), and fails once its client takes
/// answers more slowly than [`Pace`] allows.
#[derive(Debug)]
pub(super) struct WatchedStream<S> {
    stream: S,
    waiting: Arc<Waiting>,
    limits: PaceLimits,
    heads: HeadWatch,
    blocked: Option<BlockedWrite>,
}

/// A client that does not take what is written.
#[derive(Debug)]
struct BlockedWrite {
    pace: Pace,
    /// Whether the last write had to wait.
    is_waiting: bool,
    timer: Pin<Box<Sleep>>,
}

impl<S> WatchedStream<S> {
    pub(super) fn new(stream: S, waiting: Arc<Waiting>, limits: PaceLimits) -> Self {
        Self { stream, waiting, limits, heads: HeadWatch::default(), blocked: None }
    }

    /// What becomes of a write that took some bytes, or has to wait.
    fn written(&mut self, context: &mut Context<'_>, write: Poll<io::Result<usize>>) -> Poll<io::Result<usize>> {
        match write {
            Poll::Pending => self.blocked(context),
            Poll::Ready(Ok(bytes)) => {
                self.waiting.moved(bytes);
                match &mut self.blocked {
                    Some(blocked) if blocked.is_waiting => {
                        blocked.is_waiting = false;
                        blocked.pace.moved(bytes, Instant::now());
                    }
                    // There was room at once: the client keeps up.
                    _ => self.blocked = None,
                }
                Poll::Ready(Ok(bytes))
            }
            failed @ Poll::Ready(Err(_)) => failed,
        }
    }

    fn blocked(&mut self, context: &mut Context<'_>) -> Poll<io::Result<usize>> {
        let limits = self.limits;
        let blocked = self.blocked.get_or_insert_with(|| {
            let pace = Pace::new(limits, Instant::now());
            BlockedWrite { pace, is_waiting: true, timer: Box::pin(tokio::time::sleep_until(pace.deadline())) }
        });
        blocked.is_waiting = true;
        if blocked.timer.deadline() != blocked.pace.deadline() {
            blocked.timer.as_mut().reset(blocked.pace.deadline());
        }
        blocked
            .timer
            .as_mut()
            .poll(context)
            .map(|()| Err(io::Error::new(io::ErrorKind::TimedOut, "the client takes its answer too slowly")))
    }
}

impl<S: AsyncRead + Unpin> AsyncRead for WatchedStream<S> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let before = buffer.filled().len();
        let read = Pin::new(&mut self.stream).poll_read(context, buffer);
        let new = &mut buffer.filled_mut()[before..];
        if !new.is_empty() {
            self.waiting.moved(new.len());
            self.heads.pass(new);
        }
        read
    }
}

impl<S: AsyncWrite + Unpin> AsyncWrite for WatchedStream<S> {
    fn poll_write(mut self: Pin<&mut Self>, context: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        let write = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.written(context, write)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        slices: &[IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let write = Pin::new(&mut self.stream).poll_write_vectored(context, slices);
        self.written(context, write)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, duplex};

    use super::*;

    const LIMITS: PaceLimits = PaceLimits { standstill: Duration::from_millis(200), bytes_per_second: 10_000.0 };

    /// Writes to a client that takes so many bytes every ten milliseconds.
    async fn write_to(bytes_each_time: usize) -> io::Result<()> {
        let (mut client, server) = duplex(256);
        let mut server = WatchedStream::new(server, Arc::new(Waiting::new()), LIMITS);
        let reader = tokio::spawn(async move {
            let mut buffer = vec![0; bytes_each_time];
            while client.read_exact(&mut buffer).await.is_ok() {
                tokio::time::sleep(Duration::from_millis(10)).await;
            }
        });
        let written = server.write_all(&vec![0; 20_000]).await;
        reader.abort();
        written
    }

    #[tokio::test]
    async fn a_slow_link_is_served_to_its_end_and_a_trickle_is_not() {
        write_to(256).await.expect("it keeps the pace");
        assert_eq!(write_to(1).await.expect_err("it does not").kind(), io::ErrorKind::TimedOut);
    }

    #[tokio::test]
    async fn a_client_that_takes_nothing_is_closed_after_the_standstill() {
        let (_client, server) = duplex(256);
        let mut server = WatchedStream::new(server, Arc::new(Waiting::new()), LIMITS);
        let begin = Instant::now();
        assert!(server.write_all(&[0; 1_000]).await.is_err());
        assert!(begin.elapsed() >= LIMITS.standstill);
    }
}
