//! API keys and the log of changes.

use super::*;
use crate::access::{ApiKey, KeySecret, Scope};
use crate::records::{AuditRecord, KeyRecord};

fn key(tenant: &str) -> (ApiKey, KeyRecord) {
    let key = ApiKey::generate().expect("there are random bytes");
    let record = KeyRecord {
        id: key.id().to_owned(),
        tenant: Tenant::new(tenant),
        name: "robot 7".into(),
        scopes: [Scope::Read].into_iter().collect(),
        created: now(),
        expires: Some(later(60)),
        revoked: None,
    };
    (key, record)
}

pub async fn a_key_is_found_by_its_id_and_revoked_for_good(engine: &impl Engine) {
    let keys = engine.store().keys();
    let secret = KeySecret::of([7; 32]);
    let ((ours, record), (theirs, other)) = (key("ours"), key("theirs"));
    keys.create_key(&record, &ours.hash(&secret)).await.unwrap();
    keys.create_key(&other, &theirs.hash(&secret)).await.unwrap();
    assert!(keys.create_key(&record, &ours.hash(&secret)).await.is_err(), "an id is given once");
    assert_eq!(keys.key(ours.id()).await.unwrap(), Some((record.clone(), ours.hash(&secret))));
    assert_eq!(keys.key("0000000000000000").await.unwrap(), None);
    assert_eq!(keys.keys(None).await.unwrap(), [record.clone(), other]);
    assert_eq!(keys.keys(Some(&record.tenant)).await.unwrap(), std::slice::from_ref(&record));

    let revoked = KeyRecord { revoked: Some(later(5)), ..record };
    for time in [5, 9] {
        assert_eq!(keys.revoke_key(ours.id(), later(time)).await.unwrap().map(|key| key.id), Some(revoked.id.clone()));
    }
    let (stored, _) = keys.key(ours.id()).await.unwrap().unwrap();
    assert!(!stored.is_valid_at(now()) && stored.revoked < Some(later(7)), "the first time counts");
    assert_eq!(keys.revoke_key("0000000000000000", now()).await.unwrap(), None);

    let log = engine.store().audit().entries(&revoked.tenant, 9, None).await.unwrap();
    let told: Vec<_> = log.iter().map(|entry| (entry.operation.as_str(), entry.caller.as_str())).collect();
    assert_eq!(told, [("revokeKey", "command line"), ("createKey", "command line")]);
    assert!(log.iter().all(|entry| entry.resource == format!("key {}", ours.id())));
}

fn entry(tenant: &str, seconds: i64) -> AuditRecord {
    AuditRecord {
        id: Uuid::now_v7(),
        tenant: Tenant::new(tenant),
        time: later(seconds),
        caller: "5f0c2a9be1d47730".into(),
        operation: "updateMap".into(),
        resource: "/v1/maps/7".into(),
        status: AuditRecord::NOT_ANSWERED,
        request: "r".into(),
    }
}

pub async fn the_log_of_changes_is_read_by_its_tenant_and_forgotten_by_age(engine: &impl Engine) {
    let log = engine.store().audit();
    let (first, second, theirs) = (entry("ours", 0), entry("ours", 10), entry("theirs", 0));
    for entry in [&first, &second, &theirs] {
        log.record(entry).await.unwrap();
    }
    let ours = Tenant::new("ours");
    assert_eq!(log.entries(&ours, 9, None).await.unwrap(), [second.clone(), first.clone()]);
    assert_eq!(log.entries(&ours, 1, None).await.unwrap(), std::slice::from_ref(&second));
    assert_eq!(log.entries(&ours, 9, Some(second.id)).await.unwrap(), [first]);
    assert_eq!(log.forget_before(later(5)).await.unwrap(), 2);
    assert_eq!(log.entries(&ours, 9, None).await.unwrap(), [second]);
}

pub async fn a_change_and_its_entry_are_there_together_or_neither_is(engine: &impl Engine) {
    let store = engine.store();
    let entry = entry("local", 0);
    let log = async || store.audit().entries(&local(), 9, None).await.unwrap();
    let refused = with_entry(entry.clone(), try_upload(store, &local(), "a map", None, 0)).await;
    assert_eq!((refused, log().await), (Upload::Full(Full::Queue), vec![]));
    with_entry(entry.clone(), async { [upload(store, "a map").await, upload(store, "another").await] }).await;
    assert_eq!(log().await, std::slice::from_ref(&entry), "once, however often the change writes");
    let answered = AuditRecord { status: 202, resource: "/v1/jobs/7".into(), ..entry };
    store.audit().record(&answered).await.unwrap();
    assert_eq!(log().await, [answered]);
    upload(store, "a map that nobody asked for").await;
    assert_eq!(log().await.len(), 1);
}
