//! The figures that operators read.

use std::sync::Arc;

use super::{App, AppError};
use crate::config::Role;
use crate::measures::{
    BUILD_INFO, DATABASE_BUSY, DATABASE_LOG, DATABASE_UP, DISK_FREE, JOB_RESCUES, JOBS, JOBS_OLDEST, Measures,
};
use crate::records::JobState;
use crate::store::{busy_calls, now, rescued_jobs};

impl App {
    /// What is counted in this process.
    #[must_use]
    pub const fn measures(&self) -> &Arc<Measures> {
        &self.measures
    }

    /// All metrics in the text format of Prometheus. They are there without the database, too: its figures are NaN then.
    pub async fn metrics_text(&self) -> String {
        let measures = &self.measures;
        let role = match self.config.role {
            Role::All => "all",
            Role::Api => "api",
            Role::Worker => "worker",
        };
        let database = if self.store.is_shared() { "postgres" } else { "sqlite" };
        let build = [("version", env!("CARGO_PKG_VERSION")), ("role", role), ("database", database)];
        measures.gauge(BUILD_INFO, &build).set(1.0);
        let jobs = self.measure_jobs().await;
        measures.gauge(DATABASE_UP, &[]).set(f64::from(u8::from(jobs.is_ok())));
        if jobs.is_err() {
            for state in JobState::ALL {
                measures.gauge(JOBS, &[("state", state.name())]).set(f64::NAN);
            }
            measures.gauge(JOBS_OLDEST, &[]).set(f64::NAN);
        }
        if let Ok(disk) = self.store.disk_use() {
            for (name, bytes) in [(DISK_FREE, disk.free_bytes), (DATABASE_LOG, disk.log_bytes)] {
                if let Some(bytes) = bytes {
                    measures.gauge(name, &[]).set(bytes as f64);
                }
            }
        }
        measures.counter(DATABASE_BUSY, &[]).absolute(busy_calls());
        measures.counter(JOB_RESCUES, &[]).absolute(rescued_jobs());
        measures.render()
    }

    async fn measure_jobs(&self) -> Result<(), AppError> {
        for (state, count) in self.job_counts().await? {
            self.measures.gauge(JOBS, &[("state", state)]).set(count as f64);
        }
        let oldest = self.store.oldest_waiting().await?;
        let age = oldest.map_or(0.0, |created| (now() - created).total(jiff::Unit::Second).unwrap_or(0.0));
        self.measures.gauge(JOBS_OLDEST, &[]).set(age.max(0.0));
        Ok(())
    }
}
