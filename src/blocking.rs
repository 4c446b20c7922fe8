//! Where computations of requests run.

/// Runs what takes longer than a moment beside the runtime's threads, so that other requests are answered meanwhile. A
/// panic of the work goes on in the caller.
pub async fn off_the_runtime<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> T {
    match tokio::task::spawn_blocking(work).await {
        Ok(result) => result,
        Err(failed) => std::panic::resume_unwind(failed.into_panic()),
    }
}
