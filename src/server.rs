//! The listening socket: connections with time limits, and an orderly end.
//!
//! HTTP/1.1 only. A service behind a proxy needs no more, and detecting the version of a connection has no time limit in
//! hyper-util, so a client that sends one byte would hold it for ever. `axum::serve` sets no timer, so hyper's own limit
//! on the time of a request's head would be off (measured: none of 200 slow clients closed in 45 s).

use std::future::Future;
use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;

use futures::FutureExt;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use hyper_util::service::TowerToHyperService;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::Instant;

use crate::app::App;
use crate::http;

/// How long a client may take to send the head of a request, or stay silent between two.
const HEAD_TIMEOUT: Duration = Duration::from_secs(10);

/// How long answers may still be written after the jobs have come to rest, at the end of the grace period.
const LAST_ANSWERS: Duration = Duration::from_secs(2);

/// A pause after a failed `accept`, which fails again at once when file descriptors have run out.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// Serves until `stop` comes about, then: not ready any more, no new connections, running requests and jobs to their
/// end within the grace period of the configuration, the rest of the jobs put back.
pub async fn serve(listener: TcpListener, app: Arc<App>, max_connections: usize, stop: impl Future<Output = ()>) {
    let service = TowerToHyperService::new(http::router(Arc::clone(&app)));
    let mut builder = http1::Builder::new();
    builder.timer(TokioTimer::new()).header_read_timeout(HEAD_TIMEOUT);
    let graceful = GracefulShutdown::new();
    let begin = |stream: TcpStream, permit: OwnedSemaphorePermit| {
        // Answers are written whole; waiting to fill a packet only delays them.
        let _ = stream.set_nodelay(true);
        let connection = builder.serve_connection(TokioIo::new(stream), service.clone());
        let connection = graceful.watch(connection);
        tokio::spawn(async move {
            if let Err(error) = connection.await {
                tracing::debug!(%error, "connection ended early");
            }
            drop(permit);
        });
    };

    let permits = Arc::new(Semaphore::new(max_connections.max(1)));
    let mut stop = pin!(stop);
    loop {
        tokio::select! {
            (stream, permit) = accept(&listener, &permits) => begin(stream, permit),
            () = &mut stop => break,
        }
    }
    app.announce_stop();
    // The kernel has accepted these in our name.
    while let Some((stream, permit)) = accept(&listener, &permits).now_or_never() {
        begin(stream, permit);
    }
    drop(listener);
    let deadline = Instant::now() + app.config().shutdown_grace;
    let answers = tokio::spawn(graceful.shutdown());
    app.stop_jobs().await;
    // Answers read the store, so it is closed after them.
    let deadline = deadline.max(Instant::now() + LAST_ANSWERS);
    if tokio::time::timeout_at(deadline, answers).await.is_err() {
        tracing::warn!("some connections were cut off");
    }
    app.shutdown().await;
}

/// The next connection, when there is room for one.
async fn accept(listener: &TcpListener, permits: &Arc<Semaphore>) -> (TcpStream, OwnedSemaphorePermit) {
    let permit = Arc::clone(permits).acquire_owned().await.expect("the semaphore is never closed");
    loop {
        match listener.accept().await {
            Ok((stream, _)) => return (stream, permit),
            Err(error) => {
                tracing::warn!(%error, "a connection could not be accepted");
                tokio::time::sleep(ACCEPT_PAUSE).await;
            }
        }
    }
}
