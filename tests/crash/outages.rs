//! The database crashes, or cannot be reached.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::audit::{self, Ledger};
use crate::deployment::Deployment;
use crate::postgres;
use crate::proxy::{Fault, Proxy};
use crate::server::{Answer, Dice, Server, hall_message, map_message};
use crate::settings::{LONGER_THAN_A_LEASE, PATIENCE, PATIENT, setting};

/// After this time at the latest a service works again whose database does.
const BACK: Duration = Duration::from_secs(5);

/// After this time at the latest a client knows that the database does not answer.
const PATIENCE_OF_A_CLIENT: Duration = Duration::from_secs(20);

/// A job is done by another process so long after the end of its lease.
const RESCUE: Duration = Duration::from_secs(45);

/// How many answers of each status there were.
#[derive(Debug, Default)]
struct Answers(BTreeMap<u16, u64>);

impl Answers {
    /// Counts an answer: success, or 503 with the time to come back.
    fn count(&mut self, answer: &Answer) {
        let is_right = match answer.status {
            200 | 202 => true,
            503 => answer.says_when_to_come_back,
            _ => false,
        };
        assert!(is_right, "{answer:?}");
        *self.0.entry(answer.status).or_default() += 1;
    }
}

/// Uploads one map after the other, each until it is accepted.
fn upload_while(server: &Server, ledger: &mut Ledger, is_over: &AtomicBool) -> Answers {
    let mut answers = Answers::default();
    while !is_over.load(Ordering::Relaxed) {
        let key = ledger.len().to_string();
        let answer = server.try_upload(&map_message(ledger.len()), &key).expect("it answers");
        answers.count(&answer);
        if let Some(job) = answer.location {
            ledger.accepted(&key, &job);
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    answers
}

fn read_while(server: &Server, is_over: &AtomicBool) -> Answers {
    let mut answers = Answers::default();
    while !is_over.load(Ordering::Relaxed) {
        answers.count(&server.ask("/v1/maps?limit=5").expect("it answers"));
        std::thread::sleep(Duration::from_millis(10));
    }
    answers
}

/// Waits until a server answers again: for how long.
fn back_after(server: &Server) -> Duration {
    let begun = Instant::now();
    while server.ask("/v1/maps?limit=1").is_none_or(|answer| answer.status != 200) {
        assert!(begun.elapsed() < BACK, "the database is back for {:?}", begun.elapsed());
    }
    begun.elapsed()
}

#[test]
fn a_database_that_crashes_loses_nothing_and_is_never_an_error_of_the_service() {
    let Some(mut database) = postgres::Server::start("") else { return };
    let crashes = setting("STILLAGE_DATABASE_CRASHES", 3);
    let deployment = Deployment::on(database.new_database());
    let [first, second] = [(); 2].map(|()| Server::start(&deployment, None, &PATIENT).expect("it starts"));
    let mut ledger = Ledger::default();
    let mut dice = Dice::new(setting("STILLAGE_CRASH_SEED", 1));
    let is_over = AtomicBool::new(false);
    let (writes, reads, longest) = std::thread::scope(|scope| {
        let writes = scope.spawn(|| upload_while(&first, &mut ledger, &is_over));
        let reads = scope.spawn(|| read_while(&second, &is_over));
        let mut longest = Duration::ZERO;
        for crash in 0..crashes {
            std::thread::sleep(Duration::from_millis(500 + dice.below(1_000)));
            database.crash(crash % 4);
            longest = longest.max(back_after(&first)).max(back_after(&second));
        }
        is_over.store(true, Ordering::Relaxed);
        (writes.join().expect("all is right"), reads.join().expect("all is right"), longest)
    });
    assert!(reads.0.contains_key(&503), "the absence was seen: {reads:?}");
    first.wait_until_idle(PATIENCE * 5);
    for server in [first, second] {
        server.stop();
    }
    ledger.check_exactly(&deployment);
    println!(
        "{crashes} crashes over {} jobs, {} of them cut off; back after {longest:?} at most; writes {:?}, reads {:?}",
        ledger.len(),
        audit::interrupted(&deployment),
        writes.0,
        reads.0,
    );
}

#[test]
fn metrics_and_readiness_say_that_the_database_is_away() {
    let Some(deployment) = Deployment::shared() else { return };
    let proxy = Proxy::before(deployment.database_server());
    let server = Server::start(&deployment.through(proxy.address()), None, &[]).expect("it starts");
    let figure = |name: &str| {
        let metrics = server.ask("/metrics").expect("it answers");
        assert_eq!(metrics.status, 200, "{metrics:?}");
        let line = metrics.text.lines().find_map(|line| line.strip_prefix(name)).expect("it is there");
        line.trim().parse::<f64>().expect("a number")
    };
    assert_eq!((figure("database_up "), figure("jobs_oldest_waiting_seconds ")), (1.0, 0.0));
    for fault in [Fault::Outage, Fault::Partition] {
        proxy.set(fault);
        assert_eq!(figure("database_up "), 0.0, "{fault:?}");
        assert!(figure("jobs{state=\"accepted\"} ").is_nan() && figure("jobs_oldest_waiting_seconds ").is_nan());
        assert!(figure("database_busy_total ") > 0.0, "{fault:?}");
        let ready = server.ask("/health/ready").expect("it answers");
        assert!(ready.status == 503 && ready.says_when_to_come_back, "{ready:?}");
        assert_eq!(server.ask("/health/live").expect("it answers").status, 200, "a restart would bring nothing back");
        proxy.set(Fault::None);
        back_after(&server);
        assert_eq!((figure("database_up "), figure("jobs_oldest_waiting_seconds ")), (1.0, 0.0), "{fault:?} is over");
    }
    server.stop();
}

#[test]
fn who_is_cut_off_from_the_database_changes_nothing_when_it_is_back() {
    let seconds = setting("STILLAGE_PARTITION_S", 10);
    let Some(deployment) = Deployment::shared() else { return };
    let lease_s = if seconds < 60 { 2 } else { 30 };
    let deployment = deployment.with_lease(lease_s);
    let proxy = Proxy::before(deployment.database_server());
    let cut_off = Server::start(&deployment.through(proxy.address()), None, &PATIENT).expect("it starts");
    let other = Server::start(&deployment, None, &["--role", "api"]).expect("it starts");
    let mut ledger = Ledger::default();
    ledger.accepted("hall", &other.upload(&hall_message(1_000, 600), "hall").expect("accepted"));
    other.wait_until_busy(PATIENCE);
    proxy.set(Fault::Partition);
    let begun = Instant::now();
    let heir = Server::start(&deployment, None, &PATIENT).expect("it starts");

    let answer = cut_off.ask("/v1/maps").expect("it answers");
    assert!(answer.status == 503 && answer.says_when_to_come_back, "{answer:?}");
    let told_after = begun.elapsed();
    assert!(told_after < PATIENCE_OF_A_CLIENT, "{told_after:?}");
    while audit::unfinished(&deployment) > 0 {
        assert!(begun.elapsed() < Duration::from_secs(lease_s) + RESCUE, "nobody has done it");
        std::thread::sleep(Duration::from_millis(100));
    }
    let done_after = begun.elapsed();
    std::thread::sleep(Duration::from_secs(seconds).saturating_sub(done_after));
    proxy.set(Fault::None);
    // What it sent meanwhile arrives.
    let back_after = back_after(&cut_off);
    std::thread::sleep(LONGER_THAN_A_LEASE);
    for server in [cut_off, other, heir] {
        server.stop();
    }
    ledger.check_exactly(&deployment);
    assert_eq!(audit::interrupted(&deployment), 1, "the heir began it again");
    println!("told after {told_after:?}, done elsewhere after {done_after:?}, back after {back_after:?}");
}
