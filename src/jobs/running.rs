//! The life of one claimed job, from the claim to its end.

use std::sync::Arc;
use std::time::{Duration, Instant};

use stillage_core::StopFlag;
use tokio::sync::oneshot;
use tokio::time::MissedTickBehavior;

use super::compute::{ComputePool, Task};
use super::job_counts::AttemptEnd;
use super::processes::{ComputeError, Process};
use super::retry::backoff;
use super::shared::Shared;
use crate::fail_point;
use crate::records::JobState;
use crate::stage_clock::StageClock;
use crate::store::queue::{Claim, JobResult, Progress};
use crate::store::{Blob, StoreError};

/// How long a computation may take to notice its stop flag when the service ends.
const LAST_MOMENTS: Duration = Duration::from_secs(1);

/// A job in progress.
pub(super) struct Running<'a> {
    shared: &'a Shared,
    claim: Claim,
    clock: Arc<StageClock>,
    stop: StopFlag,
    began: Instant,
    /// What the row says, and since when.
    written: Progress,
    renewed: Instant,
}

impl<'a> Running<'a> {
    pub(super) fn new(shared: &'a Shared, claim: Claim) -> Self {
        let clock = Arc::new(StageClock::new());
        let (stop, written) = (StopFlag::default(), Progress::default());
        let now = Instant::now();
        Self { shared, claim, clock, stop, began: now, written, renewed: now }
    }

    /// Sees the job to its end. An error means that its end could not be written; the lease will bring it back.
    pub(super) async fn run(mut self, pool: &ComputePool) -> Result<(), StoreError> {
        tracing::info!("job begun");
        self.shared.counts.begun();
        fail_point::pass("before-compute");
        let process = match self.shared.processes.find(&self.claim.process) {
            Ok(process) => Arc::clone(process),
            Err(message) => return self.end(JobState::Failed, &message).await,
        };
        let source = match self.shared.store.blobs().get(&self.claim.source).await {
            Ok(source) => source,
            Err(error) => return self.end_with_fault(error).await,
        };
        let Some(result) = self.compute(pool, process, source).await? else { return Ok(()) };
        match result {
            Ok(made) => match self.store_result(&made).await {
                // Cancelled in the last moment, or lost to another claim: then this changes nothing.
                Err(StoreError::ClaimLost) => self.dismiss().await,
                Err(error) => self.end_with_fault(error).await,
                Ok(()) => Ok(()),
            },
            Err(error) => self.fail(&error).await,
        }
    }

    /// Computes under the heartbeat. `None` when the job was taken out of this worker's hands; its row is settled then.
    async fn compute(
        &mut self,
        pool: &ComputePool,
        process: Arc<dyn Process>,
        source: Blob,
    ) -> Result<Option<Result<JobResult, ComputeError>>, StoreError> {
        let inputs = self.claim.inputs.clone();
        let mut result =
            pool.start(Task { process, inputs, source, stop: self.stop.clone(), clock: Arc::clone(&self.clock) });
        let heartbeat = self.shared.settings.heartbeat;
        let mut ticks = tokio::time::interval_at(tokio::time::Instant::now() + heartbeat, heartbeat);
        ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        loop {
            tokio::select! {
                result = &mut result => return Ok(Some(received(&self.claim.process, result))),
                _ = ticks.tick() => match self.heartbeat().await {
                    Ok(false) => {}
                    Ok(true) => {
                        self.stop.raise();
                        let dismissed = self.dismiss().await;
                        self.drain(result).await;
                        return dismissed.map(|()| None);
                    }
                    Err(_) => {
                        self.count(AttemptEnd::Lost);
                        self.drain(result).await;
                        return Ok(None);
                    }
                },
                () = self.shared.grace_is_over() => {
                    let requeued = self.give_back().await;
                    self.drain(result).await;
                    return requeued.map(|()| None);
                }
            }
        }
    }

    /// Tells the store where the job is, when that changed or the lease wants renewing; otherwise only asks whether it
    /// is to be cancelled. An error means that the claim is lost.
    async fn heartbeat(&mut self) -> Result<bool, StoreError> {
        let lease = self.shared.settings.lease;
        let progress = Progress {
            percent: self.clock.percent(),
            stage: self.clock.stage().map(|stage| stage.name().to_owned()),
            stages: self.clock.reports(),
        };
        let is_due = progress != self.written || self.renewed.elapsed() >= lease / 3;
        let answer = if is_due {
            self.renew(&progress, lease).await
        } else {
            self.shared.store.is_cancel_requested(&self.claim).await
        };
        match answer {
            Ok(cancel) => {
                if is_due {
                    self.written = progress;
                    self.renewed = Instant::now();
                    self.shared.signals.changed();
                }
                Ok(cancel)
            }
            // A store that is out of reach for a while is no reason to throw work away, as long as the lease holds.
            Err(error) if error.is_transient() && self.renewed.elapsed() < lease => {
                tracing::warn!(%error, "heartbeat failed");
                Ok(false)
            }
            Err(error) => {
                tracing::warn!(%error, "the job was taken away");
                Err(error)
            }
        }
    }

    async fn renew(&self, progress: &Progress, lease: Duration) -> Result<bool, StoreError> {
        let (now, _) = self.shared.now().await?;
        self.shared.store.heartbeat(&self.claim, progress, lease, now).await
    }

    /// Waits until the computation has let go of the pool, but not beyond the end of the service.
    async fn drain(&self, result: oneshot::Receiver<Result<JobResult, ComputeError>>) {
        self.stop.raise();
        tokio::select! {
            _ = result => {}
            () = async {
                self.shared.grace_is_over().await;
                tokio::time::sleep(LAST_MOMENTS).await;
            } => tracing::warn!("the computation did not stop in time"),
        }
    }

    /// Stores the blob, then commits the result with the end of the job.
    async fn store_result(&self, made: &JobResult) -> Result<(), StoreError> {
        let store = &self.shared.store;
        let stages = self.clock.reports();
        store.finish(&self.claim, made, &stages, store.clock().await?).await?;
        self.count(AttemptEnd::Job(JobState::Successful));
        self.shared.counts.stages(&stages);
        tracing::info!(seconds = self.began.elapsed().as_secs_f64(), "job finished");
        self.shared.signals.changed();
        Ok(())
    }

    async fn fail(&self, error: &ComputeError) -> Result<(), StoreError> {
        self.end(JobState::Failed, &error.to_string()).await
    }

    /// After a fault that may pass, the job waits and is tried again; any other, or the last attempt, ends it.
    async fn end_with_fault(&self, error: StoreError) -> Result<(), StoreError> {
        let most = self.shared.settings.max_attempts;
        let attempt = self.claim.attempt;
        if !error.is_transient() {
            return self.end(JobState::Failed, &error.to_string()).await;
        }
        if attempt >= most {
            return self.end(JobState::Failed, &format!("given up after {attempt} attempts: {error}")).await;
        }
        let wait = backoff(self.claim.job, attempt);
        let message = format!("attempt {attempt} of {most} failed: {error}");
        tracing::warn!(?wait, %error, "job will be tried again");
        self.requeue(attempt, wait, &message, AttemptEnd::Requeued).await
    }

    /// Puts the job back as if this attempt had not been: the service was asked to stop.
    async fn give_back(&self) -> Result<(), StoreError> {
        let attempt = self.claim.attempt.saturating_sub(1);
        let message = "put back because the service was stopped";
        tracing::info!(message);
        self.requeue(attempt, Duration::ZERO, message, AttemptEnd::GivenBack).await
    }

    async fn requeue(&self, attempt: u32, wait: Duration, message: &str, end: AttemptEnd) -> Result<(), StoreError> {
        let store = &self.shared.store;
        let requeued = store.requeue(&self.claim, attempt, wait, message, store.clock().await?).await;
        self.settled(requeued, end)
    }

    async fn dismiss(&self) -> Result<(), StoreError> {
        self.end(JobState::Dismissed, "dismissed").await
    }

    async fn end(&self, state: JobState, message: &str) -> Result<(), StoreError> {
        tracing::info!(state = state.name(), reason = message, "job ended");
        let store = &self.shared.store;
        let ended = store.end(&self.claim, state, message, store.clock().await?).await;
        self.settled(ended, AttemptEnd::Job(state))
    }

    /// A claim that was lost is settled as well: by somebody else.
    fn settled(&self, outcome: Result<(), StoreError>, end: AttemptEnd) -> Result<(), StoreError> {
        self.shared.signals.changed();
        match outcome {
            Err(StoreError::ClaimLost) => self.count(AttemptEnd::Lost),
            Ok(()) => self.count(end),
            Err(error) => return Err(error),
        }
        Ok(())
    }

    fn count(&self, end: AttemptEnd) {
        self.shared.counts.ended(end, self.began.elapsed());
    }
}

fn received(
    process: &str,
    result: Result<Result<JobResult, ComputeError>, oneshot::error::RecvError>,
) -> Result<JobResult, ComputeError> {
    result.unwrap_or_else(|_| {
        Err(ComputeError::Panicked { process: process.to_owned(), panic: "the computation vanished".to_owned() })
    })
}
