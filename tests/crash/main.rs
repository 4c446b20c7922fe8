//! The real server, killed with SIGKILL at every place that matters, and asked afterwards whether all is in order.
//!
//! What must hold, whatever dies and when ([`audit::Ledger::check`]): every job that was accepted ends successful exactly
//! once; nothing is lost, nothing is there twice, nothing is there by half.
//!
//! `STILLAGE_CRASH_JOBS=2000 STILLAGE_CRASH_KILLS=1000 cargo test --test crash random` runs the long campaign. That the
//! harness can fail is shown by the queue's own tests: there, a worker that lost its claim tries to finish.

mod audit;
mod server;

use std::time::{Duration, Instant};

use audit::Ledger;
use server::{Dice, Server, map_message};

/// Long enough for a debug build on a busy machine.
const PATIENCE: Duration = Duration::from_mins(2);

/// Kills at one fail point while jobs come in, starts again without it, and audits.
fn dies_and_recovers(point: &str) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut ledger = Ledger::default();
    let mut server = Server::start(folder.path(), Some(point), &[]).expect("nothing to die of yet");
    for index in 0..3 {
        let key = format!("{point}-{index}");
        // A request that the crash cuts off gets no answer, so nothing was promised.
        if let Some(job) = server.upload(&map_message(index), &key) {
            ledger.accepted(&key, &job);
        }
    }
    assert_eq!(server.wait_for_death(PATIENCE), Some(9), "{point}: it dies by SIGKILL");

    let server = Server::start(folder.path(), None, &[]).expect("the next process starts");
    server.wait_until_idle(PATIENCE);
    server.stop();
    ledger.check(folder.path());
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
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut server = Server::start(folder.path(), None, &[]).expect("it starts");
    let mut ledger = Ledger::default();
    ledger.accepted("kept", &server.upload(&map_message(0), "kept").expect("accepted"));
    let map = server.maps().pop().expect("one map");
    server.delete(&format!("/v1/maps/{map}"));
    server.kill();

    let server = Server::start(folder.path(), None, &[]).expect("the next process starts");
    assert_eq!(server.maps(), Vec::<String>::new());
    server.post(&format!("/v1/maps/{map}/restore"));
    assert_eq!(server.maps(), [map]);
    server.wait_until_idle(PATIENCE);
    server.stop();
    ledger.check_exactly(folder.path());
}

#[test]
fn dies_while_it_deletes_a_map() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut server = Server::start(folder.path(), Some("after-delete-commit"), &AT_ONCE).expect("it starts");
    server.upload(&map_message(0), "gone").expect("accepted");
    server.wait_until_idle(PATIENCE);
    let map = server.maps().pop().expect("one map");
    server.delete(&format!("/v1/maps/{map}"));
    assert_eq!(server.wait_for_death(PATIENCE), Some(9));

    let server = Server::start(folder.path(), None, &[]).expect("the next process starts");
    assert_eq!(server.maps(), Vec::<String>::new(), "its rows are gone");
    server.stop();
    Ledger::default().check(folder.path());
}

#[test]
fn a_job_that_kills_the_service_is_given_up_after_the_last_attempt() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let arguments = ["--max-attempts", "3"];
    let mut server = Server::start(folder.path(), Some("during-compute"), &arguments).expect("it starts");
    let job = server.upload(&map_message(0), "poison").expect("accepted");
    let mut deaths = 0;
    while let Some(signal) = server.wait_for_death_or_idle(PATIENCE) {
        assert_eq!(signal, 9);
        deaths += 1;
        server = loop {
            match Server::start(folder.path(), Some("during-compute"), &arguments) {
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

#[test]
fn random_kills_lose_nothing_and_double_nothing() {
    let setting = |name: &str, default: u64| std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default);
    let (jobs, kills) = (setting("STILLAGE_CRASH_JOBS", 40), setting("STILLAGE_CRASH_KILLS", 20));
    let mut dice = Dice::new(setting("STILLAGE_CRASH_SEED", 1));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut ledger = Ledger::default();
    // Kills are no fault of the jobs here, so they may happen to one of them as often as they like.
    let arguments = ["--max-attempts", "1000000", "--max-queued-jobs", "1000000"];
    let mut killed = 0;
    while killed < kills || ledger.len() < jobs {
        let Some(mut server) = Server::start(folder.path(), None, &arguments) else {
            panic!("the server does not start after {killed} kills");
        };
        let death = Instant::now() + Duration::from_millis(dice.below(400));
        while ledger.len() < jobs && Instant::now() < death {
            // Until it is answered, an upload is sent again under the same key: that must not make two.
            let index = ledger.len();
            if let Some(job) = server.upload(&map_message(index), &index.to_string()) {
                ledger.accepted(&index.to_string(), &job);
            }
            if dice.below(4) == 0 {
                break;
            }
        }
        std::thread::sleep(death.saturating_duration_since(Instant::now()));
        if killed < kills {
            server.kill();
            killed += 1;
        }
    }
    let server = Server::start(folder.path(), None, &arguments).expect("it starts");
    server.wait_until_idle(PATIENCE + Duration::from_millis(500 * jobs));
    server.stop();
    ledger.check_exactly(folder.path());
    println!("{killed} kills over {jobs} jobs, {} of them cut off at least once", audit::interrupted(folder.path()));
}

#[test]
fn told_to_stop_it_goes_in_order_and_burns_no_attempt() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut ledger = Ledger::default();
    for round in 0..3 {
        let server = Server::start(folder.path(), None, &["--shutdown-grace-s", "0"]).expect("it starts");
        for index in 0..4 {
            let key = format!("{round}-{index}");
            let job = server.upload(&map_message(index), &key).expect("accepted");
            ledger.accepted(&key, &job);
        }
        let begun = Instant::now();
        server.stop();
        assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
        audit::check_no_attempt_was_burnt(folder.path());
    }
    let server = Server::start(folder.path(), None, &[]).expect("it starts");
    server.wait_until_idle(PATIENCE);
    server.stop();
    ledger.check_exactly(folder.path());
}

#[test]
fn a_second_process_does_not_start_on_the_same_folder() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let server = Server::start(folder.path(), None, &[]).expect("it starts");
    let output = server::command(folder.path(), &[]).output().expect("it runs");
    assert!(!output.status.success());
    let refusal = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(refusal.contains("is in use by another process (pid "), "{refusal}");
    server.stop();
}
