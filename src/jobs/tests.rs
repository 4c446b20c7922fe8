//! The worker on a real store, with a computation that does what the upload says.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use stillage_core::watch::Stage;
use stillage_core::{AnalysisOptions, Watch};
use uuid::Uuid;

use super::processes::{ComputeError, Process, ProcessDescription, Processes, Work};
use super::*;
use crate::config::Config;
use crate::ingest::{IngestError, MapSource, Refusal};
use crate::records::{JobRecord, JobState};
use crate::store::contract::{Fixture, PROCESS, TERMS, local, upload};
use crate::store::queue::JobResult;
use crate::store::{Blob, NewAnalysis, Store, now};

/// Obeys the text of the upload: `fine`, `bad map`, `panic`, or `endless` until it is stopped.
#[derive(Debug, Default)]
struct Script {
    begun: AtomicUsize,
}

impl Process for Script {
    fn description(&self) -> &ProcessDescription {
        &ProcessDescription { id: PROCESS, title: "Test", description: "", version: 1, inputs: &[], outputs: &[] }
    }

    fn compute(&self, work: &Work<'_>, watch: &Watch<'_>) -> Result<JobResult, ComputeError> {
        let MapSource::Message(text) = work.source else { panic!("tests upload messages") };
        self.begun.fetch_add(1, Ordering::Relaxed);
        assert!(rayon::current_thread_index().is_some(), "on a compute thread");
        watch.progress(Stage::Features, 0.5);
        match text.as_slice() {
            b"panic" => panic!("index out of bounds"),
            b"bad map" => Err(IngestError {
                refusal: Refusal::Invalid,
                pointer: "/data".into(),
                message: "12 cells expected, 3 found".into(),
            })?,
            b"endless" => loop {
                watch.check()?;
                std::thread::sleep(Duration::from_millis(5));
            },
            _ => {
                let options = AnalysisOptions::default();
                let analysis = NewAnalysis { id: Uuid::now_v7(), options, diagnostics: Vec::new() };
                Ok(JobResult::Analysis(Box::new(analysis), Blob::new(text.clone())))
            }
        }
    }
}

struct Service {
    store: Arc<dyn Store>,
    worker: Arc<Worker>,
    signals: Arc<Signals>,
    script: Arc<Script>,
}

/// A worker with this many slots, which knows the scripted process.
async fn service(fixture: &Fixture, job_slots: usize) -> Service {
    let script = Arc::new(Script::default());
    let processes = Processes::new([Arc::clone(&script) as Arc<dyn Process>]);
    service_of(fixture, job_slots, script, processes).await
}

async fn service_of(fixture: &Fixture, job_slots: usize, script: Arc<Script>, processes: Processes) -> Service {
    let config =
        Config { job_slots, compute_threads: 2, heartbeat: Duration::from_millis(50), ..fixture.config.clone() };
    let store: Arc<dyn Store> = fixture.open().await;
    let signals = Arc::new(Signals::default());
    let worker = Worker::start(&config, Arc::clone(&store), processes, Arc::clone(&signals), Arc::default());
    Service { store, worker, signals, script }
}

impl Service {
    async fn job(&self, id: Uuid) -> JobRecord {
        self.store.job(&local(), id).await.unwrap().expect("the job is there")
    }

    /// Waits for a job to be as wanted, woken by the signal that clients get.
    async fn wait_for(&self, id: Uuid, wanted: impl Fn(&JobRecord) -> bool) -> JobRecord {
        let mut changes = self.signals.changes();
        let wait = async {
            loop {
                let job = self.job(id).await;
                if wanted(&job) {
                    return job;
                }
                changes.changed().await.expect("the signals live");
            }
        };
        tokio::time::timeout(Duration::from_secs(20), wait).await.expect("it comes about")
    }
}

#[tokio::test]
async fn a_job_runs_to_its_end() {
    let fixture = Fixture::new();
    let service = service(&fixture, 0).await;
    let job = upload(&service.store, "fine").await;
    service.worker.run_until_empty().await.unwrap();
    let job = service.job(job.id).await;
    assert_eq!((job.state, job.progress, job.attempt), (JobState::Successful, 100, 1));
    assert_eq!(service.store.map(&local(), job.map).await.unwrap().unwrap().analysis, job.analysis());
    assert!(job.started.is_some() && job.finished.is_some());
}

#[tokio::test]
async fn a_panic_is_the_failure_of_its_job_and_of_nothing_else() {
    let fixture = Fixture::new();
    let service = service(&fixture, 0).await;
    let (broken, fine) = (upload(&service.store, "panic").await, upload(&service.store, "fine").await);
    service.worker.run_until_empty().await.unwrap();
    let broken = service.job(broken.id).await;
    assert_eq!((broken.state, broken.attempt), (JobState::Failed, 1), "not tried again");
    assert_eq!(
        broken.message,
        "the process test hit a defect of the program (index out of bounds); other jobs are not affected"
    );
    assert_eq!(service.job(fine.id).await.state, JobState::Successful);
}

#[tokio::test]
async fn a_bad_map_fails_at_once() {
    let fixture = Fixture::new();
    let service = service(&fixture, 0).await;
    let job = upload(&service.store, "bad map").await;
    service.worker.run_until_empty().await.unwrap();
    let job = service.job(job.id).await;
    assert_eq!((job.state, job.attempt), (JobState::Failed, 1));
    assert_eq!(job.message, "the map cannot be read: 12 cells expected, 3 found");
}

#[tokio::test]
async fn a_job_of_an_unknown_process_fails_at_once() {
    let fixture = Fixture::new();
    let processes = Processes::standard(fixture.config.limits);
    let service = service_of(&fixture, 0, Arc::default(), processes).await;
    let job = upload(&service.store, "fine").await;
    service.worker.run_until_empty().await.unwrap();
    let job = service.job(job.id).await;
    assert_eq!((job.state, job.attempt), (JobState::Failed, 1));
    assert_eq!(job.message, "there is no process test: this release has semantic-map");
}

#[tokio::test]
async fn a_damaged_upload_is_never_computed_on() {
    let fixture = Fixture::new();
    let service = service(&fixture, 0).await;
    let job = upload(&service.store, "fine").await;
    let source = service.store.map_source(&local(), job.map).await.unwrap().unwrap();
    let file = fixture.blob_file(&source);
    std::fs::write(file, "something else").unwrap();
    service.worker.run_until_empty().await.unwrap();
    let job = service.job(job.id).await;
    assert_eq!(job.state, JobState::Failed);
    assert!(job.message.ends_with("is damaged: its bytes do not have its hash"), "{}", job.message);
    assert_eq!(service.script.begun.load(Ordering::Relaxed), 0);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_running_job_is_cancelled_within_a_second() {
    let fixture = Fixture::new();
    let service = service(&fixture, 1).await;
    let job = upload(&service.store, "endless").await;
    service.signals.queued();
    service.wait_for(job.id, |job| job.progress > 0).await;
    let begun = Instant::now();
    service.store.dismiss(&local(), job.id, now()).await.unwrap();
    service.wait_for(job.id, |job| job.state == JobState::Dismissed).await;
    assert!(begun.elapsed() < Duration::from_secs(1), "{:?}", begun.elapsed());

    let next = upload(&service.store, "fine").await;
    service.signals.queued();
    service.wait_for(next.id, |job| job.state == JobState::Successful).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_of_a_hidden_map_stops_and_begins_anew_when_it_is_restored() {
    let fixture = Fixture::new();
    let service = service(&fixture, 1).await;
    let job = upload(&service.store, "endless").await;
    service.signals.queued();
    service.wait_for(job.id, |job| job.state == JobState::Running).await;
    service.store.hide_map(&local(), job.map, None, now()).await.unwrap();
    let next = upload(&service.store, "fine").await;
    service.signals.queued();
    service.wait_for(next.id, |job| job.state == JobState::Successful).await;
    service.store.restore_map(&local(), job.map, jiff::Timestamp::MIN, now()).await.unwrap().expect("it is hidden");
    service.signals.queued();
    service.wait_for(job.id, |job| job.state == JobState::Running).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_of_a_deleted_map_stops() {
    let fixture = Fixture::new();
    let service = service(&fixture, 1).await;
    let job = upload(&service.store, "endless").await;
    service.signals.queued();
    service.wait_for(job.id, |job| job.state == JobState::Running).await;
    service.store.delete_map(&local(), job.map, None).await.unwrap();
    let next = upload(&service.store, "fine").await;
    service.signals.queued();
    service.wait_for(next.id, |job| job.state == JobState::Successful).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn stopping_puts_the_job_back_without_counting_the_attempt() {
    let fixture = Fixture::new();
    let service = service(&fixture, 1).await;
    let job = upload(&service.store, "endless").await;
    service.signals.queued();
    service.wait_for(job.id, |job| job.state == JobState::Running).await;
    let begun = Instant::now();
    service.worker.stop(Duration::from_millis(200)).await;
    assert!(begun.elapsed() >= Duration::from_millis(200), "it had its grace");
    let job = service.job(job.id).await;
    assert_eq!((job.state, job.attempt), (JobState::Accepted, 0));
    assert_eq!(job.message, "put back because the service was stopped");
}

#[tokio::test(flavor = "multi_thread")]
async fn stopping_lets_a_short_job_end() {
    let fixture = Fixture::new();
    let service = service(&fixture, 1).await;
    let job = upload(&service.store, "fine").await;
    service.signals.queued();
    service.wait_for(job.id, |job| job.state != JobState::Accepted).await;
    service.worker.stop(Duration::from_secs(10)).await;
    assert_eq!(service.job(job.id).await.state, JobState::Successful);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_fault_of_the_disk_is_tried_again_later() {
    let fixture = Fixture::new();
    let service = service(&fixture, 0).await;
    let job = upload(&service.store, "fine").await;
    // The result cannot be written: a file stands where its folder should be.
    let blob = Blob::new("fine".as_bytes());
    let file = fixture.blob_file(blob.id());
    let folder = file.parent().unwrap();
    std::fs::write(folder, "in the way").unwrap();
    service.worker.run_until_empty().await.unwrap();
    let waiting = service.job(job.id).await;
    assert_eq!((waiting.state, waiting.attempt), (JobState::Accepted, 1));
    assert!(waiting.message.starts_with("attempt 1 of 5 failed: blob storage: "), "{}", waiting.message);

    std::fs::remove_file(folder).unwrap();
    let due = now() + jiff::SignedDuration::from_secs(7);
    let again = service.store.claim(&TERMS, due).await.unwrap().expect("it is due within seven seconds");
    assert_eq!((again.job, again.attempt), (job.id, 2));
}

#[tokio::test(flavor = "multi_thread")]
async fn slots_share_the_work_and_every_job_runs_once() {
    let fixture = Fixture::new();
    let service = service(&fixture, 3).await;
    let mut jobs = Vec::new();
    for _ in 0..30 {
        jobs.push(upload(&service.store, "fine").await.id);
        service.signals.queued();
    }
    for job in jobs {
        let job = service.wait_for(job, |job| job.state.is_final()).await;
        assert_eq!((job.state, job.attempt), (JobState::Successful, 1));
    }
    assert_eq!(service.script.begun.load(Ordering::Relaxed), 30);
}
