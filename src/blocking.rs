//! Where computations of requests run.

/// Runs what takes longer than a moment beside the runtime's threads, so that other requests are answered meanwhile. A
/// panic of the work goes on in the caller. What it logs has the ids of the caller.
pub async fn off_the_runtime<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> T {
    let span = tracing::Span::current();
    match tokio::task::spawn_blocking(move || span.in_scope(work)).await {
        Ok(result) => result,
        Err(failed) => std::panic::resume_unwind(failed.into_panic()),
    }
}
