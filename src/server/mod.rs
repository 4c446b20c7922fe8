//! The listening socket: connections with limits, and an orderly end.
//!
//! HTTP/1.1 only. A service behind a proxy needs no more, and detecting the version of a connection has no time limit in
//! hyper-util, so a client that sends one byte would hold it for ever. `axum::serve` sets no timer, so hyper's own limit
//! on the time of a request's head would be off (measured: none of 200 slow clients closed in 45 s).
//!
//! | file | what it holds |
//! | --- | --- |
//! | `places` | which connections are open, and which one makes room for a newcomer |
//! | `waiting` | how long a connection has been waiting for its client |
//! | `stream` | the bytes of a connection: the pace of clients that take answers |
//! | `tls`, `certificate` | TLS; its certificate and key, from files that may change |
//! | `heads` | heads of requests that other programs may read differently |
//! | `body` | bodies of requests, until they are there |
//! | `refusal` | what a connection without a place is answered |
//! | `open_files` | how many files and connections the process may have open |

mod body;
pub mod certificate;
mod heads;
pub mod open_files;
mod places;
mod refusal;
mod stream;
pub mod tls;
mod waiting;

use std::convert::Infallible;
use std::future::Future;
use std::net::IpAddr;
use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::body::Body;
use axum::http::{HeaderValue, Request, Response, header};
use futures::FutureExt;
use hyper::body::{Body as _, Incoming};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::{GracefulShutdown, Watcher};
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinSet;
use tokio::time::Instant;
use tokio_rustls::TlsAcceptor;
use tower::ServiceExt as _;

use crate::app::App;
use crate::http::{self, ClientAddress};
use crate::measures::{HTTP_CONNECTIONS, HTTP_SHED, Present};
use crate::pace::PaceLimits;

use body::AwaitedBody;
pub use heads::HeadWatch;
pub use places::ConnectionLimits;
use places::{ConnectionPlace, ConnectionPlaces};
use refusal::Refusals;
use stream::WatchedStream;
use tls::{RENEWAL_PERIOD, Tls};
use waiting::Waiting;

/// How long a client may take to send the head of a request, or stay silent between two.
const HEAD_TIMEOUT: Duration = Duration::from_secs(10);

/// How long answers may still be written after the jobs have come to rest, at the end of the grace period.
const LAST_ANSWERS: Duration = Duration::from_secs(2);

/// A pause after a failed `accept`, which fails again at once when file descriptors have run out.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// Serves until `stop` comes about, then: not ready any more, and answers close their connections, for the notice of the
/// configuration; no new connections, running requests and jobs to their end within the grace period, the rest of the jobs put
/// back.
pub async fn serve(
    listener: TcpListener,
    tls: Option<Tls>,
    app: Arc<App>,
    limits: ConnectionLimits,
    stop: impl Future<Output = ()>,
) {
    let server = Acceptor::new(Arc::clone(&app), limits, tls.as_ref().map(Tls::acceptor));
    let mut renewal = JoinSet::new();
    if let Some(tls) = tls {
        renewal.spawn(tls.renew(RENEWAL_PERIOD));
    }
    server.accept_until(&listener, stop).await;
    app.announce_stop();
    server.accept_until(&listener, tokio::time::sleep(app.config().shutdown_notice)).await;
    // The kernel has accepted these in our name.
    while let Some((stream, address)) = accept(&listener).now_or_never() {
        server.begin(stream, address);
    }
    drop(listener);
    let deadline = Instant::now() + app.config().shutdown_grace;
    let answers = tokio::spawn(server.connections.shutdown());
    app.stop_jobs().await;
    // Answers read the store, so it is closed after them.
    let deadline = deadline.max(Instant::now() + LAST_ANSWERS);
    if tokio::time::timeout_at(deadline, answers).await.is_err() {
        tracing::warn!("some connections were cut off");
    }
    app.shutdown().await;
}

/// What connections are served with.
struct Acceptor {
    app: Arc<App>,
    router: Router,
    protocol: http1::Builder,
    connections: GracefulShutdown,
    places: Arc<ConnectionPlaces>,
    refusals: Refusals,
    tls: Option<TlsAcceptor>,
}

impl Acceptor {
    fn new(app: Arc<App>, limits: ConnectionLimits, tls: Option<TlsAcceptor>) -> Self {
        let mut protocol = http1::Builder::new();
        protocol.timer(TokioTimer::new()).header_read_timeout(HEAD_TIMEOUT);
        let router = http::router(Arc::clone(&app));
        let (connections, places, refusals) = (GracefulShutdown::new(), ConnectionPlaces::new(limits), Refusals::new());
        Self { app, router, protocol, connections, places, refusals, tls }
    }

    async fn accept_until(&self, listener: &TcpListener, end: impl Future<Output = ()>) {
        let mut end = pin!(end);
        loop {
            tokio::select! {
                (stream, address) = accept(listener) => self.begin(stream, address),
                () = &mut end => return,
            }
        }
    }

    /// Serves a connection, or refuses it where all others are at work: in words where no handshake comes first.
    fn begin(&self, stream: TcpStream, address: IpAddr) {
        let measures = self.app.measures();
        let Some(place) = self.places.take(address) else {
            measures.counter(HTTP_SHED, &[("reason", "connections")]).increment(1);
            if self.tls.is_none() {
                self.refusals.refuse(stream);
            }
            return;
        };
        // Answers are written whole; waiting to fill a packet only delays them.
        let _ = stream.set_nodelay(true);
        let connection = Connection {
            app: Arc::clone(&self.app),
            router: self.router.clone(),
            protocol: self.protocol.clone(),
            watcher: self.connections.watcher(),
            address: ClientAddress(address),
            open: Present::new(measures.gauge(HTTP_CONNECTIONS, &[])),
        };
        match self.tls.clone() {
            None => tokio::spawn(connection.serve(stream, place)),
            Some(tls) => tokio::spawn(connection.serve_behind_tls(tls, stream, place)),
        };
    }
}

/// What one connection is served with.
struct Connection {
    app: Arc<App>,
    router: Router,
    protocol: http1::Builder,
    watcher: Watcher,
    address: ClientAddress,
    open: Present,
}

impl Connection {
    async fn serve_behind_tls(self, tls: TlsAcceptor, stream: TcpStream, place: ConnectionPlace) {
        let handshake = tokio::time::timeout(HEAD_TIMEOUT, tls.accept(stream));
        let stream = tokio::select! {
            stream = handshake => stream,
            () = place.close.notified() => return,
        };
        match stream {
            Ok(Ok(stream)) => self.serve(stream, place).await,
            Ok(Err(error)) => tracing::debug!(%error, "no handshake came about"),
            Err(_) => tracing::debug!("a handshake took too long"),
        }
    }

    async fn serve(self, stream: impl AsyncRead + AsyncWrite + Unpin + Send + 'static, place: ConnectionPlace) {
        let Self { app, router, protocol, watcher, address, open: _open } = self;
        let waiting = Arc::clone(&place.waiting);
        let stream = WatchedStream::new(stream, Arc::clone(&waiting), PaceLimits::default());
        let answer =
            service_fn(move |request| answer(request, address, router.clone(), Arc::clone(&app), Arc::clone(&waiting)));
        let connection = watcher.watch(protocol.serve_connection(TokioIo::new(stream), answer));
        tokio::select! {
            ended = connection => {
                if let Err(error) = ended {
                    tracing::debug!(%error, "connection ended early");
                }
            }
            () = place.close.notified() => tracing::debug!("a connection that waited for its client made room"),
        }
    }
}

/// Answers a request, and tells who waits for whom meanwhile.
async fn answer(
    mut request: Request<Incoming>,
    address: ClientAddress,
    router: Router,
    app: Arc<App>,
    waiting: Arc<Waiting>,
) -> Result<Response<Body>, Infallible> {
    request.extensions_mut().insert(address);
    let request = if request.body().is_end_stream() {
        waiting.work();
        request.map(Body::new)
    } else {
        waiting.begin();
        request.map(|body| Body::new(AwaitedBody::new(body, Arc::clone(&waiting))))
    };
    let mut response = router.oneshot(request).await?;
    waiting.begin();
    if app.is_stopping() {
        response.headers_mut().insert(header::CONNECTION, HeaderValue::from_static("close"));
    }
    Ok(response)
}

/// The next connection, and the address of its client.
async fn accept(listener: &TcpListener) -> (TcpStream, IpAddr) {
    loop {
        match listener.accept().await {
            Ok((stream, address)) => return (stream, address.ip().to_canonical()),
            Err(error) => {
                tracing::warn!(%error, "a connection could not be accepted");
                tokio::time::sleep(ACCEPT_PAUSE).await;
            }
        }
    }
}
