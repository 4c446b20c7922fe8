//! What every engine must do, tried on each: who may do what, and what survives.
//!
//! A test is a function of an open, empty store. `contract!` runs all of them on one engine.

mod analyses;
mod blobs;
mod capacity;
mod corrections;
mod hidden_maps;
mod keys;
mod maps;
mod queue;
mod registries;
mod tenants;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use jiff::{SignedDuration, Timestamp};
use serde_json::json;
use stillage_core::AnalysisOptions;
use stillage_core::semantics::RuleSetDraft;
use uuid::Uuid;

use super::queue::{Claim, JobResult, Terms};
use super::sql::SqlStore;
use super::*;
use crate::ingest::MapSource;
use crate::records::{JobFilter, JobRecord, JobState, Tenant};

pub use crate::store::sqlite::tests::Fixture;

/// An engine under test.
pub trait Engine: Sized {
    /// An open, empty store; `None` where this machine has no such engine, which was told then.
    async fn empty() -> Option<Self>;

    /// The store.
    fn store(&self) -> &Arc<dyn Store>;

    /// The store by its type.
    fn sql(&self) -> &SqlStore;

    /// The file of a blob.
    fn blob_file(&self, blob: &BlobId) -> PathBuf;

    /// Replaces the bytes of a blob behind the store's back, or removes it.
    fn damage(&self, blob: &BlobId, bytes: Option<&str>) {
        let file = self.blob_file(blob);
        bytes
            .map_or_else(|| std::fs::remove_file(&file), |bytes| std::fs::write(&file, bytes))
            .expect("it can be done");
    }
}

macro_rules! tests_of {
    ($engine:ty: $($topic:ident { $($test:ident)* })*) => {
        $(mod $topic {
            $(#[tokio::test]
            async fn $test() {
                use crate::store::contract::{self, Engine};
                if let Some(engine) = <$engine>::empty().await {
                    contract::$topic::$test(&engine).await;
                }
            })*
        })*
    };
}

macro_rules! contract {
    ($name:ident, $engine:ty) => {
        mod $name {
            tests_of! { $engine:
                blobs {
                    a_damaged_blob_is_an_error_and_a_new_copy_mends_it
                    blobs_without_a_row_are_swept_when_they_are_old
                    deleting_a_map_takes_everything_but_what_others_share
                }
                queue {
                    a_job_is_claimed_once_however_many_ask
                    a_zombie_can_neither_finish_nor_harm
                    an_attempt_given_back_does_not_give_its_token_back
                    a_heartbeat_keeps_the_lease_and_shows_the_progress
                    a_job_that_kills_its_process_fails_after_the_last_attempt
                    where_all_may_have_died_only_deaths_in_one_stage_count
                    a_job_that_was_cut_off_waits_behind_the_others
                    a_job_that_was_cut_off_waits_ten_minutes_behind_fresh_ones
                    a_job_that_failed_or_was_dismissed_runs_once_more
                    a_waiting_job_is_dismissed_at_once_a_running_one_is_asked_to_stop
                    a_full_queue_takes_no_more
                    a_result_may_be_a_document
                }
                maps {
                    an_idempotency_key_stands_for_one_upload
                    lists_are_newest_first_and_paged_by_the_last_seen
                    a_map_is_changed_only_from_the_version_that_was_read
                }
                hidden_maps {
                    a_hidden_map_is_not_there_until_it_is_restored
                    jobs_of_a_hidden_map_wait
                    hidden_maps_are_deleted_by_their_age
                }
                analyses {
                    the_analysis_asked_for_last_answers
                    a_proposal_answers_once_it_is_activated
                    decisions_are_bound_to_their_analysis_and_replace_what_they_saw
                    what_was_decided_before_is_found_for_the_analysis_in_force
                    the_state_of_a_map_changes_with_every_answer_about_it
                }
                corrections {
                    a_list_never_changes_and_ids_are_never_used_twice
                    what_was_decided_before_a_time_or_a_version_is_found
                    what_was_carried_from_another_map_is_the_decision_of_this_one
                }
                registries {
                    a_registry_is_changed_only_from_the_version_that_was_read
                    maps_of_a_site_share_its_registry_and_it_ends_with_the_last
                }
                keys {
                    a_key_is_found_by_its_id_and_revoked_for_good
                    the_log_of_changes_is_read_by_its_tenant_and_forgotten_by_age
                    a_change_and_its_entry_are_there_together_or_neither_is
                }
                capacity {
                    a_tenant_has_no_more_than_it_may_and_others_do_not_notice
                    what_is_stored_of_a_tenant_counts_upload_and_result
                    what_an_earlier_release_stored_counts_once_it_is_measured
                    tenants_are_served_in_turn
                    a_tenant_runs_no_more_jobs_than_it_may
                }
                tenants {
                    what_belongs_to_another_tenant_is_not_there
                    two_tenants_may_use_the_same_names
                }
            }
        }
    };
}

contract!(sqlite, crate::store::sqlite::tests::Embedded);
#[cfg(feature = "postgres")]
contract!(postgres, crate::store::postgres::tests::OnServer);

pub const TERMS: Terms = Terms {
    lease: Duration::from_secs(30),
    max_attempts: 3,
    running_of_tenant: u64::MAX,
    backoff: |_, _| Duration::from_secs(5),
    in_touch_since: Timestamp::MIN,
};

/// The process that test jobs name.
pub const PROCESS: &str = "test";

pub fn local() -> Tenant {
    Tenant::local()
}

/// A job whose inputs are the seed of its options.
fn job_of(map: Uuid, source: &BlobId, seed: u64) -> NewJob {
    let inputs = json!({"seed": seed});
    let address = ResultAddress::of(source, PROCESS, 1, &inputs);
    NewJob { id: Uuid::now_v7(), map, process: PROCESS, inputs, address, activates: true }
}

fn with_seed(seed: u64) -> AnalysisOptions {
    AnalysisOptions { seed, ..AnalysisOptions::default() }
}

/// Stores an upload with these bytes and answers its job.
pub async fn upload(store: &Arc<dyn Store>, content: &str) -> JobRecord {
    match try_upload(store, &local(), content, None, u64::MAX).await {
        Upload::New(job) => job,
        other => panic!("not a new upload: {other:?}"),
    }
}

async fn try_upload(
    store: &Arc<dyn Store>,
    tenant: &Tenant,
    content: &str,
    key: Option<&IdempotencyKey>,
    max_queued: u64,
) -> Upload {
    let map = map_row(content);
    let source = Blob::encode(&MapSource::Message(content.as_bytes().to_vec()));
    let job = job_of(map.id, source.id(), 1);
    store
        .create_map(tenant, &map, &source, &job, key, &Capacity::queue(max_queued), now())
        .await
        .expect("the upload is stored")
}

/// The first map of a site.
fn map_row(name: &str) -> NewMapRow {
    let id = Uuid::now_v7();
    NewMapRow {
        id,
        name: name.to_owned(),
        width: 4,
        height: 3,
        resolution: 0.05,
        georeference: None,
        site: id,
        alignment: None,
        warnings: Vec::new(),
    }
}

/// Asks for the analysis with a seed.
async fn request(store: &Arc<dyn Store>, map: Uuid, seed: u64) -> Request {
    let source = store.map_source(&local(), map).await.expect("it answers").expect("the map is there");
    let job = job_of(map, &source, seed);
    let request = store.request_analysis(&local(), &with_seed(seed), &job, &Capacity::queue(9), now()).await;
    request.expect("it answers").expect("the map is there")
}

pub fn draft() -> RuleSetDraft {
    RuleSetDraft { labels: Vec::new(), cogency: None }
}

fn later(seconds: i64) -> Timestamp {
    now() + SignedDuration::from_secs(seconds)
}

async fn claim(store: &Arc<dyn Store>, at: Timestamp) -> Option<Claim> {
    store.claim(&TERMS, at).await.expect("the queue answers")
}

async fn finish(store: &Arc<dyn Store>, claim: &Claim) -> Result<(), StoreError> {
    let options = with_seed(claim.inputs["seed"].as_u64().expect("a seed"));
    let analysis = NewAnalysis { id: Uuid::now_v7(), options, diagnostics: Vec::new() };
    let blob = Blob::new(format!("result of {}", claim.job).into_bytes());
    store.finish(claim, &JobResult::Analysis(Box::new(analysis), blob), &[], now()).await
}

async fn state(store: &Arc<dyn Store>, job: Uuid) -> (JobState, u32) {
    let record = store.job(&local(), job).await.expect("the store answers").expect("the job is there");
    (record.state, record.attempt)
}

/// How many maps, analyses and jobs there are.
async fn counts(store: &Arc<dyn Store>) -> (usize, usize, usize) {
    let maps = store.maps(&local(), u32::MAX, None).await.expect("a list of maps");
    let mut analyses = 0;
    for map in &maps {
        analyses += store.analyses(&local(), map.id).await.expect("a list of analyses").len();
    }
    let filter = JobFilter { limit: u32::MAX, ..JobFilter::default() };
    (maps.len(), analyses, store.jobs(&local(), &filter).await.expect("a list of jobs").len())
}
