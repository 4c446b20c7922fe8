//! Blobs and their rows.

use super::*;

pub async fn a_damaged_blob_is_an_error_and_a_new_copy_mends_it(engine: &impl Engine) {
    let store = engine.store();
    let blob = Blob::new("a map".as_bytes());
    store.blobs().put(&blob).await.unwrap();
    assert_eq!(store.blobs().get(blob.id()).await.unwrap().bytes(), "a map");

    engine.damage(blob.id(), Some("a mop"));
    assert!(matches!(store.blobs().get(blob.id()).await, Err(StoreError::Damaged { .. })));
    store.blobs().put(&blob).await.unwrap();
    assert_eq!(store.blobs().get(blob.id()).await.unwrap().bytes(), "a map");

    engine.damage(blob.id(), None);
    assert!(matches!(store.blobs().get(blob.id()).await, Err(StoreError::Damaged { .. })));
}

pub async fn blobs_without_a_row_are_swept_when_they_are_old(engine: &impl Engine) {
    let store = engine.store();
    upload(store, "kept").await;
    let orphan = Blob::new("nobody's".as_bytes());
    store.blobs().put(&orphan).await.unwrap();
    assert_eq!(store.sweep_blobs(Duration::from_hours(24)).await.unwrap(), 0);
    store.blobs().get(orphan.id()).await.expect("young orphans stay: their row may be on its way");
    assert_eq!(store.sweep_blobs(Duration::ZERO).await.unwrap(), 1);
    assert!(store.blobs().get(orphan.id()).await.is_err());
}

pub async fn deleting_a_map_takes_everything_but_what_others_share(engine: &impl Engine) {
    let store = engine.store();
    let (first, second) = (upload(store, "same").await, upload(store, "same").await);
    let claimed = claim(store, now()).await.unwrap();
    assert_eq!(claimed.job, first.id, "first come, first served");
    finish(store, &claimed).await.unwrap();

    assert!(store.delete_map(&local(), first.map, None).await.unwrap());
    assert!(!store.delete_map(&local(), first.map, None).await.unwrap());
    assert_eq!(counts(store).await, (1, 0, 1));
    let source = store.map_source(&local(), second.map).await.unwrap().unwrap();
    store.blobs().get(&source).await.expect("the other map still has its upload");

    store.delete_map(&local(), second.map, None).await.unwrap();
    assert!(store.blobs().get(&source).await.is_err());
    assert_eq!(store.blobs().older_than(Duration::ZERO).await.unwrap(), []);
}
