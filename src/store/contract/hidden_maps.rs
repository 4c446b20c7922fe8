//! Maps that were deleted and may be restored.

use super::*;

pub async fn a_hidden_map_is_not_there_until_it_is_restored(engine: &impl Engine) {
    let store = engine.store();
    let job = upload(store, "map").await;
    finish(store, &claim(store, now()).await.unwrap()).await.unwrap();
    let record = store.map(&local(), job.map).await.unwrap().unwrap();
    let analyses = store.analyses(&local(), job.map).await.unwrap();
    let deleted = now();
    assert!(!store.hide_map(&local(), job.map, Some(record.version + 1), deleted).await.unwrap());
    assert!(store.hide_map(&local(), job.map, Some(record.version), deleted).await.unwrap());
    assert!(!store.hide_map(&local(), job.map, None, deleted).await.unwrap(), "it is not there");
    assert_eq!(counts(store).await, (0, 0, 0));
    assert!(store.snapshot(&local(), job.map).await.unwrap().is_none());
    assert_eq!(store.hidden_since(&local(), job.map).await.unwrap(), Some(deleted));
    assert_eq!(store.hidden_since(&Tenant::new("other"), job.map).await.unwrap(), None);
    assert_eq!(store.sweep_blobs(Duration::ZERO).await.unwrap(), 0, "its blobs stay");
    let just_before = deleted - SignedDuration::from_micros(1);
    let hidden = async |tenant: &Tenant, hidden_after, limit, after| {
        let maps = store.hidden_maps(tenant, hidden_after, limit, after).await.unwrap();
        maps.into_iter().map(|hidden| (hidden.map, hidden.hidden)).collect::<Vec<_>>()
    };
    assert_eq!(hidden(&local(), just_before, 9, None).await, [(record.clone(), deleted)]);
    assert_eq!(hidden(&local(), deleted, 9, None).await, [], "it cannot be restored any more");
    assert_eq!(hidden(&local(), just_before, 9, Some(job.map)).await, [], "the next page");
    assert_eq!(hidden(&local(), just_before, 0, None).await, []);
    assert_eq!(hidden(&Tenant::new("other"), just_before, 9, None).await, []);

    assert_eq!(store.restore_map(&Tenant::new("other"), job.map, Timestamp::MIN, now()).await.unwrap(), None);
    assert_eq!(store.restore_map(&local(), job.map, deleted, now()).await.unwrap(), None, "too late");
    assert_eq!(store.restore_map(&local(), job.map, just_before, now()).await.unwrap(), Some(record));
    assert_eq!(store.analyses(&local(), job.map).await.unwrap(), analyses);
    assert_eq!((counts(store).await, store.hidden_since(&local(), job.map).await.unwrap()), ((1, 1, 1), None));
    assert_eq!(store.delete_hidden(Timestamp::MAX).await.unwrap(), 0);
}

pub async fn jobs_of_a_hidden_map_wait(engine: &impl Engine) {
    let store = engine.store();
    let (running, waiting) = (upload(store, "running").await, upload(store, "waiting").await);
    let held = claim(store, now()).await.unwrap();
    assert_eq!(held.job, running.id);
    for map in [running.map, waiting.map] {
        assert!(store.hide_map(&local(), map, None, now()).await.unwrap());
    }
    assert!(matches!(finish(store, &held).await, Err(StoreError::ClaimLost)), "the worker learns it");
    assert!(claim(store, now()).await.is_none());
    assert_eq!(store.job_counts().await.unwrap(), []);
    assert!(matches!(try_upload(store, &local(), "third", None, 1).await, Upload::New(_)), "nobody waits");
    finish(store, &claim(store, now()).await.unwrap()).await.unwrap();

    store.restore_map(&local(), running.map, Timestamp::MIN, now()).await.unwrap().expect("it is hidden");
    let again = claim(store, now()).await.expect("its job goes on");
    assert_eq!((again.job, again.attempt), (running.id, 1), "the attempt that was cut off does not count");
    assert!(again.token > held.token);
    finish(store, &again).await.unwrap();
    assert!(claim(store, now()).await.is_none(), "the other one is hidden still");
}

pub async fn hidden_maps_are_deleted_by_their_age(engine: &impl Engine) {
    let store = engine.store();
    let key = IdempotencyKey { key: "key".into(), content: "a".into() };
    let Upload::New(first) = try_upload(store, &local(), "first", Some(&key), 9).await else { panic!("it is new") };
    let second = upload(store, "second").await;
    let source = store.map_source(&local(), first.map).await.unwrap().unwrap();
    store.hide_map(&local(), first.map, None, later(0)).await.unwrap();
    store.hide_map(&local(), second.map, None, later(100)).await.unwrap();
    assert_eq!(store.seen_upload(&local(), &key, now()).await.unwrap(), None, "an upload with its key is a new one");
    assert_eq!(store.delete_hidden(later(50)).await.unwrap(), 1);
    assert!(store.blobs().get(&source).await.is_err());
    assert_eq!(store.hidden_since(&local(), first.map).await.unwrap(), None);
    assert!(store.restore_map(&local(), second.map, Timestamp::MIN, now()).await.unwrap().is_some());
}
