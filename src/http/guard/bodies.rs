//! Bodies of requests, received whole before anybody works with them.
//!
//! What is small is held in memory; what is longer goes to a file without a name in the folder of the rows or the blobs, which the system removes
//! however the process ends. So a client that stands still costs little, whatever it has sent. All that is held counts against
//! one budget.

use std::fs::File;
use std::io::{self, Read as _, Seek as _, Write as _};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use axum::body::{Body, Bytes};
use axum::extract::Request;
use axum::http::header;
use futures::TryStreamExt as _;
use metrics::Gauge;

use crate::blocking::off_the_runtime;
use crate::http::extract::broken_body;
use crate::http::problem::{Problem, ProblemType};

/// Bytes of a body in memory; also those that are written or read at a time.
const IN_MEMORY: usize = 256 << 10;

/// When a client may try again that found no room for its body, seconds: about the time of an upload.
const RETRY_AFTER_S: u32 = 5;

/// Room for the bodies of all requests.
#[derive(Debug)]
pub struct BodyRoom {
    folder: PathBuf,
    most: u64,
    held: AtomicU64,
    /// Tells the same to operators.
    gauge: Gauge,
}

impl BodyRoom {
    /// Room for `most` bytes, with files in a folder; the gauge says how much is held.
    pub fn new(folder: PathBuf, most: u64, gauge: Gauge) -> Arc<Self> {
        gauge.set(0.0);
        Arc::new(Self { folder, most, held: AtomicU64::new(0), gauge })
    }

    /// Receives the body of a request, up to a length.
    ///
    /// # Errors
    /// 413 over the length, 503 where there is no room, 408 when it arrives too slowly, 400 when it breaks off, 507 on a full
    /// disk.
    pub async fn receive(self: &Arc<Self>, request: Request, most: usize) -> Result<Request, Problem> {
        let too_long = || Problem::new(ProblemType::TooLarge, format!("the body is over the limit of {most} bytes"));
        let declared =
            request.headers().get(header::CONTENT_LENGTH).and_then(|value| value.to_str().ok()?.parse().ok());
        if declared.is_some_and(|bytes: u64| bytes > most as u64) {
            return Err(too_long());
        }
        if declared.is_some_and(|bytes| self.held.load(Ordering::Relaxed).saturating_add(bytes) > self.most) {
            return Err(self.full());
        }
        let (parts, body) = request.into_parts();
        let mut arriving = body.into_data_stream();
        let mut received = Received { held: Held { room: Arc::clone(self), bytes: 0 }, memory: Vec::new(), file: None };
        while let Some(bytes) = arriving.try_next().await.map_err(|error| broken_body(&error))? {
            if received.held.bytes + bytes.len() as u64 > most as u64 {
                return Err(too_long());
            }
            received.held.grow(bytes.len()).map_err(|()| self.full())?;
            received.memory.extend_from_slice(&bytes);
            if received.memory.len() >= IN_MEMORY {
                received = received.written().await.map_err(|error| not_written(&error))?;
            }
        }
        Ok(Request::from_parts(parts, received.into_body().await.map_err(|error| not_written(&error))?))
    }

    fn full(&self) -> Problem {
        let detail = format!(
            "as much is being uploaded as the service holds at the same time ({} MiB): try again in {RETRY_AFTER_S} s",
            self.most >> 20
        );
        Problem::new(ProblemType::Overloaded, detail).retry_after(RETRY_AFTER_S)
    }
}

fn not_written(error: &io::Error) -> Problem {
    if matches!(error.kind(), io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded) {
        return Problem::new(ProblemType::NoSpace, "the server is short of disk space").retry_after(60);
    }
    tracing::error!(%error, "a body could not be held on the disk");
    Problem::new(ProblemType::Internal, "the service failed: its log says why, under this request's id")
}

/// Bytes that count against the budget until this is dropped.
#[derive(Debug)]
struct Held {
    room: Arc<BodyRoom>,
    bytes: u64,
}

impl Held {
    fn grow(&mut self, bytes: usize) -> Result<(), ()> {
        let (bytes, most) = (bytes as u64, self.room.most);
        let grown = |held: u64| held.checked_add(bytes).filter(|held| *held <= most);
        self.room.held.fetch_update(Ordering::Relaxed, Ordering::Relaxed, grown).map_err(|_| ())?;
        self.room.gauge.increment(bytes as f64);
        self.bytes += bytes;
        Ok(())
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        self.room.held.fetch_sub(self.bytes, Ordering::Relaxed);
        self.room.gauge.decrement(self.bytes as f64);
    }
}

/// What has arrived of a body: the end in memory, what came before in the file.
#[derive(Debug)]
struct Received {
    held: Held,
    memory: Vec<u8>,
    file: Option<File>,
}

impl Received {
    /// The same with all of it in the file.
    async fn written(mut self) -> io::Result<Self> {
        off_the_runtime(move || {
            let mut file = match self.file.take() {
                Some(file) => file,
                None => tempfile::tempfile_in(&self.held.room.folder)?,
            };
            file.write_all(&self.memory)?;
            self.memory.clear();
            self.file = Some(file);
            Ok(self)
        })
        .await
    }

    async fn into_body(self) -> io::Result<Body> {
        if self.file.is_none() {
            return Ok(Body::from(self.memory));
        }
        let mut whole = self.written().await?;
        if let Some(file) = &mut whole.file {
            file.rewind()?;
        }
        Ok(Body::from_stream(futures::stream::try_unfold(whole, |mut whole| {
            off_the_runtime(move || {
                let Some(file) = &mut whole.file else { return Ok(None) };
                let mut bytes = Vec::with_capacity(IN_MEMORY);
                file.take(IN_MEMORY as u64).read_to_end(&mut bytes)?;
                Ok::<_, io::Error>((!bytes.is_empty()).then(|| (Bytes::from(bytes), whole)))
            })
        })))
    }
}

#[cfg(test)]
mod tests {
    use axum::body::to_bytes;

    use super::*;

    fn request(bytes: &[u8]) -> Request {
        Request::new(Body::from(bytes.to_vec()))
    }

    fn room(most: u64) -> (Arc<BodyRoom>, tempfile::TempDir) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        (BodyRoom::new(folder.path().to_owned(), most, Gauge::noop()), folder)
    }

    #[tokio::test]
    async fn a_body_is_the_same_from_memory_and_from_the_disk() {
        let (room, folder) = room(10 << 20);
        for length in [0, 1, IN_MEMORY - 1, IN_MEMORY, 5 * IN_MEMORY / 2] {
            let bytes: Vec<u8> = (0..length).map(|index| index as u8).collect();
            let received = room.receive(request(&bytes), 10 << 20).await.expect("there is room");
            assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 0, "no file has a name");
            assert_eq!(to_bytes(received.into_body(), usize::MAX).await.expect("is there"), bytes);
            assert_eq!(room.held.load(Ordering::Relaxed), 0, "and its room is free again");
        }
    }

    #[tokio::test]
    async fn what_is_too_long_or_finds_no_room_is_refused_and_holds_nothing() {
        let (room, _folder) = room(1_000);
        let refused = room.receive(request(&[0; 500]), 400).await.expect_err("is too long");
        assert_eq!(refused.kind(), ProblemType::TooLarge);
        let held = Held { room: Arc::clone(&room), bytes: 0 };
        let mut other = held;
        other.grow(800).expect("there is room");
        let refused = room.receive(request(&[0; 300]), 400).await.expect_err("there is no room");
        assert_eq!(refused.kind(), ProblemType::Overloaded);
        drop(other);
        assert_eq!(room.held.load(Ordering::Relaxed), 0);
        assert!(room.receive(request(&[0; 300]), 400).await.is_ok());
    }
}
