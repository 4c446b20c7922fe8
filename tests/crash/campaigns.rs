//! Killed and frozen at random, many times, and what happens without the fence.

use std::time::{Duration, Instant};

use crate::audit::{self, Ledger};
use crate::deployment::Deployment;
use crate::server::{Dice, Server, hall_message, map_message};
use crate::settings::{LONGER_THAN_A_LEASE, PATIENCE, PATIENT, setting};

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

/// A process stands still with a job in its hands until another one has done it, goes on, and ends.
fn wakes_after_its_job_was_done(deployment: &Deployment, ledger: &mut Ledger) {
    let sleeper = Server::start(deployment, None, &PATIENT).expect("it starts");
    let other = Server::start(deployment, None, &["--role", "api"]).expect("it starts");
    let job = other.upload(&hall_message(500, 300), "hall").expect("accepted");
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

/// Waits until a job is in another stage than `last`: in which.
fn another_stage(server: &Server, job: &str, last: Option<&str>) -> String {
    let begun = Instant::now();
    loop {
        let job = server.get(job);
        match job["stage"].as_str() {
            Some(stage) if Some(stage) != last => return stage.to_owned(),
            _ => assert!(begun.elapsed() < PATIENCE, "no other stage than {last:?}: {job}"),
        }
    }
}

#[test]
fn a_machine_that_dies_with_all_its_processes_is_no_fault_of_its_jobs() {
    let Some(deployment) = Deployment::shared() else { return };
    // The second death would fail the job, if it counted.
    let start = || Server::start(&deployment, None, &["--max-attempts", "2"]).expect("it starts");
    let mut ledger = Ledger::default();
    let mut processes = [start(), start()];
    let job = processes[0].upload(&hall_message(1_000, 600), "hall").expect("accepted");
    ledger.accepted("hall", &job);
    let job = &job[job.find("/v1/").expect("a path")..];
    let mut stages: Vec<String> = Vec::new();
    for _ in 0..3 {
        stages.push(another_stage(&processes[0], job, stages.last().map(String::as_str)));
        processes.iter_mut().for_each(Server::kill);
        processes = [start(), start()];
    }
    processes[0].wait_until_idle(PATIENCE);
    processes.into_iter().for_each(Server::stop);
    ledger.check_exactly(&deployment);
    println!("the machine died in the stages {stages:?}");
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
    // A process that notices first that it slept for too long hands in nothing, with or without the fence.
    for _ in 0..5 {
        let Some(deployment) = Deployment::shared() else { return };
        Server::start(&deployment, None, &[]).expect("it makes the tables").stop();
        audit::change(&deployment, TAKE_THE_FENCE_AWAY);
        let mut ledger = Ledger::default();
        wakes_after_its_job_was_done(&deployment, &mut ledger);
        audit::change(&deployment, PUT_IT_BACK);
        if let Err(audit) = std::panic::catch_unwind(|| ledger.check_exactly(&deployment)) {
            let finding = audit.downcast_ref::<String>().expect("a message");
            assert!(finding.contains("successful jobs without exactly their one result"), "{finding}");
            return;
        }
    }
    panic!("all seems well");
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
