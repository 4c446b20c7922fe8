//! The real server, killed with SIGKILL at every place that matters, and asked afterwards whether all is in order.
//!
//! What must hold, whatever dies and when ([`audit::Ledger::check`]): every job that was accepted ends successful exactly
//! once; nothing is lost, nothing is there twice, nothing is there by half.
//!
//! `STILLAGE_CRASH_JOBS=2000 STILLAGE_CRASH_KILLS=1000 cargo test --test crash nothing` runs the long campaigns: one
//! process on SQLite, two processes on one PostgreSQL. That the harness can fail is shown by taking the fence out of the
//! database: then it finds two results of one job.

mod audit;
mod deployment;
#[path = "../servers/object_store.rs"]
mod object_store;
#[path = "../servers/postgres.rs"]
mod postgres;
mod server;

use std::time::{Duration, Instant};

use audit::Ledger;
use deployment::Deployment;
use object_store::{ObjectStore, Program};
use server::{Dice, Server, hall_message, map_message};

/// Long enough for a debug build on a busy machine.
const PATIENCE: Duration = Duration::from_mins(2);

/// Kills at one fail point while jobs come in, starts again without it, and audits.
fn dies_and_recovers(point: &str) {
    dies_and_recovers_on(&Deployment::embedded(), point);
    if let Some(shared) = Deployment::shared() {
        dies_and_recovers_on(&shared, point);
    }
}

fn dies_and_recovers_on(folder: &Deployment, point: &str) {
    let mut ledger = Ledger::default();
    let mut server = Server::start(folder, Some(point), &[]).expect("nothing to die of yet");
    for index in 0..3 {
        let key = format!("{point}-{index}");
        // A request that the crash cuts off gets no answer, so nothing was promised.
        if let Some(job) = server.upload(&map_message(index), &key) {
            ledger.accepted(&key, &job);
        }
    }
    assert_eq!(server.wait_for_death(PATIENCE), Some(9), "{point}: it dies by SIGKILL");

    let server = Server::start(folder, None, &[]).expect("the next process starts");
    server.wait_until_idle(PATIENCE);
    server.stop();
    ledger.check(folder);
}

#[test]
fn dies_with_an_upload_in_its_hands() {
    dies_and_recovers("after-upload-blob");
    dies_and_recovers("before-upload-commit");
    dies_and_recovers("after-upload-commit");
}

#[test]
fn dies_with_a_job_in_its_hands() {
    dies_and_recovers("after-claim");
    dies_and_recovers("before-compute");
    dies_and_recovers("during-compute");
}

#[test]
fn dies_with_a_result_in_its_hands() {
    dies_and_recovers("after-blob");
    dies_and_recovers("before-finish-commit");
    dies_and_recovers("after-finish-commit");
}

/// Deleted maps are not kept.
const AT_ONCE: [&str; 2] = ["--keep-deleted-minutes", "0"];

#[test]
fn a_deleted_map_can_be_restored_after_a_crash() {
    let folder = Deployment::embedded();
    let mut server = Server::start(&folder, None, &[]).expect("it starts");
    let mut ledger = Ledger::default();
    ledger.accepted("kept", &server.upload(&map_message(0), "kept").expect("accepted"));
    let map = server.maps().pop().expect("one map");
    server.delete(&format!("/v1/maps/{map}"));
    server.kill();

    let server = Server::start(&folder, None, &[]).expect("the next process starts");
    assert_eq!(server.maps(), Vec::<String>::new());
    server.post(&format!("/v1/maps/{map}/restore"));
    assert_eq!(server.maps(), [map]);
    server.wait_until_idle(PATIENCE);
    server.stop();
    ledger.check_exactly(&folder);
}

#[test]
fn dies_while_it_deletes_a_map() {
    let folder = Deployment::embedded();
    let mut server = Server::start(&folder, Some("after-delete-commit"), &AT_ONCE).expect("it starts");
    server.upload(&map_message(0), "gone").expect("accepted");
    server.wait_until_idle(PATIENCE);
    let map = server.maps().pop().expect("one map");
    server.delete(&format!("/v1/maps/{map}"));
    assert_eq!(server.wait_for_death(PATIENCE), Some(9));

    let server = Server::start(&folder, None, &[]).expect("the next process starts");
    assert_eq!(server.maps(), Vec::<String>::new(), "its rows are gone");
    server.stop();
    Ledger::default().check(&folder);
}

#[test]
fn a_job_that_kills_the_service_is_given_up_after_the_last_attempt() {
    let folder = Deployment::embedded();
    let arguments = ["--max-attempts", "3"];
    let mut server = Server::start(&folder, Some("during-compute"), &arguments).expect("it starts");
    let job = server.upload(&map_message(0), "poison").expect("accepted");
    let mut deaths = 0;
    while let Some(signal) = server.wait_for_death_or_idle(PATIENCE) {
        assert_eq!(signal, 9);
        deaths += 1;
        server = loop {
            match Server::start(&folder, Some("during-compute"), &arguments) {
                Some(server) => break server,
                None => deaths += 1,
            }
        };
    }
    assert_eq!(deaths, 3);
    let job = server.get(&job);
    assert_eq!(job["status"], "failed");
    assert_eq!(job["message"], "given up: the service died or stalled in each of 3 attempts");
    server.stop();
}

/// Kills are no fault of the jobs here, so they may happen to one of them as often as they like.
const PATIENT: [&str; 4] = ["--max-attempts", "1000000", "--max-queued-jobs", "1000000"];

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(default)
}

#[test]
fn random_kills_lose_nothing_and_double_nothing() {
    let (jobs, kills) = (setting("STILLAGE_CRASH_JOBS", 40), setting("STILLAGE_CRASH_KILLS", 20));
    let mut dice = Dice::new(setting("STILLAGE_CRASH_SEED", 1));
    let folder = Deployment::embedded();
    let mut ledger = Ledger::default();
    let mut killed = 0;
    while killed < kills || ledger.len() < jobs {
        let Some(mut server) = Server::start(&folder, None, &PATIENT) else {
            panic!("the server does not start after {killed} kills");
        };
        let death = Instant::now() + Duration::from_millis(dice.below(400));
        upload_until(&mut ledger, &server, jobs, death, &mut dice);
        std::thread::sleep(death.saturating_duration_since(Instant::now()));
        if killed < kills {
            server.kill();
            killed += 1;
        }
    }
    let server = Server::start(&folder, None, &PATIENT).expect("it starts");
    server.wait_until_idle(PATIENCE + Duration::from_millis(500 * jobs));
    server.stop();
    ledger.check_exactly(&folder);
    println!("{killed} kills over {jobs} jobs, {} of them cut off at least once", audit::interrupted(&folder));
}

/// Uploads until the time is over, or chance says so.
fn upload_until(ledger: &mut Ledger, server: &Server, jobs: u64, end: Instant, dice: &mut Dice) {
    while ledger.len() < jobs && Instant::now() < end {
        // Until it is answered, an upload is sent again under the same key: that must not make two.
        let index = ledger.len();
        if let Some(job) = server.upload(&map_message(index), &index.to_string()) {
            ledger.accepted(&index.to_string(), &job);
        }
        if dice.below(4) == 0 {
            break;
        }
    }
}

/// Two processes share a database; again and again one of them is killed, or stands still for longer than its lease and goes
/// on. Answers how many were killed.
fn kill_and_freeze(deployment: &Deployment, ledger: &mut Ledger, jobs: u64, kills: u64) -> u64 {
    let mut dice = Dice::new(setting("STILLAGE_CRASH_SEED", 1));
    let start = || Server::start(deployment, None, &PATIENT).expect("it starts");
    let mut servers = [start(), start()];
    let mut killed = 0;
    while killed < kills || ledger.len() < jobs {
        let victim = dice.below(2) as usize;
        let end = Instant::now() + Duration::from_millis(dice.below(400));
        upload_until(ledger, &servers[1 - victim], jobs, end, &mut dice);
        std::thread::sleep(end.saturating_duration_since(Instant::now()));
        if dice.below(8) == 0 {
            servers[victim].freeze();
            std::thread::sleep(LONGER_THAN_A_LEASE);
            servers[victim].thaw();
        } else {
            servers[victim].kill();
            servers[victim] = start();
            killed += 1;
        }
    }
    let [first, second] = servers;
    first.wait_until_idle(PATIENCE * 10);
    first.stop();
    second.stop();
    killed
}

/// Leases of shared deployments last two seconds here, and the wait after the first attempt five.
const LONGER_THAN_A_LEASE: Duration = Duration::from_secs(8);

/// A process stands still with a job in its hands until another one has done it, goes on, and ends.
fn wakes_after_its_job_was_done(deployment: &Deployment, ledger: &mut Ledger) {
    let sleeper = Server::start(deployment, None, &PATIENT).expect("it starts");
    let other = Server::start(deployment, None, &["--role", "api"]).expect("it starts");
    let job = other.upload(&hall_message(1_000, 600), "hall").expect("accepted");
    ledger.accepted("hall", &job);
    other.wait_until_busy(PATIENCE);
    sleeper.freeze();
    let heir = Server::start(deployment, None, &PATIENT).expect("it starts");
    let begun = Instant::now();
    while audit::unfinished(deployment) > 0 {
        assert!(begun.elapsed() < PATIENCE, "nobody takes the job");
        std::thread::sleep(Duration::from_millis(100));
    }
    sleeper.thaw();
    // It computes to its end, and hands in what it has.
    std::thread::sleep(LONGER_THAN_A_LEASE);
    for server in [sleeper, other, heir] {
        server.stop();
    }
}

#[test]
fn a_process_that_wakes_after_its_job_was_done_changes_nothing() {
    let Some(deployment) = Deployment::shared() else { return };
    let mut ledger = Ledger::default();
    wakes_after_its_job_was_done(&deployment, &mut ledger);
    ledger.check_exactly(&deployment);
    assert_eq!(audit::interrupted(&deployment), 1, "the heir began it again");
}

/// Every claim of a job has the same token, its end does not end it, and it may have two results.
const TAKE_THE_FENCE_AWAY: &[&str] = &[
    "CREATE FUNCTION forget() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN \
         NEW.claim := 1; \
         IF NEW.state = 'successful' THEN NEW.state := 'running'; NEW.lease_until := 9000000000000000; END IF; \
         RETURN NEW; \
     END $$",
    "CREATE TRIGGER forget BEFORE UPDATE ON jobs FOR EACH ROW EXECUTE FUNCTION forget()",
    "ALTER TABLE analyses DROP CONSTRAINT analyses_job_key, DROP CONSTRAINT analyses_map_address_key",
];

/// Afterwards jobs with a result have ended.
const PUT_IT_BACK: &[&str] = &[
    "DROP TRIGGER forget ON jobs",
    "UPDATE jobs SET state = 'successful', lease_until = NULL WHERE outputs IS NOT NULL",
];

#[test]
fn without_the_fence_the_audit_finds_two_results_of_one_job() {
    let Some(deployment) = Deployment::shared() else { return };
    Server::start(&deployment, None, &[]).expect("it makes the tables").stop();
    audit::change(&deployment, TAKE_THE_FENCE_AWAY);
    let mut ledger = Ledger::default();
    wakes_after_its_job_was_done(&deployment, &mut ledger);
    audit::change(&deployment, PUT_IT_BACK);
    let audit = std::panic::catch_unwind(|| ledger.check_exactly(&deployment)).expect_err("all seems well");
    let finding = audit.downcast_ref::<String>().expect("a message");
    assert!(finding.contains("successful jobs without exactly their one result"), "{finding}");
}

#[test]
fn processes_that_share_a_database_lose_nothing_and_double_nothing() {
    let Some(deployment) = Deployment::shared() else { return };
    let (jobs, kills) = (setting("STILLAGE_CRASH_JOBS", 30), setting("STILLAGE_CRASH_KILLS", 15));
    let mut ledger = Ledger::default();
    let killed = kill_and_freeze(&deployment, &mut ledger, jobs, kills);
    ledger.check_exactly(&deployment);
    println!("{killed} kills over {jobs} jobs, {} of them cut off at least once", audit::interrupted(&deployment));
}

#[test]
fn told_to_stop_it_goes_in_order_and_burns_no_attempt() {
    let folder = Deployment::embedded();
    let mut ledger = Ledger::default();
    for round in 0..3 {
        let server = Server::start(&folder, None, &["--shutdown-grace-s", "0"]).expect("it starts");
        for index in 0..4 {
            let key = format!("{round}-{index}");
            let job = server.upload(&map_message(index), &key).expect("accepted");
            ledger.accepted(&key, &job);
        }
        let begun = Instant::now();
        server.stop();
        assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
        audit::check_no_attempt_was_burnt(&folder);
    }
    let server = Server::start(&folder, None, &[]).expect("it starts");
    server.wait_until_idle(PATIENCE);
    server.stop();
    ledger.check_exactly(&folder);
}

#[test]
fn blobs_in_a_bucket_outlive_their_process_and_go_with_their_map() {
    for program in [Program::Moto, Program::SeaweedFs] {
        let (Some(deployment), Some(bucket)) = (Deployment::shared(), ObjectStore::start(program)) else { continue };
        let deployment = deployment.with_bucket(bucket);
        let mut server = Server::start(&deployment, Some("after-blob"), &AT_ONCE).expect("it starts");
        server.upload(&map_message(0), "hall").expect("accepted");
        assert_eq!(server.wait_for_death(PATIENCE), Some(9));

        let server = Server::start(&deployment, None, &AT_ONCE).expect("the next process starts");
        server.wait_until_idle(PATIENCE);
        let map = server.maps().pop().expect("one map");
        let faces = server.get(&format!("/v1/maps/{map}/collections/faces/items"));
        assert!(faces["numberMatched"].as_u64().is_some_and(|count| count > 0), "{faces}");
        server.delete(&format!("/v1/maps/{map}"));
        assert_eq!(server.maps(), Vec::<String>::new());
        server.stop();
    }
}

#[test]
fn a_second_process_does_not_start_on_the_same_folder() {
    let folder = Deployment::embedded();
    let server = Server::start(&folder, None, &[]).expect("it starts");
    let output = server::command(&folder, &[]).output().expect("it runs");
    assert!(!output.status.success());
    let refusal = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(refusal.contains("is in use by another process (pid "), "{refusal}");
    server.stop();
}
