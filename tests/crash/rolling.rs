//! Orderly stops while clients ask, write and upload: of one process again and again, and of two that share a database and are
//! restarted one after the other.
//!
//! `STILLAGE_STOPS=50 STILLAGE_RESTARTS=25 cargo test --test crash rolling` runs the long campaigns.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, RwLock};
use std::time::{Duration, Instant};

use crate::audit::{self, Ledger};
use crate::deployment::Deployment;
use crate::server::{Server, map_message};
use crate::settings::{PATIENCE, setting};

/// Longest time from the signal to the end of the process.
const LONGEST_STOP: Duration = Duration::from_secs(30);

/// How often a balancer looks at the readiness of a process.
const LOOK: Duration = Duration::from_millis(100);

/// How many clients there are.
const CLIENTS: usize = 4;

/// Of so many requests of a client one is an upload.
const UPLOAD_PERIOD: u64 = 24;

/// What clients did.
#[derive(Default)]
struct Traffic {
    answered: AtomicU64,
    lost: Mutex<Vec<String>>,
    uploads: AtomicU64,
    ledger: Mutex<Ledger>,
}

/// What an answer told a client.
enum Told {
    GoOn,
    ComeElsewhere,
    Nothing,
}

impl Traffic {
    /// Reads, and uploads now and then; answers whether the connection goes on.
    fn ask(&self, client: &ureq::Agent, address: &str, turn: u64) -> Told {
        let is_upload = turn.is_multiple_of(UPLOAD_PERIOD);
        let index = if is_upload { self.uploads.fetch_add(1, Ordering::Relaxed) } else { 0 };
        let answer = if is_upload {
            let request =
                client.post(format!("{address}/v1/maps?name={index}")).header("idempotency-key", index.to_string());
            request.send_json(map_message(index))
        } else {
            client.get(format!("{address}/v1/maps?limit=5")).call()
        };
        let mut answer = match answer {
            Ok(answer) if [200, 202].contains(&answer.status().as_u16()) => answer,
            Ok(answer) => return self.lose(format!("{} from {address}", answer.status())),
            Err(error) => return self.lose(format!("{error} from {address}")),
        };
        if let (true, Some(location)) = (is_upload, answer.headers().get("location")) {
            let mut ledger = self.ledger.lock().expect("nobody panicked");
            ledger.accepted(&index.to_string(), location.to_str().expect("is text"));
        }
        let closes = answer.headers().get("connection").is_some_and(|value| value == "close");
        if let Err(error) = answer.body_mut().read_to_vec() {
            return self.lose(format!("{error} in an answer of {address}"));
        }
        self.answered.fetch_add(1, Ordering::Relaxed);
        if closes { Told::ComeElsewhere } else { Told::GoOn }
    }

    fn lose(&self, what: String) -> Told {
        self.lost.lock().expect("nobody panicked").push(what);
        Told::Nothing
    }

    /// How long the jobs may take that were accepted.
    fn patience(&self) -> Duration {
        PATIENCE + Duration::from_millis(500 * self.uploads.load(Ordering::Relaxed))
    }

    /// Nothing was lost, and every job that was accepted ended with its first attempt.
    fn check(self, deployment: &Deployment) -> (u64, u64) {
        let lost = self.lost.into_inner().expect("nobody panicked");
        let answered = self.answered.into_inner();
        assert!(lost.is_empty(), "{} of {answered}: {lost:?}", lost.len());
        let ledger = self.ledger.into_inner().expect("nobody panicked");
        ledger.check_exactly(deployment);
        audit::check_no_attempt_was_burnt(deployment);
        (answered, ledger.len())
    }
}

fn client() -> ureq::Agent {
    let config = ureq::Agent::config_builder().timeout_global(Some(Duration::from_secs(30)));
    config.http_status_as_error(false).build().new_agent()
}

#[test]
fn stopped_under_load_it_ends_soon_and_drops_nothing() {
    let folder = Deployment::embedded();
    let traffic = Traffic::default();
    let mut longest = Duration::ZERO;
    let stops = setting("STILLAGE_STOPS", 3);
    for round in 0..stops {
        // Some have time to end their jobs, others do not.
        let grace = (round % 3).to_string();
        let arguments = ["--shutdown-grace-s", &grace, "--max-queued-jobs", "100000"];
        let server = Server::start(&folder, None, &arguments).expect("it starts");
        std::thread::scope(|scope| {
            for _ in 0..CLIENTS {
                scope.spawn(|| {
                    let client = client();
                    let mut turn = 0;
                    while let Told::GoOn = traffic.ask(&client, server.address(), turn) {
                        turn += 1;
                    }
                });
            }
            std::thread::sleep(Duration::from_millis(100 + 37 * (round % 11)));
            server.ask_to_stop();
        });
        let begun = Instant::now();
        server.wait_for_success();
        longest = longest.max(begun.elapsed());
    }
    let server = Server::start(&folder, None, &[]).expect("it starts");
    server.wait_until_idle(traffic.patience());
    server.stop();
    let (answered, jobs) = traffic.check(&folder);
    assert!(longest < LONGEST_STOP, "{longest:?}");
    println!(
        "{stops} stops under load: {answered} requests answered, {jobs} jobs accepted, 0 lost, longest stop {longest:?}"
    );
}

#[test]
fn processes_that_are_restarted_one_after_the_other_lose_no_request() {
    let Some(deployment) = Deployment::shared() else { return };
    let arguments = ["--shutdown-notice-s", "2", "--shutdown-grace-s", "1", "--max-queued-jobs", "100000"];
    let start = || Server::start(&deployment, None, &arguments).expect("it starts");
    let servers = [RwLock::new(Some(start())), RwLock::new(Some(start()))];
    let (traffic, is_over) = (Traffic::default(), AtomicBool::new(false));
    // Where the balancer sends requests.
    let ready: [RwLock<Option<String>>; 2] = [RwLock::default(), RwLock::default()];
    let look = |index: usize| {
        let address =
            servers[index].read().expect("nobody panicked").as_ref().map(|server| server.address().to_owned());
        let found = address.filter(|address| {
            let answer = client().get(format!("{address}/health/ready")).call();
            answer.is_ok_and(|answer| answer.status().as_u16() == 200)
        });
        *ready[index].write().expect("nobody panicked") = found;
    };
    let restarts = setting("STILLAGE_RESTARTS", 2);
    (0..2).for_each(look);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !is_over.load(Ordering::Relaxed) {
                (0..2).for_each(look);
                std::thread::sleep(LOOK);
            }
        });
        for number in 0..CLIENTS {
            let (traffic, ready, is_over) = (&traffic, &ready, &is_over);
            scope.spawn(move || {
                let client = client();
                let mut turn = number as u64;
                while !is_over.load(Ordering::Relaxed) {
                    turn += 1;
                    // In turns, and to the other one where one is not ready.
                    let sides = [turn as usize % 2, (turn as usize + 1) % 2];
                    let address = sides.iter().find_map(|&side| ready[side].read().expect("nobody panicked").clone());
                    let Some(address) = address else {
                        traffic.lose("no process is ready".to_owned());
                        return;
                    };
                    traffic.ask(&client, &address, turn);
                    std::thread::sleep(Duration::from_millis(5));
                }
            });
        }
        for _ in 0..restarts {
            for (server, ready) in servers.iter().zip(&ready) {
                server.read().expect("nobody panicked").as_ref().expect("it runs").ask_to_stop();
                server.read().expect("nobody panicked").as_ref().expect("it runs").wait_for_end();
                let old = server.write().expect("nobody panicked").replace(start());
                old.expect("it ran").wait_for_success();
                while ready.read().expect("nobody panicked").is_none() {
                    std::thread::sleep(LOOK);
                }
                std::thread::sleep(LOOK);
            }
        }
        is_over.store(true, Ordering::Relaxed);
    });
    for server in servers {
        let server = server.into_inner().expect("nobody panicked").expect("it runs");
        server.wait_until_idle(traffic.patience());
        server.stop();
    }
    let (answered, jobs) = traffic.check(&deployment);
    println!(
        "{restarts} rolling restarts of two processes: {answered} requests answered, {jobs} jobs accepted, 0 lost"
    );
}

#[test]
fn every_role_tells_when_it_is_ready_and_when_it_stops() {
    let Some(deployment) = Deployment::shared() else { return };
    for role in ["all", "api", "worker"] {
        let arguments = ["--role", role, "--shutdown-notice-s", "3"];
        let server = Server::start(&deployment, None, &arguments).expect("it starts");
        let health = || {
            ["live", "ready"].map(|path| {
                let answer = client().get(format!("{}/health/{path}", server.address())).call().expect("it answers");
                answer.status().as_u16()
            })
        };
        assert_eq!(health(), [200, 200], "{role}");
        server.ask_to_stop();
        std::thread::sleep(Duration::from_millis(500));
        assert_eq!(health(), [200, 503], "{role} is there and takes nothing more");
        server.wait_for_success();
    }
}
