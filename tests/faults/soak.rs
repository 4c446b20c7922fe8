//! Many jobs one after the other: memory, open files and the write-ahead log stay as they are.
//!
//! `STILLAGE_SOAK_JOBS=5000 cargo test --test faults soak -- --nocapture` runs the long one.

use std::collections::BTreeMap;

use crate::server::{Server, body, hall, status};

/// Growth of the memory that is no leak, bytes: what the allocator keeps of threads that had something to do for the first time.
const ALLOWED_GROWTH: f64 = (48 << 20) as f64;

/// SQLite's log is cut back to this after a checkpoint.
const MOST_LOG: f64 = (64 << 20) as f64;

/// The metrics without labels.
fn figures(server: &Server) -> BTreeMap<String, f64> {
    let answer = server.get("/metrics");
    let lines = body(&answer).lines().filter(|line| !line.starts_with('#') && !line.contains('{'));
    let figures = lines.filter_map(|line| line.rsplit_once(' '));
    figures.map(|(name, value)| (name.to_owned(), value.parse().expect("a number"))).collect()
}

/// Uploads maps, reads what came of them, and deletes them.
fn round(server: &Server, first: u64, jobs: u64) {
    for index in first..first + jobs {
        assert_eq!(status(&server.upload(&hall(index % 600))), 202);
    }
    server.wait_until_idle();
    for map in server.maps() {
        assert_eq!(status(&server.get(&format!("/v1/maps/{map}/collections/faces/items"))), 200);
        let delete = format!("DELETE /v1/maps/{map} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
        assert!([200, 204].contains(&status(&server.answer(delete.as_bytes()))));
    }
}

#[test]
fn thousands_of_jobs_leave_memory_files_and_log_as_they_are() {
    let jobs: u64 = std::env::var("STILLAGE_SOAK_JOBS").ok().and_then(|jobs| jobs.parse().ok()).unwrap_or(60);
    let in_a_round = (jobs / 6).clamp(1, 100);
    // Answers are kept as long as there is room for them, which is soon full.
    let server = Server::start(&["--keep-deleted-minutes", "0", "--cached-answer-mib", "1"]);
    // Caches, pools and threads fill in the first third.
    let rounds = jobs / in_a_round;
    let mut warm = None;
    for number in 0..rounds {
        round(&server, number * in_a_round, in_a_round);
        let now = figures(&server);
        let [memory, files, log] =
            ["process_resident_memory_bytes", "process_open_fds", "database_log_bytes"].map(|name| now[name]);
        println!(
            "{} jobs: {:.1} MiB, {files} files, log {:.1} MiB",
            (number + 1) * in_a_round,
            memory / 1_048_576.0,
            log / 1_048_576.0
        );
        assert!(log <= MOST_LOG, "{log}");
        if number + 1 < rounds.div_ceil(3) {
            continue;
        }
        let (warm_memory, warm_files) = *warm.get_or_insert((memory, files));
        assert!(memory <= warm_memory + ALLOWED_GROWTH, "{memory} after {warm_memory}");
        // Connections that were closed a moment ago may still be there.
        assert!(files <= warm_files + 8.0, "{files} after {warm_files}");
    }
}
