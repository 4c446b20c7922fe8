//! Whose rows are read and written.

use stillage_core::semantics::Assignment;

use stillage_core::layout::LayoutOptions;

use super::*;
use crate::records::{CorrectionList, MapPatch, SemanticsOrigin};

pub async fn what_belongs_to_another_tenant_is_not_there(engine: &impl Engine) {
    let store = engine.store();
    let job = upload(store, "map").await;
    let held = claim(store, now()).await.unwrap();
    assert_eq!(held.tenant, local());
    finish(store, &held).await.unwrap();
    let analysis = store.map(&local(), job.map).await.unwrap().unwrap().analysis.unwrap();
    let source = store.map_source(&local(), job.map).await.unwrap().unwrap();

    let other = Tenant::new("other");
    assert_eq!(store.map(&other, job.map).await.unwrap(), None);
    assert_eq!(store.maps(&other, 9, None).await.unwrap(), []);
    assert_eq!(store.map_source(&other, job.map).await.unwrap(), None);
    assert_eq!(store.map_state(&other, job.map).await.unwrap(), None);
    assert!(store.snapshot(&other, job.map).await.unwrap().is_none());
    assert_eq!(store.analyses(&other, job.map).await.unwrap(), []);
    assert_eq!(store.semantics_versions(&other, job.map).await.unwrap(), []);
    assert_eq!(store.semantics_before(&other, job.map, later(9)).await.unwrap(), None);
    assert_eq!(store.corrections(&other, job.map, CorrectionList { number: 1, count: 1 }).await.unwrap(), None);
    assert_eq!(store.job(&other, job.id).await.unwrap(), None);
    assert_eq!(store.jobs(&other, &JobFilter { limit: 9, ..JobFilter::default() }).await.unwrap(), []);

    let rename = MapPatch { name: Some("theirs".into()), georeference: None };
    assert_eq!(store.update_map(&other, job.map, &rename, None, now()).await.unwrap(), None);
    let again = job_of(job.map, &source, 2);
    assert_eq!(store.request_analysis(&other, &with_seed(2), &again, &Capacity::queue(9), now()).await.unwrap(), None);
    let row = NewSemanticsRow {
        map: job.map,
        analysis,
        replaces: 0,
        rule_set: "warehouse".into(),
        draft: draft(),
        assignment: Assignment::default(),
        layout: LayoutOptions::default(),
        origin: SemanticsOrigin::Assigned,
        carried: None,
        restores: None,
        corrections: NewCorrections::Stored(None),
    };
    assert_eq!(store.insert_semantics(&other, &row, now()).await.unwrap(), None);
    assert!(!store.delete_map(&other, job.map, None).await.unwrap());

    let waiting = upload(store, "second").await;
    assert_eq!(store.dismiss(&other, waiting.id, now()).await.unwrap(), None);
    assert_eq!(state(store, waiting.id).await.0, JobState::Accepted, "and it still waits");
    assert_eq!(store.map(&local(), job.map).await.unwrap().unwrap().name, "map");
}

pub async fn two_tenants_may_use_the_same_names(engine: &impl Engine) {
    let store = engine.store();
    let other = Tenant::new("other");
    let key = |content: &str| IdempotencyKey { key: "key".into(), content: content.into() };
    let ours = try_upload(store, &local(), "ours", Some(&key("a")), 9).await;
    let theirs = try_upload(store, &other, "theirs", Some(&key("b")), 9).await;
    assert!(matches!((&ours, &theirs), (Upload::New(_), Upload::New(_))), "{ours:?}, {theirs:?}");
    assert_eq!(store.seen_upload(&Tenant::new("third"), &key("a"), now()).await.unwrap(), None);

    store.create_rule_set(&local(), "clinic", &draft()).await.unwrap().expect("the id is free");
    store.create_rule_set(&other, "clinic", &draft()).await.unwrap().expect("the id is free for them, too");
    assert_eq!(store.put_rule_set(&other, "clinic", &draft(), 1).await.unwrap().unwrap().unwrap().version, 2);
    assert_eq!(store.rule_set(&local(), "clinic").await.unwrap().unwrap().version, 1);
    store.delete_rule_set(&other, "clinic", 2).await.unwrap().unwrap().unwrap();
    assert_eq!(store.rule_sets(&local()).await.unwrap().len(), 1);
    assert_eq!(store.rule_sets(&other).await.unwrap(), []);
}
