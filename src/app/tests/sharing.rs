//! One store for several processes and several callers.

use super::*;
use crate::jobs::processes::Processes;
use crate::records::Tenant;

#[tokio::test]
async fn what_another_process_changes_is_seen_at_the_next_question() {
    // Two services on one store, as two processes on one database.
    let service = service().await;
    let config = service.config().clone();
    let other = App::start(config.clone(), Arc::clone(&service.app.store), None, Processes::standard(config.limits));
    let map = analysed(&service).await;
    let before = other.context(&me(), map).await.unwrap();
    assert!(Arc::ptr_eq(&before, &other.context(&me(), map).await.unwrap()), "nothing has changed");

    let patch = MapPatch { name: Some("Hall".into()), georeference: None };
    service.update_map(&me(), map, patch, None).await.unwrap();
    assert_eq!(other.context(&me(), map).await.unwrap().record.name, "Hall");

    let change = SemanticsChange { rule_set: Some("office".into()), ..SemanticsChange::default() };
    service.change_semantics(&me(), map, change, Some(0)).await.unwrap();
    let decided = other.context(&me(), map).await.unwrap();
    assert_eq!((decided.semantics.version, decided.semantics.rule_set.as_str()), (1, "office"));
    assert!(Arc::ptr_eq(&before.analysis, &decided.analysis), "the geometry is not read again");

    let options = AnalysisOptions { seed: 9, ..AnalysisOptions::default() };
    service.create_analysis(&me(), map, options, true).await.unwrap();
    service.run_until_empty().await.unwrap();
    assert_eq!(other.context(&me(), map).await.unwrap().analysis.options.seed, 9);

    service.delete_map(&me(), map, None).await.unwrap();
    assert!(matches!(other.context(&me(), map).await, Err(AppError::NotFound { kind: "map", .. })));
}

#[tokio::test]
async fn what_belongs_to_another_caller_is_not_found() {
    let service = service().await;
    let (job, _) = service.create_map(&me(), hall(20)).await.unwrap();
    service.run_until_empty().await.unwrap();
    service.context(&me(), job.map).await.unwrap();
    service.create_rule_set(&me(), "clinic", RuleSet::office().draft().clone()).await.unwrap();

    let other = Caller::of(Tenant::new("other"));
    let not_found = |error: AppError| assert!(matches!(error, AppError::NotFound { .. }), "{error:?}");
    not_found(service.map(&other, job.map).await.unwrap_err());
    not_found(service.context(&other, job.map).await.unwrap_err());
    not_found(service.analyses(&other, job.map).await.unwrap_err());
    not_found(service.create_analysis(&other, job.map, AnalysisOptions::default(), true).await.unwrap_err());
    not_found(service.semantics(&other, job.map).await.unwrap_err());
    not_found(service.semantics_versions(&other, job.map).await.unwrap_err());
    let change = SemanticsChange::default();
    not_found(service.change_semantics(&other, job.map, change, Some(0)).await.unwrap_err());
    not_found(service.update_map(&other, job.map, MapPatch::default(), None).await.unwrap_err());
    not_found(service.delete_map(&other, job.map, None).await.unwrap_err());
    not_found(service.job(&other, job.id).await.unwrap_err());
    not_found(service.dismiss_job(&other, job.id).await.unwrap_err());
    not_found(service.rule_set(&other, "clinic").await.unwrap_err());
    not_found(service.delete_rule_set(&other, "clinic", Some(1)).await.unwrap_err());
    assert_eq!(service.maps(&other, 9, None).await.unwrap(), []);
    assert_eq!(service.jobs(&other, JobFilter { limit: 9, ..JobFilter::default() }).await.unwrap(), []);
    assert_eq!(service.rule_sets(&other).await.unwrap().len(), 3, "the built-in ones");
    service.context(&me(), job.map).await.expect("for its owner it is there");
}
