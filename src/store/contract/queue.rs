//! The queue: the worker's side of jobs.

use super::*;
use crate::store::Retry;
use crate::store::queue::Progress;

pub async fn a_job_is_claimed_once_however_many_ask(engine: &impl Engine) {
    let store = engine.store();
    for index in 0..20 {
        upload(store, &index.to_string()).await;
    }
    let mut claims = tokio::task::JoinSet::new();
    for _ in 0..40 {
        let store = Arc::clone(store);
        claims.spawn(async move { claim(&store, now()).await.map(|claim| claim.job) });
    }
    let claims = claims.join_all().await;
    let mut jobs: Vec<Uuid> = claims.into_iter().flatten().collect();
    jobs.sort_unstable();
    jobs.dedup();
    assert_eq!(jobs.len(), 20);
}

pub async fn a_zombie_can_neither_finish_nor_harm(engine: &impl Engine) {
    let store = engine.store();
    let job = upload(store, "map").await;
    let zombie = claim(store, now()).await.unwrap();
    // The lease runs out; the next claim puts the job back, and after its wait hands it to another worker.
    assert!(claim(store, later(31)).await.is_none());
    let heir = claim(store, later(37)).await.expect("it is due again");
    assert_eq!((heir.job, heir.attempt), (job.id, 2));

    assert!(matches!(finish(store, &zombie).await, Err(StoreError::ClaimLost)));
    let beat = store.heartbeat(&zombie, &Progress::default(), TERMS.lease, now()).await;
    assert!(matches!(beat, Err(StoreError::ClaimLost)));
    assert!(matches!(store.is_cancel_requested(&zombie).await, Err(StoreError::ClaimLost)));
    assert!(matches!(store.end(&zombie, JobState::Failed, "", now()).await, Err(StoreError::ClaimLost)));
    assert!(matches!(store.requeue(&zombie, 0, Duration::ZERO, "", now()).await, Err(StoreError::ClaimLost)));
    assert_eq!((state(store, job.id).await, counts(store).await), ((JobState::Running, 2), (1, 0, 1)));

    finish(store, &heir).await.unwrap();
    assert!(matches!(finish(store, &heir).await, Err(StoreError::ClaimLost)), "nor does the heir finish twice");
    assert_eq!((state(store, job.id).await, counts(store).await), ((JobState::Successful, 2), (1, 1, 1)));
}

pub async fn an_attempt_given_back_does_not_give_its_token_back(engine: &impl Engine) {
    let store = engine.store();
    let job = upload(store, "map").await;
    let stopped = claim(store, now()).await.unwrap();
    store.requeue(&stopped, stopped.attempt - 1, Duration::ZERO, "stopped", now()).await.unwrap();
    assert_eq!(state(store, job.id).await, (JobState::Accepted, 0));

    let next = claim(store, now()).await.expect("due at once");
    assert_eq!(next.attempt, 1);
    assert!(matches!(finish(store, &stopped).await, Err(StoreError::ClaimLost)));
    finish(store, &next).await.unwrap();
}

pub async fn a_heartbeat_keeps_the_lease_and_shows_the_progress(engine: &impl Engine) {
    let store = engine.store();
    let job = upload(store, "map").await;
    let held = claim(store, now()).await.unwrap();
    let progress = Progress { percent: 40, stage: Some("features".into()), stages: Vec::new() };
    assert!(!store.heartbeat(&held, &progress, TERMS.lease, later(25)).await.unwrap());
    assert!(claim(store, later(40)).await.is_none());
    assert_eq!(state(store, job.id).await, (JobState::Running, 1), "not rescued");
    let record = store.job(&local(), job.id).await.unwrap().unwrap();
    assert_eq!((record.progress, record.stage.as_deref()), (40, Some("features")));
}

pub async fn a_job_that_kills_its_process_fails_after_the_last_attempt(engine: &impl Engine) {
    let store = engine.store();
    let job = upload(store, "poison").await;
    for attempt in 1..=TERMS.max_attempts {
        // The lease of the attempt before has run out: it is taken back first, and due again after a wait.
        let at = i64::from(attempt) * 100;
        assert_eq!(claim(store, later(at)).await.is_some(), attempt == 1);
        if attempt > 1 {
            assert_eq!(claim(store, later(at + 6)).await.expect("it is due").attempt, attempt);
        }
    }
    assert!(claim(store, later(3600)).await.is_none());
    let record = store.job(&local(), job.id).await.unwrap().unwrap();
    assert_eq!((record.state, record.attempt), (JobState::Failed, 3));
    assert_eq!(record.message, "given up: the service died or stalled in each of 3 attempts");
    assert!(record.finished.is_some());
}

pub async fn where_all_may_have_died_only_deaths_in_one_stage_count(engine: &impl Engine) {
    let store = engine.store();
    let job = upload(store, "map").await;
    let mut at = 0;
    // Cut off in a stage; whoever asks next was not there when that happened.
    let mut die = async |stage: &str| {
        let held = claim(store, later(at)).await.expect("it is due");
        let progress = Progress { percent: 1, stage: Some(stage.to_owned()), stages: Vec::new() };
        assert!(!store.heartbeat(&held, &progress, TERMS.lease, later(at)).await.unwrap());
        let terms = Terms { in_touch_since: later(at + 20), ..TERMS };
        assert!(store.claim(&terms, later(at + 40)).await.unwrap().is_none());
        at += 50;
        state(store, job.id).await
    };
    for stage in ["features", "rooms", "features", "rooms", "features"] {
        assert_eq!(die(stage).await, (JobState::Accepted, 1), "it got to another stage each time");
    }
    assert_eq!(die("features").await, (JobState::Accepted, 2));
    assert_eq!(die("features").await, (JobState::Failed, 3));
}

pub async fn a_job_that_was_cut_off_waits_behind_the_others(engine: &impl Engine) {
    let store = engine.store();
    let (first, second) = (upload(store, "first").await, upload(store, "second").await);
    let cut_off = claim(store, now()).await.unwrap();
    assert_eq!(cut_off.job, first.id);
    store.requeue(&cut_off, cut_off.attempt, Duration::ZERO, "a fault", now()).await.unwrap();
    assert_eq!(claim(store, now()).await.unwrap().job, second.id);
    assert_eq!(claim(store, now()).await.unwrap().job, first.id);
}

pub async fn a_job_that_was_cut_off_waits_ten_minutes_behind_fresh_ones(engine: &impl Engine) {
    let store = engine.store();
    let first = upload(store, "first").await;
    let cut_off = claim(store, now()).await.unwrap();
    store.requeue(&cut_off, cut_off.attempt, Duration::ZERO, "a fault", now()).await.unwrap();
    let fresh = [upload(store, "second").await, upload(store, "third").await, upload(store, "fourth").await];
    assert_eq!(claim(store, now()).await.unwrap().job, fresh[0].id);
    assert_eq!(claim(store, later(590)).await.unwrap().job, fresh[1].id);
    assert_eq!(claim(store, later(610)).await.unwrap().job, first.id);
}

pub async fn a_job_that_failed_or_was_dismissed_runs_once_more(engine: &impl Engine) {
    let store = engine.store();
    let job = upload(store, "map").await;
    let retry =
        async |most| store.retry(&local(), job.id, &Capacity::queue(most), now()).await.unwrap().expect("it is there");
    assert!(matches!(retry(9).await, Retry::NotOver(_)));
    for state in [JobState::Failed, JobState::Dismissed] {
        let held = claim(store, now()).await.expect("it waits");
        store.end(&held, state, "for a test", now()).await.unwrap();
        assert_eq!(retry(0).await, Retry::Full(Full::Queue));
        let Retry::Queued(again) = retry(9).await else { panic!("it is over") };
        assert_eq!((again.state, again.attempt, again.message.as_str()), (JobState::Accepted, 0, ""));
        assert_eq!((again.started, again.finished), (None, None));
        assert!(matches!(finish(store, &held).await, Err(StoreError::ClaimLost)), "the token is not given back");
    }
    let held = claim(store, now()).await.expect("it waits");
    store.dismiss(&local(), job.id, now()).await.unwrap();
    store.end(&held, JobState::Dismissed, "dismissed", now()).await.unwrap();
    assert!(matches!(retry(9).await, Retry::Queued(_)));
    let held = claim(store, now()).await.expect("it waits");
    finish(store, &held).await.expect("the wish to cancel is forgotten");
    assert!(matches!(retry(9).await, Retry::NotOver(_)));
    assert!(store.retry(&local(), Uuid::now_v7(), &Capacity::UNLIMITED, now()).await.unwrap().is_none());
}

pub async fn a_waiting_job_is_dismissed_at_once_a_running_one_is_asked_to_stop(engine: &impl Engine) {
    let store = engine.store();
    let (running, waiting) = (upload(store, "first").await, upload(store, "second").await);
    let held = claim(store, now()).await.unwrap();
    assert_eq!(store.dismiss(&local(), waiting.id, now()).await.unwrap().unwrap().state, JobState::Dismissed);
    assert_eq!(store.dismiss(&local(), running.id, now()).await.unwrap().unwrap().state, JobState::Running);
    assert!(store.heartbeat(&held, &Progress::default(), TERMS.lease, now()).await.unwrap());
    assert!(matches!(finish(store, &held).await, Err(StoreError::ClaimLost)), "cancelled means no result");
    store.end(&held, JobState::Dismissed, "dismissed", now()).await.unwrap();
    assert!(claim(store, later(3600)).await.is_none());
    assert_eq!(counts(store).await, (2, 0, 2));
    assert!(store.dismiss(&local(), Uuid::now_v7(), now()).await.unwrap().is_none());
}

pub async fn a_full_queue_takes_no_more(engine: &impl Engine) {
    let store = engine.store();
    upload(store, "first").await;
    let capacity = Capacity::queue(1);
    assert_eq!(store.full(&local(), &capacity).await.unwrap(), Some(Full::Queue));
    assert_eq!(try_upload(store, &local(), "second", None, 1).await, Upload::Full(Full::Queue));
    assert_eq!(counts(store).await, (1, 0, 1));
    claim(store, now()).await.unwrap();
    assert!(matches!(try_upload(store, &local(), "second", None, 1).await, Upload::New(_)), "running jobs do not wait");
    assert_eq!(store.full(&local(), &capacity).await.unwrap(), Some(Full::Queue));
}

pub async fn a_result_may_be_a_document(engine: &impl Engine) {
    let store = engine.store();
    let job = upload(store, "map").await;
    let held = claim(store, now()).await.unwrap();
    let outputs = json!({"ways": 3});
    store.finish(&held, &JobResult::Document(outputs.clone()), &[], now()).await.unwrap();
    let job = store.job(&local(), job.id).await.unwrap().unwrap();
    assert_eq!((job.state, job.outputs, counts(store).await), (JobState::Successful, Some(outputs), (1, 0, 1)));
}
