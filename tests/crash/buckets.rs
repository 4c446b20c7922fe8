//! Blobs in a bucket: they outlive their process, go with their map, and a store that fails costs nothing.

use std::time::{Duration, Instant};

use crate::audit::Ledger;
use crate::deployment::Deployment;
use crate::object_store::{ObjectStore, Program};
use crate::proxy::{Fault, Proxy};
use crate::server::{Server, hall_message, map_message};
use crate::settings::{AT_ONCE, PATIENCE, PATIENT, setting};

/// After this time at the latest a client knows that the store does not answer: it is asked again and again for three seconds.
const PATIENCE_OF_A_CLIENT: Duration = Duration::from_secs(15);

/// Each store, with a deployment on it.
fn on_each_store(test: impl Fn(&Deployment, &Proxy)) {
    for program in [Program::Moto, Program::SeaweedFs] {
        let (Some(deployment), Some(bucket)) = (Deployment::shared(), ObjectStore::start(program)) else { continue };
        let proxy = Proxy::before(bucket.listens_at());
        test(&deployment.with_bucket(bucket.through(proxy.address())), &proxy);
    }
}

#[test]
fn blobs_outlive_their_process_and_go_with_their_map() {
    on_each_store(|deployment, proxy| {
        let mut server = Server::start(deployment, Some("after-blob"), &AT_ONCE).expect("it starts");
        server.upload(&map_message(0), "hall").expect("accepted");
        assert_eq!(server.wait_for_death(PATIENCE), Some(9));

        let server = Server::start(deployment, None, &AT_ONCE).expect("the next process starts");
        server.wait_until_idle(PATIENCE);
        let map = server.maps().pop().expect("one map");
        assert_eq!(faces(&server, &map), 200);
        server.delete(&format!("/v1/maps/{map}"));
        assert_eq!(server.maps(), Vec::<String>::new());
        server.stop();
        assert!(!proxy.saw_condition(), "stores that ignore conditions of requests cost nothing: there are none");
    });
}

/// The status of the answer to a question about the faces of a map.
fn faces(server: &Server, map: &str) -> u16 {
    let answer = server.ask(&format!("/v1/maps/{map}/collections/faces/items")).expect("it answers");
    assert!([200, 503].contains(&answer.status), "{answer:?}");
    assert!(answer.status == 200 || answer.says_when_to_come_back, "{answer:?}");
    answer.status
}

#[test]
fn a_store_that_does_not_answer_is_waited_for() {
    let seconds = setting("STILLAGE_OUTAGE_S", 3);
    on_each_store(|deployment, proxy| {
        let mut ledger = Ledger::default();
        let server = Server::start(deployment, None, &PATIENT).expect("it starts");
        ledger.accepted("first", &server.upload(&map_message(0), "first").expect("accepted"));
        server.wait_until_idle(PATIENCE);
        let map = server.maps().pop().expect("one map");
        for (index, fault) in [Fault::Outage, Fault::Refusal].into_iter().enumerate() {
            // Its result cannot be stored for a while.
            let key = format!("running-{index}");
            let job = server.upload(&hall_message(300 + index as u64, 200), &key).expect("accepted");
            ledger.accepted(&key, &job);
            server.wait_until_busy(PATIENCE);
            proxy.set(fault);
            let begun = Instant::now();
            // A process that has nothing in memory.
            let empty = Server::start(deployment, None, &["--role", "api"]).expect("it starts");
            let maps = server.maps().len();
            let refused = empty.try_upload(&map_message(1), &format!("refused-{index}")).expect("it answers");
            assert!(refused.status == 503 && refused.says_when_to_come_back, "{refused:?}");
            assert_eq!(faces(&empty, &map), 503);
            assert!(begun.elapsed() < PATIENCE_OF_A_CLIENT * 2, "{:?}", begun.elapsed());
            assert_eq!(server.maps().len(), maps, "no row without its blob");
            std::thread::sleep(Duration::from_secs(seconds).saturating_sub(begun.elapsed()));
            proxy.set(Fault::None);
            assert_eq!(faces(&empty, &map), 200);
            let key = format!("after-{index}");
            ledger.accepted(&key, &empty.upload(&map_message(index as u64), &key).expect("accepted"));
            empty.stop();
        }
        server.wait_until_idle(PATIENCE);
        server.stop();
        ledger.check_exactly(deployment);
    });
}

#[test]
fn what_needs_no_blob_is_answered_while_the_store_is_away() {
    on_each_store(|deployment, proxy| {
        let server = Server::start(deployment, None, &PATIENT).expect("it starts");
        proxy.set(Fault::Outage);
        std::thread::scope(|scope| {
            // More than are worked on at the same time.
            for index in 0..6 {
                let server = &server;
                scope.spawn(move || {
                    let refused = server.try_upload(&map_message(index), &index.to_string()).expect("it answers");
                    assert!(refused.status == 503 && refused.says_when_to_come_back, "{refused:?}");
                });
            }
            for _ in 0..20 {
                let begun = Instant::now();
                assert_eq!(server.ask("/v1/maps").expect("it answers").status, 200);
                assert!(begun.elapsed() < Duration::from_secs(2), "{:?}", begun.elapsed());
                std::thread::sleep(Duration::from_millis(100));
            }
        });
        server.stop();
    });
}

#[test]
fn a_slow_store_slows_down_and_a_lying_one_is_found_out() {
    on_each_store(|deployment, proxy| {
        let mut ledger = Ledger::default();
        let server = Server::start(deployment, None, &PATIENT).expect("it starts");
        proxy.set(Fault::Slow(20_000));
        ledger.accepted("slow", &server.upload(&hall_message(300, 200), "slow").expect("accepted"));
        server.wait_until_idle(PATIENCE);
        proxy.set(Fault::None);
        let map = server.maps().pop().expect("one map");

        let empty = Server::start(deployment, None, &["--role", "api"]).expect("it starts");
        proxy.set(Fault::Corruption);
        let answer = empty.ask(&format!("/v1/maps/{map}/collections/faces/items")).expect("it answers");
        assert!(answer.status >= 500 && answer.text.contains("damaged"), "{answer:?}");
        proxy.set(Fault::None);
        server.wait_until_idle(PATIENCE);
        assert_eq!(faces(&empty, &map), 200);
        for server in [server, empty] {
            server.stop();
        }
        ledger.check(deployment);
    });
}
