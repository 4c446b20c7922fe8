//! Results, decisions, and what is in force.

use stillage_core::semantics::Assignment;

use stillage_core::layout::LayoutOptions;

use super::*;
use crate::records::{CarryRecord, MapPatch, SemanticsOrigin};

pub async fn the_analysis_asked_for_last_answers(engine: &impl Engine) {
    let store = engine.store();
    let map = upload(store, "map").await.map;
    let ask = async |seed| request(store, map, seed).await;
    let in_force = async || {
        let snapshot = store.snapshot(&local(), map).await.unwrap().unwrap();
        snapshot.analysis.map(|(record, _)| record.options.seed)
    };

    assert!(matches!(ask(1).await, Request::Pending(_)), "the first job will make it");
    let Request::New(_) = ask(2).await else { panic!("other options") };
    let (first, second) = (claim(store, now()).await.unwrap(), claim(store, now()).await.unwrap());
    assert_eq!(in_force().await, None);
    finish(store, &second).await.unwrap();
    assert_eq!(in_force().await, Some(2));
    finish(store, &first).await.unwrap();
    assert_eq!(in_force().await, Some(2), "the first request ended later but was asked for before");

    let version = store.map(&local(), map).await.unwrap().unwrap().version;
    let Request::Existing(existing) = ask(1).await else { panic!("it is there") };
    assert_eq!((existing.options.seed, in_force().await), (1, Some(1)));
    assert_eq!(store.map(&local(), map).await.unwrap().unwrap().version, version + 1);
    assert_eq!(store.analyses(&local(), map).await.unwrap().len(), 2);
}

pub async fn a_proposal_answers_once_it_is_activated(engine: &impl Engine) {
    let store = engine.store();
    let map = upload(store, "map").await.map;
    let source = store.map_source(&local(), map).await.unwrap().expect("the map is there");
    let propose = async |seed| {
        let job = NewJob { activates: false, ..job_of(map, &source, seed) };
        store
            .request_analysis(&local(), &with_seed(seed), &job, &Capacity::queue(9), now())
            .await
            .unwrap()
            .expect("the map is there")
    };
    let finish_next = async || finish(store, &claim(store, now()).await.expect("a job waits")).await.unwrap();
    let in_force = async || {
        let snapshot = store.snapshot(&local(), map).await.unwrap().unwrap();
        snapshot.analysis.map(|(record, _)| record.options.seed)
    };
    finish_next().await;
    assert!(matches!(propose(2).await, Request::New(_)));
    finish_next().await;
    let Request::Existing(proposal) = propose(2).await else { panic!("it is there") };
    assert_eq!(in_force().await, Some(1), "nobody activated the other one");
    assert!(store.activate(&local(), map, proposal.id, now()).await.unwrap());
    assert_eq!(in_force().await, Some(2));

    assert!(matches!(propose(3).await, Request::New(_)));
    assert!(matches!(request(store, map, 3).await, Request::Pending(_)), "the same, at once");
    finish_next().await;
    assert_eq!(in_force().await, Some(3));
    let stranger = Tenant::new("other");
    assert!(!store.activate(&stranger, map, proposal.id, now()).await.unwrap());
    assert!(!store.activate(&local(), map, Uuid::now_v7(), now()).await.unwrap());
    assert_eq!(in_force().await, Some(3));
}

pub async fn decisions_are_bound_to_their_analysis_and_replace_what_they_saw(engine: &impl Engine) {
    let store = engine.store();
    let map = upload(store, "map").await.map;
    let first = claim(store, now()).await.unwrap();
    finish(store, &first).await.unwrap();
    let analysis = store.map(&local(), map).await.unwrap().unwrap().analysis.unwrap();
    let layout = LayoutOptions { place_width_m: Some(1.2), ..LayoutOptions::default() };
    let decide = async |analysis, replaces| {
        let row = NewSemanticsRow {
            map,
            analysis,
            replaces,
            rule_set: "warehouse".into(),
            draft: draft(),
            assignment: Assignment::default(),
            layout: layout.clone(),
            origin: SemanticsOrigin::Assigned,
            carried: None,
            restores: None,
            corrections: NewCorrections::Stored(None),
        };
        let decided = store.insert_semantics(&local(), &row, now()).await.unwrap().expect("the map is there");
        decided.map(|record| record.version)
    };
    assert_eq!(decide(analysis, 0).await, Ok(1));
    assert_eq!(decide(analysis, 0).await, Err(1), "somebody decided in between");
    assert_eq!(decide(analysis, 1).await, Ok(2));

    request(store, map, 7).await;
    let second = claim(store, now()).await.unwrap();
    finish(store, &second).await.unwrap();
    let snapshot = store.snapshot(&local(), map).await.unwrap().unwrap();
    assert_eq!(snapshot.semantics, None, "the decisions named categories of the other analysis");
    assert_eq!(decide(analysis, 2).await, Err(0), "that analysis is no longer in force");
    assert_eq!(decide(snapshot.analysis.unwrap().0.id, 0).await, Ok(3), "numbers are never used twice");
    let versions = store.semantics_versions(&local(), map).await.unwrap();
    let versions: Vec<u64> = versions.iter().map(|record| record.version).collect();
    assert_eq!(versions, [3, 2, 1]);
    assert_eq!(snapshot.layout, layout, "another analysis has the layout of the newest decision");

    request(store, map, 1).await;
    let snapshot = store.snapshot(&local(), map).await.unwrap().unwrap();
    assert_eq!(snapshot.semantics.map(|record| record.version), Some(2), "back with its own decision");
}

pub async fn what_was_decided_before_is_found_for_the_analysis_in_force(engine: &impl Engine) {
    let store = engine.store();
    let map = upload(store, "map").await.map;
    let snapshot = async || store.snapshot(&local(), map).await.unwrap().unwrap();
    let in_force = async || snapshot().await.analysis.expect("it is analysed").0.id;
    let before = async || snapshot().await.decided_before.map(|(record, blob)| (record.version, record.analysis, blob));
    let put_in_force = async |seed| {
        if !matches!(request(store, map, seed).await, Request::Existing(_)) {
            finish(store, &claim(store, now()).await.expect("a job waits")).await.unwrap();
        }
        in_force().await
    };
    let decide = async |analysis, replaces, carried: Option<CarryRecord>| {
        let row = NewSemanticsRow {
            map,
            analysis,
            replaces,
            rule_set: "warehouse".into(),
            draft: draft(),
            assignment: Assignment::default(),
            layout: LayoutOptions::default(),
            origin: if carried.is_some() { SemanticsOrigin::Carried } else { SemanticsOrigin::Assigned },
            carried,
            restores: None,
            corrections: NewCorrections::Stored(None),
        };
        let decided = store.insert_semantics(&local(), &row, now()).await.unwrap().unwrap().expect("it is in force");
        assert_eq!((&decided.carried, decided.origin), (&row.carried, row.origin));
    };
    let first = put_in_force(1).await;
    let (_, blob) = snapshot().await.analysis.expect("it is analysed");
    put_in_force(2).await;
    assert_eq!(before().await, None, "nobody decided");
    put_in_force(1).await;
    decide(first, 0, None).await;
    put_in_force(2).await;
    let third = put_in_force(3).await;
    assert_eq!(before().await, Some((1, first, blob.clone())), "nobody decided on the second one");
    decide(third, 0, Some(CarryRecord { map: None, from: 1, kept: 4, lost: Vec::new() })).await;
    put_in_force(4).await;
    assert_eq!(before().await, Some((1, first, blob)), "what was carried is the first decision");
    put_in_force(3).await;
    decide(third, 2, None).await;
    put_in_force(4).await;
    assert_eq!(before().await.map(|(version, analysis, _)| (version, analysis)), Some((3, third)));
}

pub async fn the_state_of_a_map_changes_with_every_answer_about_it(engine: &impl Engine) {
    let store = engine.store();
    let map = upload(store, "map").await.map;
    let state = async || store.map_state(&local(), map).await.unwrap().expect("the map is there");
    let before = state().await;
    assert_eq!(before, MapState { version: 1, analysis: None, semantics: 0 });

    let first = claim(store, now()).await.unwrap();
    finish(store, &first).await.unwrap();
    let analysed = state().await;
    assert_eq!(analysed.analysis, store.map(&local(), map).await.unwrap().unwrap().analysis);

    let rename = MapPatch { name: Some("hall".into()), georeference: None };
    store.update_map(&local(), map, &rename, None, now()).await.unwrap();
    assert_eq!(state().await, MapState { version: analysed.version + 1, ..analysed });

    let row = NewSemanticsRow {
        map,
        analysis: analysed.analysis.unwrap(),
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
    store.insert_semantics(&local(), &row, now()).await.unwrap().unwrap().unwrap();
    assert_eq!(state().await.semantics, 1);
    let seen = state().await;
    let Request::Existing(_) = request(store, map, 1).await else { panic!("it is there") };
    assert_eq!(state().await, seen, "the same analysis stays in force");
}
