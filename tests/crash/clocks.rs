//! The clock of a worker jumps.

#![allow(clippy::print_stderr, reason = "who runs the tests is told what is skipped")]

use std::path::PathBuf;
use std::time::Duration;

use crate::audit::{self, Ledger};
use crate::deployment::Deployment;
use crate::server::{Server, map_message};
use crate::settings::{PATIENCE, PATIENT};

/// An idle process looks once a second for what is to be removed.
const LONGER_THAN_A_LOOK: Duration = Duration::from_millis(2_500);

/// What the clock is wrong by, in turn.
const WRONG_BY: [&str; 5] = ["+0", "+1h", "-1h", "+400d", "-1d"];

/// The library of Debian's package `faketime` that answers the time in place of the system.
fn library() -> Option<PathBuf> {
    let folders = std::fs::read_dir("/usr/lib").ok()?;
    let libraries = folders.filter_map(|folder| Some(folder.ok()?.path().join("faketime/libfaketimeMT.so.1")));
    let library = libraries.into_iter().find(|library| library.exists());
    if library.is_none() {
        assert!(std::env::var("CI").is_err(), "faketime is missing: apt-get install faketime");
        eprintln!("skipped: faketime is missing (apt-get install faketime)");
    }
    library
}

#[test]
fn the_clock_of_a_worker_may_jump_as_it_likes() {
    let Some(library) = library() else { return };
    for deployment in [Some(Deployment::embedded()), Deployment::shared()].into_iter().flatten() {
        let clock = deployment.folder().join("clock");
        std::fs::write(&clock, WRONG_BY[0]).expect("it can be written");
        let mut command = crate::server::command(&deployment, &PATIENT);
        command.env("LD_PRELOAD", &library).env("FAKETIME_TIMESTAMP_FILE", &clock).envs([
            ("FAKETIME_NO_CACHE", "1"),
            ("DONT_FAKE_MONOTONIC", "1"),
            ("NO_FAKE_STAT", "1"),
        ]);
        let jumping = Server::start_by(command).expect("it starts");
        let steady = deployment.database().map(|_| Server::start(&deployment, None, &PATIENT).expect("it starts"));
        let mut ledger = Ledger::default();
        for wrong_by in WRONG_BY.repeat(3) {
            std::fs::write(&clock, wrong_by).expect("it can be written");
            for server in [Some(&jumping), steady.as_ref()].into_iter().flatten() {
                let key = ledger.len().to_string();
                ledger.accepted(&key, &server.upload(&map_message(ledger.len()), &key).expect("accepted"));
            }
        }
        jumping.wait_until_idle(PATIENCE);
        if let Some(steady) = &steady {
            // A year later for one of them, a map that was just deleted can still be restored.
            std::fs::write(&clock, "+400d").expect("it can be written");
            let map = steady.maps().pop().expect("there are some");
            steady.delete(&format!("/v1/maps/{map}"));
            std::thread::sleep(LONGER_THAN_A_LOOK);
            steady.post(&format!("/v1/maps/{map}/restore"));
        }
        jumping.stop();
        if let Some(steady) = steady {
            steady.stop();
            assert_eq!(audit::interrupted(&deployment), 0, "leases run by the clock of the database");
        }
        ledger.check_exactly(&deployment);
    }
}
