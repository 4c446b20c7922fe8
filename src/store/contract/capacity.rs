//! What tenants may have, and whose turn it is.

use super::*;

fn other() -> Tenant {
    Tenant::new("other")
}

/// Uploads within quotas of the tenant.
async fn upload_within(store: &Arc<dyn Store>, tenant: &Tenant, content: &str, quotas: Quotas) -> Upload {
    let map = map_row(content);
    let source = Blob::encode(&MapSource::Message(content.as_bytes().to_vec()));
    let job = job_of(map.id, source.id(), 1);
    let capacity = Capacity { of_tenant: quotas, ..Capacity::UNLIMITED };
    store.create_map(tenant, &map, &source, &job, None, &capacity, now()).await.expect("it answers")
}

pub async fn a_tenant_has_no_more_than_it_may_and_others_do_not_notice(engine: &impl Engine) {
    let store = engine.store();
    let quotas = Quotas { maps: 2, queued_jobs: 2, ..Quotas::UNLIMITED };
    let capacity = Capacity { of_tenant: quotas, ..Capacity::UNLIMITED };
    for name in ["first", "second"] {
        assert!(matches!(upload_within(store, &local(), name, quotas).await, Upload::New(_)));
    }
    assert_eq!(upload_within(store, &local(), "third", quotas).await, Upload::Full(Full::QueuedJobs));
    assert_eq!(store.full(&local(), &capacity).await.unwrap(), Some(Full::QueuedJobs));
    assert!(matches!(upload_within(store, &other(), "theirs", quotas).await, Upload::New(_)));

    let held = claim(store, now()).await.unwrap();
    assert_eq!(upload_within(store, &local(), "third", quotas).await, Upload::Full(Full::Maps), "a job less waits");
    let fewer = Capacity { of_tenant: Quotas { maps: 1, ..quotas }, ..capacity };
    let source = store.map_source(&local(), held.map).await.unwrap().unwrap();
    let again = store.request_analysis(&local(), &with_seed(2), &job_of(held.map, &source, 2), &fewer, now()).await;
    assert!(matches!(again.unwrap(), Some(Request::New(_))), "no map is added");
    store.delete_map(&local(), held.map, None).await.unwrap();
    assert_eq!(store.full(&local(), &capacity).await.unwrap(), None);
    assert!(matches!(upload_within(store, &local(), "third", quotas).await, Upload::New(_)), "there is room again");
}

pub async fn what_is_stored_of_a_tenant_counts_upload_and_result(engine: &impl Engine) {
    let store = engine.store();
    let length = Blob::encode(&MapSource::Message(b"a map".to_vec())).bytes().len() as u64;
    let within = |bytes| Quotas { bytes, ..Quotas::UNLIMITED };
    assert_eq!(upload_within(store, &local(), "a map", within(length - 1)).await, Upload::Full(Full::Bytes));
    assert!(matches!(upload_within(store, &local(), "a map", within(length)).await, Upload::New(_)));
    assert_eq!(upload_within(store, &local(), "a map", within(2 * length - 1)).await, Upload::Full(Full::Bytes));
    let held = claim(store, now()).await.unwrap();
    finish(store, &held).await.unwrap();
    assert_eq!(upload_within(store, &local(), "a map", within(2 * length)).await, Upload::Full(Full::Bytes));
    assert!(
        matches!(upload_within(store, &other(), "a map", within(length)).await, Upload::New(_)),
        "not told of ours"
    );
}

pub async fn what_an_earlier_release_stored_counts_once_it_is_measured(engine: &impl Engine) {
    let store = engine.store();
    let (first, second) = (upload(store, "a map").await, upload(store, "another map").await);
    finish(store, &claim(store, now()).await.unwrap()).await.unwrap();
    engine.sql().run("UPDATE maps SET bytes = 0").await;
    engine.sql().run("UPDATE analyses SET bytes = 0").await;
    let full = async |bytes| {
        let capacity = Capacity { of_tenant: Quotas { bytes, ..Quotas::UNLIMITED }, ..Capacity::UNLIMITED };
        store.full(&local(), &capacity).await.unwrap()
    };
    assert_eq!(full(1).await, None, "nothing counts");

    let lost = store.map_source(&local(), second.map).await.unwrap().unwrap();
    engine.damage(&lost, None);
    assert_eq!(store.measure_unmeasured_blobs().await.unwrap(), 2);
    let upload = Blob::encode(&MapSource::Message(b"a map".to_vec())).bytes().len();
    let stored = (upload + format!("result of {}", first.id).len()) as u64;
    assert_eq!((full(stored).await, full(stored + 1).await), (Some(Full::Bytes), None));
    assert_eq!(store.measure_unmeasured_blobs().await.unwrap(), 0, "what is lost has no length");
}

pub async fn tenants_are_served_in_turn(engine: &impl Engine) {
    let store = engine.store();
    for name in ["first", "second", "third"] {
        upload(store, name).await;
    }
    let served = async |second: i64| claim(store, later(second)).await.map(|claim| claim.tenant);
    assert_eq!(served(0).await, Some(local()));
    for name in ["theirs", "theirs, too"] {
        try_upload(store, &other(), name, None, u64::MAX).await;
    }
    let mut turns = Vec::new();
    for second in 1..5 {
        turns.push(served(second).await.expect("a job waits"));
    }
    assert_eq!(turns, [other(), local(), other(), local()]);
    assert_eq!(served(6).await, None);
}

pub async fn a_tenant_runs_no_more_jobs_than_it_may(engine: &impl Engine) {
    let store = engine.store();
    let terms = Terms { running_of_tenant: 1, ..TERMS };
    for name in ["first", "second"] {
        upload(store, name).await;
    }
    try_upload(store, &other(), "theirs", None, u64::MAX).await;
    let first = store.claim(&terms, now()).await.unwrap().expect("a job waits");
    let theirs = store.claim(&terms, now()).await.unwrap().expect("a job waits");
    assert_eq!((&first.tenant, &theirs.tenant), (&local(), &other()));
    assert!(store.claim(&terms, now()).await.unwrap().is_none());
    finish(store, &first).await.unwrap();
    assert_eq!(store.claim(&terms, now()).await.unwrap().expect("there is room").tenant, local());
}
