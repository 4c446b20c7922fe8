//! A data folder that an earlier release wrote is opened, and everything is there.
//!
//! `data-0.1` holds what release 0.1 left when it was killed: a map with two analyses (seed 1, in force, with two human
//! decisions; seed 9), an own rule set, two idempotency keys, and a job in each of the states running, waiting and
//! dismissed.

use std::path::Path;
use std::sync::Arc;

use stillage::app::{App, AppError, Caller, JobFilter, JobRecord, JobState, MapPatch};
use stillage::config::Config;
use stillage::coordinates::Georeference;
use stillage::records::Tenant;
use stillage::store::{self, Capacity, Full, IdempotencyKey, Quotas, Upload};
use stillage_core::AnalysisOptions;
use stillage_core::spec::VehicleWidth;
use tempfile::TempDir;

/// A copy of the old folder.
fn old_folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/upgrade/data-0.1"), folder.path());
    folder
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("a folder can be made");
    for entry in std::fs::read_dir(from).expect("the folder is there") {
        let entry = entry.expect("an entry");
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).expect("it can be copied");
        }
    }
}

fn config(folder: &TempDir) -> Config {
    Config { min_free_bytes: 0, job_slots: 0, ..Config::new(folder.path()) }
}

async fn open(folder: &TempDir) -> (Arc<App>, Caller) {
    (App::open(config(folder)).await.expect("the folder is upgraded"), Caller::local())
}

async fn jobs(app: &App, me: &Caller) -> Vec<JobRecord> {
    let mut jobs = app.jobs(me, JobFilter { limit: 99, ..JobFilter::default() }).await.expect("a list of jobs");
    jobs.reverse();
    jobs
}

#[tokio::test]
async fn maps_analyses_and_labels_are_there() {
    let folder = old_folder();
    let (app, me) = open(&folder).await;
    let maps = app.maps(&me, 99, None).await.expect("a list of maps");
    let names: Vec<&str> = maps.iter().map(|map| map.name.as_str()).collect();
    assert_eq!(names, ["Waiting", "Dismissed", "Interrupted", "Hall, first floor"]);
    let hall = &maps[3];
    assert_eq!((hall.width, hall.height, hall.resolution, hall.version), (20, 12, 0.5, 5));
    assert_eq!(hall.georeference, Some(Georeference { lon: 12.86, lat: 56.66, heading: 10.0 }));

    // That release read maps otherwise, so its analysis in force is made again, with the options that it had. What a
    // person decided about the old one is kept with it.
    let stale = app.context(&me, hall.id).await;
    assert!(matches!(stale, Err(AppError::NotAnalysed { .. })), "{:?}", stale.err());

    let versions = app.semantics_versions(&me, hall.id).await.expect("a list of versions");
    let versions: Vec<_> = versions.iter().map(|made| (made.version, made.rule_set.as_str())).collect();
    assert_eq!(versions, [(2, "clinic"), (1, "warehouse")]);
    let seeds: Vec<u64> = app.analyses(&me, hall.id).await.unwrap().iter().map(|made| made.options.seed).collect();
    assert_eq!(seeds, [9, 1]);

    let rule_sets = app.rule_sets(&me).await.expect("a list of rule sets");
    assert_eq!(
        rule_sets.iter().map(|record| record.id.as_str()).collect::<Vec<_>>(),
        ["site", "warehouse", "office", "clinic"]
    );
    let other = Caller::of(Tenant::new("other"));
    assert!(
        matches!(app.map(&other, hall.id).await, Err(AppError::NotFound { .. })),
        "all of it is the local tenant's"
    );
}

#[tokio::test]
async fn jobs_are_there_and_those_not_done_are_done() {
    let folder = old_folder();
    let (app, me) = open(&folder).await;
    let before = jobs(&app, &me).await;
    let states: Vec<JobState> = before.iter().map(|job| job.state).collect();
    let done = [JobState::Successful, JobState::Successful];
    assert_eq!(states[..2], done);
    let waiting = JobState::Accepted;
    assert_eq!(states[2..], [waiting, JobState::Dismissed, waiting, waiting], "one was cut off, one is made again");
    assert_eq!(before[5].map, before[0].map, "the hall");
    assert!(before.iter().all(|job| job.process == "semantic-map" && job.inputs["options"]["seed"].is_u64()));
    assert_eq!(before[0].analysis(), app.map(&me, before[0].map).await.expect("the hall").analysis);
    assert_eq!(before[2].message, "attempt 1 of 5 was cut off");

    // The interrupted map is a big one: it is dismissed here, so that only the waiting one is computed.
    app.dismiss_job(&me, before[2].id).await.expect("it waits");
    app.run_until_empty().await.expect("the queue empties");
    let waiting = app.job(&me, before[4].id).await.expect("it is there");
    assert_eq!(waiting.state, JobState::Successful, "{}", waiting.message);
    app.context(&me, waiting.map).await.expect("it answers");
    let hall = app.context(&me, before[5].map).await.expect("it answers again");
    let mut options = AnalysisOptions::default();
    options.decomposition.vehicle_width_m = VehicleWidth::Fixed(1.7);
    assert_eq!((&hall.analysis.options, hall.cells.faces.len()), (&options, 240));
    let labels = &hall.semantics;
    let from = labels.carried.as_ref().map(|carried| carried.from);
    assert_eq!((labels.version, labels.rule_set.as_str(), from), (3, "clinic", Some(2)), "the labels of the old one");
    let seeds: Vec<u64> =
        app.analyses(&me, before[5].map).await.unwrap().iter().map(|made| made.options.seed).collect();
    assert_eq!(seeds, [1, 9, 1], "the old ones are there");
    let patch = MapPatch { name: Some("Done".into()), georeference: None };
    app.update_map(&me, waiting.map, patch, None).await.expect("and can be changed");
}

#[tokio::test]
async fn idempotency_keys_are_remembered() {
    let folder = old_folder();
    let store = store::open(&config(&folder)).await.expect("the folder is upgraded");
    assert_eq!(store.schema_version().await.expect("it answers"), 11);
    let jobs = store.jobs(&Tenant::local(), &JobFilter { limit: 99, ..JobFilter::default() }).await.expect("jobs");
    for (key, job) in [("upload-1", &jobs[4]), ("upload-2", &jobs[0])] {
        let key = IdempotencyKey { key: key.into(), content: String::new() };
        let seen = store.seen_upload(&Tenant::local(), &key, job.created).await.expect("it answers");
        assert_eq!(seen, Some(Upload::KeyReused), "the key is known, with other content than none");
    }
}

#[tokio::test]
async fn what_is_stored_counts_to_the_quota_of_its_tenant() {
    let folder = old_folder();
    let store = store::open(&config(&folder)).await.expect("the folder is upgraded");
    assert_eq!(store.measure_unmeasured_blobs().await.expect("they are measured"), 6, "four maps, two analyses");
    let blobs = std::fs::read_dir(folder.path().join("blobs")).expect("a folder").flatten();
    let files = blobs.flat_map(|part| std::fs::read_dir(part.path()).expect("a folder").flatten());
    let stored: u64 = files.map(|file| file.metadata().expect("a file").len()).sum();
    let full = async |bytes| {
        let capacity = Capacity { of_tenant: Quotas { bytes, ..Quotas::UNLIMITED }, ..Capacity::UNLIMITED };
        store.full(&Tenant::local(), &capacity).await.expect("it answers")
    };
    assert_eq!((full(stored).await, full(stored + 1).await), (Some(Full::Bytes), None));
}
