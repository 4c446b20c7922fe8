//! The answer to a connection for which there is no place.

use std::sync::Arc;
use std::time::Duration;

use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;
use tokio::sync::Semaphore;

/// Connections that are refused with an answer at the same time; further ones are closed without.
const MOST: usize = 64;
/// Longest time in which the refusal is taken.
const PATIENCE: Duration = Duration::from_secs(1);

/// The refusal: 503, to come back after a second.
const ANSWER: &str = concat!(
    "HTTP/1.1 503 Service Unavailable\r\ncontent-type: application/problem+json\r\nretry-after: 1\r\n",
    "connection: close\r\ncontent-length: 151\r\n\r\n",
    r#"{"type":"/problems/overloaded","title":"The service has as much to do as it can","status":503,"#,
    r#""detail":"all connections are at work: try again in 1 s"}"#
);

/// Refuses connections.
#[derive(Debug, Clone)]
pub(super) struct Refusals(Arc<Semaphore>);

impl Refusals {
    pub(super) fn new() -> Self {
        Self(Arc::new(Semaphore::new(MOST)))
    }

    /// Refuses a connection beside the calling task.
    pub(super) fn refuse(&self, mut stream: TcpStream) {
        let Ok(permit) = Arc::clone(&self.0).try_acquire_owned() else { return };
        tokio::spawn(async move {
            let answered = async {
                stream.write_all(ANSWER.as_bytes()).await?;
                stream.shutdown().await?;
                // A connection that is closed with something unread is reset, and the answer with it.
                while stream.read(&mut [0; 4_096]).await? > 0 {}
                Ok::<_, std::io::Error>(())
            };
            let _ = tokio::time::timeout(PATIENCE, answered).await;
            drop(permit);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::ANSWER;

    #[test]
    fn the_refusal_is_as_long_as_it_says() {
        let (head, body) = ANSWER.split_once("\r\n\r\n").expect("head and body");
        assert!(head.ends_with(&format!("content-length: {}", body.len())), "{}", body.len());
        assert!(serde_json::from_str::<serde_json::Value>(body).is_ok());
    }
}
