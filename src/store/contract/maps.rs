//! Uploads, records and lists.

use super::*;
use crate::records::MapPatch;

pub async fn an_idempotency_key_stands_for_one_upload(engine: &impl Engine) {
    let store = engine.store();
    let key = |content: &str| IdempotencyKey { key: "key".into(), content: content.into() };
    let Upload::New(job) = try_upload(store, &local(), "map", Some(&key("a")), 1).await else { panic!("it is new") };
    assert_eq!(
        try_upload(store, &local(), "map", Some(&key("a")), 1).await,
        Upload::Seen(job.clone()),
        "even when full"
    );
    assert_eq!(store.seen_upload(&local(), &key("a"), now()).await.unwrap(), Some(Upload::Seen(job.clone())));
    assert_eq!(try_upload(store, &local(), "map", Some(&key("b")), 9).await, Upload::KeyReused);
    assert_eq!(counts(store).await.0, 1);
    assert_eq!(store.seen_upload(&local(), &key("a"), later(25 * 3600)).await.unwrap(), None, "forgotten after a day");
    store.delete_map(&local(), job.map, None).await.unwrap();
    assert!(
        matches!(try_upload(store, &local(), "map", Some(&key("b")), 9).await, Upload::New(_)),
        "gone with its job"
    );
}

pub async fn lists_are_newest_first_and_paged_by_the_last_seen(engine: &impl Engine) {
    let store = engine.store();
    let mut jobs = Vec::new();
    for index in 0..5 {
        jobs.push(upload(store, &index.to_string()).await);
    }
    jobs.reverse();
    let page =
        async |after| store.jobs(&local(), &JobFilter { limit: 2, after, ..JobFilter::default() }).await.unwrap();
    assert_eq!(page(None).await, jobs[..2]);
    assert_eq!(page(Some(jobs[1].id)).await, jobs[2..4]);
    assert_eq!(page(Some(jobs[3].id)).await, jobs[4..]);
    let maps = store.maps(&local(), 2, Some(jobs[2].map)).await.unwrap();
    assert_eq!(maps.iter().map(|map| map.id).collect::<Vec<_>>(), [jobs[3].map, jobs[4].map]);

    claim(store, now()).await.unwrap();
    let running = JobFilter { states: vec![JobState::Running], limit: 9, ..JobFilter::default() };
    assert_eq!(store.jobs(&local(), &running).await.unwrap().len(), 1);
    let of_map = JobFilter { map: Some(jobs[0].map), limit: 9, ..JobFilter::default() };
    assert_eq!(store.jobs(&local(), &of_map).await.unwrap(), jobs[..1]);
    let mut counts = store.job_counts().await.unwrap();
    counts.sort_by_key(|(state, _)| state.name());
    assert_eq!(counts, [(JobState::Accepted, 4), (JobState::Running, 1)]);
    assert_eq!(store.oldest_waiting().await.unwrap(), Some(jobs[3].created), "the one before runs");
}

pub async fn a_map_is_changed_only_from_the_version_that_was_read(engine: &impl Engine) {
    let store = engine.store();
    let map = upload(store, "hall").await.map;
    let rename = async |name: &str, if_match| {
        let patch = MapPatch { name: Some(name.into()), georeference: None };
        store.update_map(&local(), map, &patch, if_match, now()).await.unwrap().unwrap()
    };
    assert_eq!(rename("hall 1", Some(1)).await.unwrap().version, 2);
    assert_eq!(rename("hall 2", Some(1)).await.unwrap_err().name, "hall 1");
    assert_eq!(rename("hall 3", None).await.unwrap().name, "hall 3");
    assert!(store.update_map(&local(), Uuid::now_v7(), &MapPatch::default(), None, now()).await.unwrap().is_none());
}
