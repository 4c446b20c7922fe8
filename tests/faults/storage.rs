//! A disk that is full, and a database that somebody else holds.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use crate::server::{Server, hall, status};

/// Size of the disk, KiB: the space set aside (4 MiB), and some for rows and blobs.
const DISK_KIB: u64 = 16 << 10;

/// A small disk in memory, until this is dropped; nothing where this user may not mount one.
struct SmallDisk(tempfile::TempDir);

impl SmallDisk {
    #[allow(clippy::print_stderr, reason = "who runs the tests is told what is skipped")]
    fn mount() -> Option<Self> {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let size = format!("size={DISK_KIB}k");
        let mounted = Command::new("mount").args(["-t", "tmpfs", "-o", &size, "tmpfs"]).arg(folder.path()).output();
        if mounted.is_ok_and(|output| output.status.success()) {
            return Some(Self(folder));
        }
        assert!(std::env::var("CI").is_err(), "a disk in memory cannot be mounted: run the tests as root");
        eprintln!("skipped: a disk in memory cannot be mounted (run the tests as root)");
        None
    }

    fn path(&self) -> &Path {
        self.0.path()
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.path()).status();
    }
}

/// Writes a file until the disk is full, but for so many bytes.
fn fill(disk: &SmallDisk, left: u64) {
    let filler = disk.path().join("filler");
    let space = rustix::fs::statvfs(disk.path()).expect("it tells");
    let bytes = (space.f_bavail * space.f_frsize).saturating_sub(left);
    fs::write(&filler, vec![0x5a; bytes as usize]).expect("so much is free");
}

#[test]
fn a_full_disk_keeps_what_was_acknowledged_and_recovers_without_a_restart() {
    let Some(disk) = SmallDisk::mount() else { return };
    let data = disk.path().join("data");
    let server = Server::start_in(&data, &["--job-slots", "0"]);
    assert_eq!(status(&server.upload(&hall(0))), 202);
    fill(&disk, 256 << 10);
    let mut accepted = 1;
    let refused = loop {
        match status(&server.upload(&hall(accepted))) {
            202 => accepted += 1,
            other => break other,
        }
        assert!(accepted < 5_000, "it is never full");
    };
    assert_eq!(refused, 507, "after {accepted} uploads");
    for _ in 0..20 {
        assert_eq!(status(&server.upload(&hall(accepted))), 507);
    }
    assert_eq!(server.maps().len() as u64, accepted.min(1_000), "reads go on, and all that was accepted is there");
    let oldest = server.maps().pop().expect("some are there");
    let delete = format!("DELETE /v1/maps/{oldest} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    assert!([200, 204].contains(&status(&server.answer(delete.as_bytes()))), "the space set aside lets something go");
    fs::remove_file(disk.path().join("filler")).expect("is there");
    assert_eq!(status(&server.upload(&hall(accepted))), 202, "without a restart");
    drop(server);
    let server = Server::start_in(&data, &[]);
    assert_eq!(server.maps().len() as u64, accepted, "one more, one less");
    server.wait_until_idle();
    let failed = server.json("/v1/jobs?status=failed");
    assert_eq!(failed["jobs"].as_array().map(Vec::len), Some(0), "{failed}");
}

#[test]
fn a_database_that_another_process_holds_is_waited_for_and_then_503() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let server = Server::start_in(folder.path(), &["--job-slots", "0"]);
    assert_eq!(status(&server.upload(&hall(0))), 202);
    let other = rusqlite::Connection::open(folder.path().join("stillage.sqlite3")).expect("it opens");
    other.execute_batch("BEGIN IMMEDIATE").expect("nobody writes");
    let held = Instant::now();
    std::thread::scope(|scope| {
        // The second one waits behind the first, and in all no longer.
        for index in 1..=2 {
            let server = &server;
            scope.spawn(move || {
                let refused = server.upload(&hall(index));
                assert_eq!(status(&refused), 503, "{refused}");
                assert!(refused.contains("retry-after: "), "{refused}");
                assert!((4..9).contains(&held.elapsed().as_secs()), "it waited: {:?}", held.elapsed());
            });
        }
        while held.elapsed() < Duration::from_secs(10) {
            let asked = Instant::now();
            assert_eq!(status(&server.get("/v1/maps")), 200, "reads go on");
            assert_eq!(status(&server.get("/health/live")), 200);
            assert!(asked.elapsed() < Duration::from_secs(2), "{:?}", asked.elapsed());
            std::thread::sleep(Duration::from_millis(200));
        }
    });
    other.execute_batch("ROLLBACK").expect("it holds it");
    assert_eq!(status(&server.upload(&hall(3))), 202, "and afterwards all is well");
    assert_eq!(server.maps().len(), 2, "what was refused is not there");
}
