//! Killed at every place that matters.

use std::time::{Duration, Instant};

use serde_json::Value;

use crate::audit::{self, Ledger};
use crate::deployment::Deployment;
use crate::server::{self, Server, map_message};
use crate::settings::{AT_ONCE, PATIENCE};

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
fn what_was_changed_before_a_crash_is_in_the_log_of_changes() {
    for (point, maps) in [("before-upload-commit", 0), ("after-upload-commit", 1)] {
        let folder = Deployment::embedded();
        let arguments = ["--keys", "required"];
        let key = format!("Bearer {}", folder.new_key("read,write,admin"));
        let mut server = Server::start(&folder, Some(point), &arguments).expect("nothing to die of yet");
        let upload = ureq::post(format!("{}/v1/maps", server.address())).header("authorization", &key);
        assert!(upload.send_json(map_message(0)).is_err(), "it dies before it answers");
        assert_eq!(server.wait_for_death(PATIENCE), Some(9), "{point}");

        let server = Server::start(&folder, None, &arguments).expect("the next process starts");
        let list = |path: &str, name: &str| {
            let asked = ureq::get(format!("{}{path}", server.address())).header("authorization", &key);
            let list: Value = asked.call().expect("it answers").body_mut().read_json().expect("is JSON");
            list[name].as_array().expect("a list").clone()
        };
        let mut entries = list("/v1/audit-log", "entries");
        entries.retain(|entry| entry["operation"] == "createMap");
        assert_eq!((list("/v1/maps", "maps").len(), entries.len()), (maps, maps), "{point}: {entries:?}");
        assert!(entries.iter().all(|entry| entry["status"] == 499), "nobody was answered: {entries:?}");
        server.stop();
    }
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
fn a_second_process_does_not_start_on_the_same_folder() {
    let folder = Deployment::embedded();
    let server = Server::start(&folder, None, &[]).expect("it starts");
    let output = server::command(&folder, &[]).output().expect("it runs");
    assert!(!output.status.success());
    let refusal = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(refusal.contains("is in use by another process (pid "), "{refusal}");
    server.stop();
}
