//! Cores of the machine that requests and jobs have for themselves.
//!
//! Where both share their cores, a request may wait until the system ends the time slice of a thread that computes: up to one
//! tick of its clock, 4 ms on most Linux machines, whatever the priorities of the threads are.

use std::num::NonZero;

#[cfg(target_os = "linux")]
use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity};

/// Why the cores cannot be split.
#[derive(Debug, thiserror::Error)]
pub enum CoreSplitError {
    /// Nothing would be left for jobs.
    #[error("--request-cores {requests}: this process may use {all} cores, and jobs need one of them at least")]
    TooFew {
        /// Cores asked for requests.
        requests: usize,
        /// Cores of the process.
        all: usize,
    },
    /// Threads cannot be bound to cores.
    #[error("--request-cores: this system does not bind threads to cores ({0}); leave it out")]
    Unsupported(std::io::Error),
}

/// The cores of jobs.
#[derive(Debug, Clone)]
pub struct JobCores {
    #[cfg(target_os = "linux")]
    set: CpuSet,
    count: NonZero<usize>,
}

impl JobCores {
    /// Binds the calling thread, and all that it starts from now on, to the first `requests` cores that the process may use,
    /// and answers the others.
    ///
    /// # Errors
    /// Where no core is left, or the system does not bind threads to cores.
    #[cfg(target_os = "linux")]
    pub fn beside_requests(requests: NonZero<usize>) -> Result<Self, CoreSplitError> {
        let unsupported = |error: rustix::io::Errno| CoreSplitError::Unsupported(error.into());
        let allowed = sched_getaffinity(None).map_err(unsupported)?;
        let cores: Vec<usize> = (0..CpuSet::MAX_CPU).filter(|&core| allowed.is_set(core)).collect();
        let requests = requests.get();
        let Some(count) = NonZero::new(cores.len().saturating_sub(requests)) else {
            return Err(CoreSplitError::TooFew { requests, all: cores.len() });
        };
        let set = |cores: &[usize]| {
            let mut set = CpuSet::new();
            for &core in cores {
                set.set(core);
            }
            set
        };
        let (of_requests, of_jobs) = cores.split_at(requests);
        sched_setaffinity(None, &set(of_requests)).map_err(unsupported)?;
        Ok(Self { set: set(of_jobs), count })
    }

    /// Elsewhere the system alone decides.
    ///
    /// # Errors
    /// Always.
    #[cfg(not(target_os = "linux"))]
    pub fn beside_requests(_: NonZero<usize>) -> Result<Self, CoreSplitError> {
        Err(CoreSplitError::Unsupported(std::io::ErrorKind::Unsupported.into()))
    }

    /// How many they are.
    #[must_use]
    pub fn count(&self) -> NonZero<usize> {
        self.count
    }

    /// Binds the calling thread to them.
    pub(crate) fn bind(&self) {
        #[cfg(target_os = "linux")]
        if let Err(error) = sched_setaffinity(None, &self.set) {
            tracing::warn!(%error, "jobs share the cores of requests");
        }
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    /// Cores that the calling thread may use.
    fn own_cores() -> Vec<usize> {
        let own = sched_getaffinity(None).expect("Linux tells");
        (0..CpuSet::MAX_CPU).filter(|&core| own.is_set(core)).collect()
    }

    #[test]
    fn requests_have_the_first_cores_and_jobs_the_others() {
        let all = own_cores();
        let Some(requests) = NonZero::new(all.len() - 1) else { return };
        // In a thread of its own: the binding stays with the thread.
        std::thread::spawn(move || {
            let jobs = JobCores::beside_requests(requests).expect("one is left");
            assert_eq!(own_cores(), all[..requests.get()]);
            assert_eq!(jobs.count().get(), 1);
            jobs.bind();
            assert_eq!(own_cores(), all[requests.get()..]);
        })
        .join()
        .expect("as asserted");
    }

    #[test]
    fn jobs_need_a_core() {
        let all = own_cores().len();
        let refused = JobCores::beside_requests(NonZero::new(all).expect("there is one")).expect_err("none is left");
        let expected =
            format!("--request-cores {all}: this process may use {all} cores, and jobs need one of them at least");
        assert_eq!((refused.to_string(), own_cores().len()), (expected, all));
    }
}
