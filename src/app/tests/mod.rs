//! The use cases on a real store: a small hall is uploaded, analysed, and read.

mod sharing;

use std::collections::BTreeMap;
use std::sync::Arc;

use serde_json::json;
use stillage_core::AnalysisOptions;
use stillage_core::semantics::RuleSet;
use stillage_core::spec::CategoryCount;
use tempfile::TempDir;
use uuid::Uuid;

use super::*;
use crate::config::Config;
use crate::coordinates::Georeference;
use crate::ingest::MapSource;

/// A service in its own folder, without job slots: jobs run when a test says so.
struct Service {
    app: Arc<App>,
    _folder: TempDir,
}

impl std::ops::Deref for Service {
    type Target = App;

    fn deref(&self) -> &App {
        &self.app
    }
}

async fn service() -> Service {
    service_with(|_| {}).await
}

async fn service_with(change: impl FnOnce(&mut Config)) -> Service {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut config = Config { min_free_bytes: 0, job_slots: 0, compute_threads: 2, ..Config::new(folder.path()) };
    change(&mut config);
    Service { app: App::open(config).await.expect("it opens"), _folder: folder }
}

fn me() -> Caller {
    Caller::local()
}

/// A walled hall of this width with one rack across, half a metre a cell.
fn hall(width: usize) -> NewMap {
    let height = 12;
    let cell = |column: usize, row: usize| {
        let is_wall = column == 0 || row == 0 || column == width - 1 || row == height - 1;
        let is_rack = (5..7).contains(&row) && (4..width - 4).contains(&column);
        if is_wall || is_rack { 100 } else { 0 }
    };
    let data: Vec<u8> = (0..height).flat_map(|row| (0..width).map(move |column| cell(column, row))).collect();
    let pose = json!({"position": {"x": 0, "y": 0, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}});
    let info = json!({"resolution": 0.5, "width": width, "height": height, "origin": pose});
    let message = json!({"info": info, "data": data}).to_string().into_bytes();
    NewMap {
        source: MapSource::Message(message),
        name: format!("hall {width}"),
        options: AnalysisOptions::default(),
        georeference: None,
        previous: None,
        idempotency_key: None,
    }
}

/// Uploads and analyses.
async fn analysed(service: &Service) -> Uuid {
    let (job, _) = service.create_map(&me(), hall(20)).await.expect("accepted");
    service.run_until_empty().await.expect("the queue empties");
    let job = service.job(&me(), job.id).await.expect("it is there");
    assert_eq!(job.state, JobState::Successful, "{}", job.message);
    job.map
}

#[tokio::test]
async fn an_uploaded_map_is_analysed_and_answers() {
    let service = service().await;
    let (job, is_new) = service.create_map(&me(), hall(20)).await.unwrap();
    assert!(is_new);
    let early = service.context(&me(), job.map).await;
    assert!(matches!(early, Err(AppError::NotAnalysed { job: Some(id), .. }) if id == job.id), "{early:?}");

    service.run_until_empty().await.unwrap();
    let record = service.map(&me(), job.map).await.unwrap();
    assert_eq!((record.width, record.height, record.name.as_str()), (20, 12, "hall 20"));
    let context = service.context(&me(), job.map).await.unwrap();
    assert_eq!(Some(context.analysis_id), record.analysis);
    assert_eq!((context.grid.width(), context.cells.faces.len()), (20, 240));
    assert_eq!(context.semantics.origin, SemanticsOrigin::Suggested);
    let stages = &service.analyses(&me(), job.map).await.unwrap()[0].stages;
    assert_eq!(stages.len(), stillage_core::Stage::ALL.len());
    assert_eq!(service.job_counts().await.unwrap()["successful"], 1);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_context_is_built_once_for_all_who_ask() {
    let service = service().await;
    let map = analysed(&service).await;
    let mut readers = tokio::task::JoinSet::new();
    for _ in 0..100 {
        let app = Arc::clone(&service.app);
        readers.spawn(async move { app.context(&me(), map).await.expect("it answers") });
    }
    let contexts = readers.join_all().await;
    assert!(contexts.iter().all(|context| Arc::ptr_eq(context, &contexts[0])));
}

#[tokio::test]
async fn a_decision_changes_the_answer_and_nothing_is_read_again() {
    let service = service().await;
    let map = analysed(&service).await;
    let before = service.context(&me(), map).await.unwrap();
    let decide = async |rule_set: Option<&str>, if_match| {
        let categories = BTreeMap::from([(0, Some("co".to_owned()))]);
        let change = SemanticsChange { rule_set: rule_set.map(Into::into), categories, ..SemanticsChange::default() };
        service.change_semantics(&me(), map, change, if_match).await
    };
    assert!(matches!(decide(None, None).await, Err(AppError::PreconditionRequired)));
    assert!(matches!(decide(None, Some(3)).await, Err(AppError::PreconditionFailed { current: 0 })));
    let unknown = decide(Some("hospital"), Some(0)).await;
    assert!(
        matches!(&unknown, Err(AppError::Invalid { fields, .. }) if fields[0].pointer == "/ruleSet"),
        "{unknown:?}"
    );

    let (made, lost) = decide(None, Some(0)).await.unwrap();
    assert!(lost.is_empty());
    assert_eq!((made.version, made.rule_set.as_str(), made.origin), (1, "site", SemanticsOrigin::Assigned));
    let after = service.context(&me(), map).await.unwrap();
    assert_eq!(after.semantics, made);
    assert!(Arc::ptr_eq(&before.analysis, &after.analysis) && Arc::ptr_eq(&before.grid, &after.grid));
    assert!(matches!(decide(None, Some(0)).await, Err(AppError::PreconditionFailed { current: 1 })));
    assert_eq!(service.semantics_versions(&me(), map).await.unwrap(), [made]);

    let categories = BTreeMap::from([(0, Some("?".to_owned()))]);
    let wrong = SemanticsChange { categories, ..SemanticsChange::default() };
    let wrong = service.change_semantics(&me(), map, wrong, Some(1)).await;
    assert!(matches!(&wrong, Err(AppError::Invalid { fields, .. }) if !fields.is_empty()), "{wrong:?}");
}

#[tokio::test]
async fn a_decision_is_carried_over_to_other_options_and_the_old_ones_have_it_still() {
    let service = service().await;
    let map = analysed(&service).await;
    let change = SemanticsChange { rule_set: Some("office".into()), ..SemanticsChange::default() };
    service.change_semantics(&me(), map, change, Some(0)).await.unwrap();

    let options = AnalysisOptions { seed: 9, ..AnalysisOptions::default() };
    let AnalysisTicket::Job(_) = service.create_analysis(&me(), map, options, true).await.unwrap() else {
        panic!("it is new")
    };
    service.run_until_empty().await.unwrap();
    let carried = service.semantics(&me(), map).await.unwrap();
    assert_eq!((carried.version, carried.rule_set.as_str(), carried.origin), (2, "office", SemanticsOrigin::Carried));
    assert_eq!(carried.carried.as_ref().map(|carried| carried.from), Some(1));
    assert_eq!(service.context(&me(), map).await.unwrap().semantics, carried, "once");

    let again = service.create_analysis(&me(), map, AnalysisOptions::default(), true).await.unwrap();
    assert!(matches!(again, AnalysisTicket::Existing(_)));
    let semantics = service.semantics(&me(), map).await.unwrap();
    assert_eq!((semantics.version, semantics.rule_set.as_str()), (1, "office"));
}

#[tokio::test]
async fn an_idempotency_key_answers_the_same_job() {
    let service = service_with(|config| config.max_queued_jobs = 1).await;
    let with_key = |width| NewMap { idempotency_key: Some("key".into()), ..hall(width) };
    let (job, is_new) = service.create_map(&me(), with_key(20)).await.unwrap();
    assert!(is_new);
    assert_eq!(service.create_map(&me(), with_key(20)).await.unwrap(), (job, false), "even when the queue is full");
    assert!(matches!(service.create_map(&me(), with_key(21)).await, Err(AppError::Invalid { .. })));
    assert!(matches!(service.create_map(&me(), hall(20)).await, Err(AppError::Busy { retry_after_s: 10 })));
    assert_eq!(service.maps(&me(), 9, None).await.unwrap().len(), 1);
}

#[tokio::test]
async fn a_map_that_cannot_be_analysed_is_refused_at_once() {
    let service = service_with(|config| config.max_job_bytes = 17_000_000).await;
    let refused = service.create_map(&me(), hall(400)).await.expect_err("240 cells fit, 4,800 do not").to_string();
    assert!(refused.starts_with("the analysis of 400 x 12 cells needs about "), "{refused}");
    let broken = NewMap { source: MapSource::Message(b"{}".to_vec()), ..hall(20) };
    assert!(matches!(service.create_map(&me(), broken).await, Err(AppError::Ingest(_))));
    let mut options = hall(20);
    options.options.categorization.k = CategoryCount::Fixed(0);
    let refused = service.create_map(&me(), options).await;
    assert!(
        matches!(&refused, Err(AppError::Invalid { fields, .. }) if fields[0].pointer == "/options/categorization/k"),
        "{refused:?}"
    );
    assert_eq!(service.maps(&me(), 9, None).await.unwrap(), []);
}

#[tokio::test]
async fn without_space_uploads_are_refused_and_reads_go_on() {
    let service = service_with(|config| config.min_free_bytes = u64::MAX).await;
    assert!(matches!(service.create_map(&me(), hall(20)).await, Err(AppError::NoSpace)));
    assert!(matches!(service.ready().await, Err(AppError::NoSpace)));
    assert_eq!(service.maps(&me(), 9, None).await.unwrap(), []);
}

#[tokio::test]
async fn a_map_is_renamed_georeferenced_and_deleted() {
    let service = service().await;
    let map = analysed(&service).await;
    service.context(&me(), map).await.unwrap();
    let version = service.map(&me(), map).await.unwrap().version;
    let patch = |name: &str, lon| MapPatch {
        name: Some(name.into()),
        georeference: Some(Some(Georeference { lon, lat: 56.66, heading: 0.0 }.into())),
    };
    assert!(matches!(
        service.update_map(&me(), map, patch("x", 12.86), Some(99)).await,
        Err(AppError::PreconditionFailed { .. })
    ));
    assert!(matches!(service.update_map(&me(), map, patch("\n", 12.86), None).await, Err(AppError::Invalid { .. })));
    assert!(matches!(service.update_map(&me(), map, patch("x", 181.0), None).await, Err(AppError::Invalid { .. })));
    let record = service.update_map(&me(), map, patch("Halmstad", 12.86), Some(version)).await.unwrap();
    assert_eq!((record.name.as_str(), record.version), ("Halmstad", version + 1));
    assert_eq!(service.context(&me(), map).await.unwrap().record, record, "memory follows");

    service.delete_map(&me(), map, None).await.unwrap();
    assert!(matches!(service.context(&me(), map).await, Err(AppError::NotFound { kind: "map", .. })));
    assert!(matches!(service.delete_map(&me(), map, None).await, Err(AppError::NotFound { .. })));
    assert_eq!(service.jobs(&me(), JobFilter { limit: 9, ..JobFilter::default() }).await.unwrap(), []);
}

#[tokio::test]
async fn a_waiting_job_is_dismissed_a_finished_one_is_not() {
    let service = service().await;
    let (job, _) = service.create_map(&me(), hall(20)).await.unwrap();
    assert_eq!(service.dismiss_job(&me(), job.id).await.unwrap().state, JobState::Dismissed);
    assert!(matches!(service.dismiss_job(&me(), job.id).await, Err(AppError::Conflict(_))));
    assert!(matches!(service.dismiss_job(&me(), Uuid::now_v7()).await, Err(AppError::NotFound { kind: "job", .. })));
}

#[tokio::test]
async fn rule_sets_are_written_with_care_and_the_built_in_ones_not_at_all() {
    let service = service().await;
    let draft = RuleSet::office().draft().clone();
    let ids = async || service.rule_sets(&me()).await.unwrap().into_iter().map(|record| record.id).collect::<Vec<_>>();
    assert_eq!(ids().await, ["site", "warehouse", "office"]);
    for taken in ["site", "warehouse", "office"] {
        assert!(matches!(service.create_rule_set(&me(), taken, draft.clone()).await, Err(AppError::Conflict(_))));
        assert!(matches!(service.delete_rule_set(&me(), taken, Some(1)).await, Err(AppError::Conflict(_))));
    }
    for odd in ["", "-", "Upper", "a b", "../x"] {
        assert!(
            matches!(service.create_rule_set(&me(), odd, draft.clone()).await, Err(AppError::Invalid { .. })),
            "{odd}"
        );
    }
    assert_eq!(service.create_rule_set(&me(), "clinic", draft.clone()).await.unwrap().version, 1);
    assert!(matches!(service.create_rule_set(&me(), "clinic", draft.clone()).await, Err(AppError::Conflict(_))));
    let put = async |if_match| service.put_rule_set(&me(), "clinic", draft.clone(), if_match).await;
    assert!(matches!(put(None).await, Err(AppError::PreconditionRequired)));
    assert_eq!(put(Some(1)).await.unwrap().version, 2);
    assert!(matches!(put(Some(1)).await, Err(AppError::PreconditionFailed { current: 2 })));
    assert!(matches!(
        service.delete_rule_set(&me(), "clinic", Some(1)).await,
        Err(AppError::PreconditionFailed { .. })
    ));
    service.delete_rule_set(&me(), "clinic", Some(2)).await.unwrap();
    assert!(matches!(put(Some(2)).await, Err(AppError::NotFound { .. })));
}

#[tokio::test]
async fn a_stopping_service_is_not_ready() {
    let service = service().await;
    service.ready().await.unwrap();
    service.shutdown().await;
    assert!(matches!(service.ready().await, Err(AppError::Unavailable)));
    assert!(matches!(service.maps(&me(), 9, None).await, Err(AppError::Unavailable)), "a closed store is out of reach");
}

#[tokio::test]
async fn questions_about_maps_that_do_not_exist_push_nothing_out() {
    let service = service_with(|config| config.cached_maps = 1).await;
    let map = analysed(&service).await;
    let context = service.context(&me(), map).await.unwrap();
    for _ in 0..20 {
        assert!(service.context(&me(), Uuid::now_v7()).await.is_err());
    }
    assert!(Arc::ptr_eq(&context, &service.context(&me(), map).await.unwrap()));
    let other = analysed(&service).await;
    service.context(&me(), other).await.unwrap();
    assert!(!Arc::ptr_eq(&context, &service.context(&me(), map).await.unwrap()), "the one used longest ago went");
}
