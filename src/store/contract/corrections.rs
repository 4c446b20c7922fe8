//! Lists of corrections, and the versions that name them.

use stillage_core::Point;
use stillage_core::corrections::Correction;
use stillage_core::layout::LayoutOptions;
use stillage_core::semantics::Assignment;

use super::*;
use crate::records::{CarryRecord, CorrectionId, CorrectionList, SemanticsOrigin, SemanticsRecord};

/// A map with an analysis in force.
async fn analysed(store: &Arc<dyn Store>) -> (Uuid, Uuid) {
    let map = upload(store, "map").await.map;
    finish(store, &claim(store, now()).await.expect("a job waits")).await.unwrap();
    (map, store.map(&local(), map).await.unwrap().unwrap().analysis.expect("it is analysed"))
}

fn named(name: &str) -> Correction {
    Correction::Name { at: Point::new(1.0, 2.0), name: name.to_owned() }
}

fn decision((map, analysis): (Uuid, Uuid), replaces: u64, corrections: NewCorrections) -> NewSemanticsRow {
    NewSemanticsRow {
        map,
        analysis,
        replaces,
        rule_set: "warehouse".into(),
        draft: draft(),
        assignment: Assignment::default(),
        layout: LayoutOptions::default(),
        corrections,
        origin: SemanticsOrigin::Assigned,
        carried: None,
        restores: None,
    }
}

async fn decide(store: &Arc<dyn Store>, row: &NewSemanticsRow) -> SemanticsRecord {
    store.insert_semantics(&local(), row, now()).await.unwrap().expect("the map is there").expect("it is in force")
}

pub async fn a_list_never_changes_and_ids_are_never_used_twice(engine: &impl Engine) {
    let store = engine.store();
    let on @ (map, _) = analysed(store).await;
    let read = async |list: Option<CorrectionList>| {
        let list = store.corrections(&local(), map, list.expect("a list")).await.unwrap().expect("it is stored");
        list.into_iter().map(|record| (record.id.to_string(), record.correction)).collect::<Vec<_>>()
    };
    let two = NewCorrections::Changed(vec![(None, named("a")), (None, named("b"))]);
    let first = decide(store, &decision(on, 0, two)).await.corrections;
    assert_eq!(first, Some(CorrectionList { number: 1, count: 2 }));
    assert_eq!(read(first).await, [("c1".into(), named("a")), ("c2".into(), named("b"))]);

    let without_the_last = NewCorrections::Changed(vec![(Some(CorrectionId(1)), named("a"))]);
    let second = decide(store, &decision(on, 1, without_the_last)).await.corrections;
    let another = NewCorrections::Changed(vec![(None, named("d")), (Some(CorrectionId(1)), named("c"))]);
    let third = decide(store, &decision(on, 2, another)).await.corrections;
    assert_eq!(read(third).await, [("c3".into(), named("d")), ("c1".into(), named("c"))], "the order stays");
    assert_eq!(read(second).await, [("c1".into(), named("a"))]);
    assert_eq!(read(first).await.len(), 2, "an earlier list stays as it was");

    let none = decide(store, &decision(on, 3, NewCorrections::Changed(Vec::new()))).await.corrections;
    assert_eq!(none, None);
    let back = NewSemanticsRow { restores: Some(1), ..decision(on, 4, NewCorrections::Stored(first)) };
    let back = decide(store, &back).await;
    assert_eq!((back.corrections, back.restores), (first, Some(1)));
    assert_eq!(store.snapshot(&local(), map).await.unwrap().unwrap().semantics, Some(back));
    let unknown = CorrectionList { number: 9, count: 1 };
    assert_eq!(store.corrections(&local(), map, unknown).await.unwrap(), None);
    assert!(store.delete_map(&local(), map, None).await.unwrap());
    assert_eq!(store.corrections(&local(), map, first.expect("a list")).await.unwrap(), None);
}

pub async fn what_was_decided_before_a_time_or_a_version_is_found(engine: &impl Engine) {
    let store = engine.store();
    let on @ (map, _) = analysed(store).await;
    let stored = || NewCorrections::Stored(None);
    let layout = |width| LayoutOptions { place_width_m: Some(width), ..LayoutOptions::default() };
    let before = async |time| store.semantics_before(&local(), map, time).await.unwrap().map(|record| record.version);
    assert_eq!(before(later(9)).await, None);
    let first = decide(store, &NewSemanticsRow { layout: layout(1.0), ..decision(on, 0, stored()) }).await;
    let second = decide(store, &NewSemanticsRow { layout: layout(2.0), ..decision(on, 1, stored()) }).await;
    assert_eq!(before(first.created).await, None);
    assert_eq!(before(second.created).await, Some(1));
    assert_eq!(before(later(9)).await, Some(2));
    let layout_before = async |version| store.layout_before(&local(), map, version).await.unwrap();
    assert_eq!(layout_before(1).await, LayoutOptions::default());
    assert_eq!(layout_before(2).await, layout(1.0));
}

pub async fn what_was_carried_from_another_map_is_the_decision_of_this_one(engine: &impl Engine) {
    let store = engine.store();
    let (map, first) = analysed(store).await;
    let carried = CarryRecord { map: Some(Uuid::now_v7()), from: 7, kept: 1, lost: Vec::new() };
    let list = NewCorrections::Changed(vec![(None, named("a"))]);
    let row =
        NewSemanticsRow { origin: SemanticsOrigin::Carried, carried: Some(carried), ..decision((map, first), 0, list) };
    let made = decide(store, &row).await;
    request(store, map, 2).await;
    finish(store, &claim(store, now()).await.expect("a job waits")).await.unwrap();
    let snapshot = store.snapshot(&local(), map).await.unwrap().unwrap();
    assert_eq!(snapshot.decided_before.map(|(record, _)| record), Some(made));
}
