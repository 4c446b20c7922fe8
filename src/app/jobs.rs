//! Analyses and the jobs that make them.

use std::collections::BTreeMap;
use std::time::Duration;

use stillage_core::AnalysisOptions;
use uuid::Uuid;

use super::{AnalysisRecord, AnalysisTicket, App, AppError, Caller, JobFilter, JobRecord, JobState};
use crate::jobs::processes::AnalysisProcess;
use crate::store::{Request, Retry, now};

/// How long the dismissal of a running job is waited for.
const DISMISSAL: Duration = Duration::from_secs(1);

/// Most records that one page holds.
const MAX_PAGE: u32 = 10_000;

impl App {
    /// Analyses again with other options; identical options answer the existing analysis. It is a proposal beside the one
    /// in force, which still answers, until it is activated: with [`Self::activate_analysis`], or at once.
    ///
    /// Human decisions belong to the analysis whose categories they name. When another one comes into force on which nobody
    /// decided, they are carried over to it; going back to an earlier one brings its decisions back.
    pub async fn create_analysis(
        &self,
        caller: &Caller,
        map: Uuid,
        options: AnalysisOptions,
        activate: bool,
    ) -> Result<AnalysisTicket, AppError> {
        options.clone().check()?;
        let record = self.map(caller, map).await?;
        self.check_memory(u64::from(record.width), u64::from(record.height), &options)?;
        let source =
            self.store.map_source(caller.tenant(), map).await?.ok_or_else(|| AppError::not_found("map", map))?;
        let job = AnalysisProcess::job(map, &source, &options, activate);
        let capacity = self.capacity();
        let request = self.store.request_analysis(caller.tenant(), &options, &job, &capacity, now()).await?;
        match request {
            None => Err(AppError::not_found("map", map)),
            Some(Request::Full(full)) => Err(self.refusal(full)),
            Some(Request::Pending(job)) => Ok(AnalysisTicket::Job(Box::new(job))),
            Some(Request::New(job)) => {
                self.signals.queued();
                Ok(AnalysisTicket::Job(Box::new(job)))
            }
            Some(Request::Existing(analysis)) => Ok(AnalysisTicket::Existing(analysis)),
        }
    }

    /// Puts an analysis in force, and carries over what people decided before.
    pub async fn activate_analysis(
        &self,
        caller: &Caller,
        map: Uuid,
        analysis: Uuid,
    ) -> Result<AnalysisRecord, AppError> {
        let missing = || AppError::not_found("analysis by this version of the algorithms", analysis);
        let found = self.analyses(caller, map).await?.into_iter().find(|record| record.id == analysis);
        let record = found.ok_or_else(missing)?;
        if !self.store.activate(caller.tenant(), map, analysis, now()).await? {
            return Err(missing());
        }
        self.context(caller, map).await?;
        Ok(record)
    }

    /// The analyses of a map, newest first.
    pub async fn analyses(&self, caller: &Caller, map: Uuid) -> Result<Vec<AnalysisRecord>, AppError> {
        self.map(caller, map).await?;
        Ok(self.store.analyses(caller.tenant(), map).await?)
    }

    /// Jobs, newest first.
    pub async fn jobs(&self, caller: &Caller, mut filter: JobFilter) -> Result<Vec<JobRecord>, AppError> {
        filter.limit = filter.limit.min(MAX_PAGE);
        Ok(self.store.jobs(caller.tenant(), &filter).await?)
    }

    /// A job.
    pub async fn job(&self, caller: &Caller, id: Uuid) -> Result<JobRecord, AppError> {
        self.store.job(caller.tenant(), id).await?.ok_or_else(|| AppError::not_found("job", id))
    }

    /// Dismisses: queued at once, running within a second (which is waited for). A finished job is a conflict.
    pub async fn dismiss_job(&self, caller: &Caller, id: Uuid) -> Result<JobRecord, AppError> {
        let before = self.job(caller, id).await?;
        if before.state.is_final() {
            return Err(AppError::Conflict(format!("the job is {} already", before.state.name())));
        }
        self.store.dismiss(caller.tenant(), id, now()).await?.ok_or_else(|| AppError::not_found("job", id))?;
        self.signals.changed();
        self.job_within(caller, id, DISMISSAL).await
    }

    /// Runs a job that failed or was dismissed once more.
    pub async fn retry_job(&self, caller: &Caller, id: Uuid) -> Result<JobRecord, AppError> {
        let retry = self.store.retry(caller.tenant(), id, &self.capacity(), now()).await?;
        match retry.ok_or_else(|| AppError::not_found("job", id))? {
            Retry::Queued(job) => {
                self.signals.queued();
                Ok(*job)
            }
            Retry::NotOver(job) => Err(AppError::Conflict(format!(
                "the job is {}: only a job that failed or was dismissed runs once more",
                job.state.name()
            ))),
            Retry::Superseded => {
                Err(AppError::Conflict("another job has made the same analysis, or is about to".to_owned()))
            }
            Retry::Full(full) => Err(self.refusal(full)),
        }
    }

    /// The job once it is over, or as it is after a time.
    pub async fn job_within(&self, caller: &Caller, id: Uuid, patience: Duration) -> Result<JobRecord, AppError> {
        let mut changes = self.signals.changes();
        let over = async {
            loop {
                let job = self.job(caller, id).await?;
                if job.state.is_final() || self.is_stopping() || changes.changed().await.is_err() {
                    return Ok(job);
                }
            }
        };
        match tokio::time::timeout(patience, over).await {
            Ok(job) => job,
            Err(_) => self.job(caller, id).await,
        }
    }

    /// Counts of the jobs of all tenants by state, for the metrics.
    pub async fn job_counts(&self) -> Result<BTreeMap<&'static str, u64>, AppError> {
        let mut counts: BTreeMap<_, _> = JobState::ALL.iter().map(|state| (state.name(), 0)).collect();
        for (state, jobs) in self.store.job_counts().await? {
            counts.insert(state.name(), jobs);
        }
        Ok(counts)
    }
}
