//! Registries of sites.

use stillage_core::Point;
use stillage_core::registry::{PlaceState, Registry, RegistryEntry};

use super::*;

fn registry(code: &str) -> Registry {
    let entry = RegistryEntry {
        key: 1,
        code: code.into(),
        is_code_given: false,
        name: None,
        groups: Vec::new(),
        outline: Vec::new(),
        center: Point::origin(),
        state: PlaceState::Current,
        seen: None,
        confirmed_in: None,
    };
    Registry { entries: vec![entry], ..Registry::default() }
}

async fn read(store: &Arc<dyn Store>, map: Uuid) -> SiteRegistry {
    store.registry(&local(), map).await.expect("it answers").expect("the map is there")
}

async fn put(store: &Arc<dyn Store>, map: Uuid, code: &str, replaces: u64) -> bool {
    store.put_registry(&local(), map, &registry(code), replaces, false).await.expect("it answers")
}

pub async fn a_registry_is_changed_only_from_the_version_that_was_read(engine: &impl Engine) {
    let store = engine.store();
    let map = upload(store, "hall").await.map;
    let none = SiteRegistry { site: map, registry: Registry::default(), version: 0, is_newest: true };
    assert_eq!(read(store, map).await, none);
    assert!(put(store, map, "01", 0).await);
    assert!(!put(store, map, "02", 0).await, "somebody else was faster");
    assert!(put(store, map, "03", 1).await);
    let stored = read(store, map).await;
    assert_eq!((stored.registry, stored.version), (registry("03"), 2));
    assert!(!put(store, Uuid::now_v7(), "04", 0).await, "there is no such map");

    let version = store.map(&local(), map).await.unwrap().unwrap().version;
    assert!(store.put_registry(&local(), map, &registry("05"), 2, true).await.unwrap());
    assert_eq!(store.map(&local(), map).await.unwrap().unwrap().version, version + 1, "a person decided");
    let theirs = Tenant::new("other");
    assert_eq!(store.registry(&theirs, map).await.unwrap(), None);
    assert!(!store.put_registry(&theirs, map, &registry("06"), 3, false).await.unwrap());
}

pub async fn maps_of_a_site_share_its_registry_and_it_ends_with_the_last(engine: &impl Engine) {
    let store = engine.store();
    let first = upload(store, "hall").await.map;
    let second = NewMapRow { site: first, ..map_row("hall again") };
    let source = Blob::encode(&MapSource::Message(b"hall again".to_vec()));
    let job = job_of(second.id, source.id(), 1);
    store.create_map(&local(), &second, &source, &job, None, &Capacity::UNLIMITED, now()).await.unwrap();
    assert!(put(store, first, "01", 0).await);
    assert_eq!(read(store, second.id).await.registry, registry("01"));
    assert!(read(store, first).await.is_newest, "the other one is not analysed yet");
    let mut claims = Vec::new();
    while let Some(claim) = claim(store, now()).await {
        claims.push(claim);
    }
    for claim in claims {
        finish(store, &claim).await.unwrap();
    }
    assert!(!read(store, first).await.is_newest && read(store, second.id).await.is_newest);

    store.delete_map(&local(), first, None).await.unwrap();
    assert_eq!(read(store, second.id).await.registry, registry("01"), "the site outlives its first map");
    store.delete_map(&local(), second.id, None).await.unwrap();
    let anew = NewMapRow { id: first, site: first, ..map_row("hall") };
    let job = job_of(first, source.id(), 1);
    store.create_map(&local(), &anew, &source, &job, None, &Capacity::UNLIMITED, now()).await.unwrap();
    assert_eq!(read(store, first).await.version, 0, "nothing was left of it");
}
