//! A PostgreSQL server of the tests' own: in a temporary folder, on a free loopback port, gone with the test's process.
//!
//! It takes the programs of Debian's package `postgresql`. Where they are missing, a test is skipped with one line, and
//! fails under `CI=true`.

#![allow(clippy::print_stderr, reason = "who runs the tests is told what is skipped")]

use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

/// How long a server may take to start on a busy machine.
const PATIENCE: Duration = Duration::from_mins(1);

/// Makes a cluster in folder `$1` and runs a server of the programs in `$2` on port `$3` until its standard input ends, which
/// it does when the process of the test has ended, however that happened. The tests kill clients, not the machine: nothing is
/// synced.
const SCRIPT: &str = r#"
"$2/initdb" -D "$1/data" -U stillage -A trust --no-sync -E UTF8 --locale=C.UTF-8 >"$1/log" 2>&1 || exit 1
"$2/postgres" -D "$1/data" -p "$3" -h 127.0.0.1 -k "$1" -c fsync=off -c max_connections=200 >>"$1/log" 2>&1 </dev/null &
cat >/dev/null
kill -INT $! && wait $!
rm -rf "$1"
"#;

/// A running server.
#[derive(Debug)]
struct Server {
    programs: PathBuf,
    port: u16,
    databases: AtomicU32,
    /// Holds the standard input open.
    _process: Child,
}

/// The address of a new, empty database; `None` where there is no PostgreSQL.
pub fn new_database() -> Option<String> {
    static SERVER: OnceLock<Option<Server>> = OnceLock::new();
    let Some(server) = SERVER.get_or_init(Server::start) else {
        assert!(std::env::var("CI").is_err(), "PostgreSQL is missing: apt-get install postgresql");
        eprintln!("skipped: PostgreSQL is missing (apt-get install postgresql)");
        return None;
    };
    let name = format!("test_{}", server.databases.fetch_add(1, Ordering::Relaxed));
    let port = server.port.to_string();
    let made = Command::new(server.programs.join("createdb"))
        .args(["-h", "127.0.0.1", "-p", &port, "-U", "stillage", &name])
        .status()
        .expect("createdb runs");
    assert!(made.success(), "createdb ended with {made}");
    Some(format!("postgres://stillage@127.0.0.1:{port}/{name}"))
}

impl Server {
    fn start() -> Option<Self> {
        let programs = programs()?;
        let folder = tempfile::tempdir().expect("a temporary folder").keep();
        let port = TcpListener::bind("127.0.0.1:0").and_then(|free| free.local_addr()).expect("a free port").port();
        // PostgreSQL does not run as root.
        let is_root = rustix::process::geteuid().is_root();
        let mut command = Command::new(if is_root { "runuser" } else { "sh" });
        if is_root {
            let given = Command::new("chown").arg("postgres").arg(&folder).status().expect("chown runs");
            assert!(given.success(), "the package makes the user postgres");
            command.args(["-u", "postgres", "--", "sh"]);
        }
        command.args(["-c", SCRIPT, "sh"]).args([&folder, &programs]).arg(port.to_string()).current_dir(&folder);
        let mut process = command.stdin(Stdio::piped()).spawn().expect("a shell");
        let begun = Instant::now();
        while !answers(&programs, port) {
            let ended = process.try_wait().expect("it can be asked");
            let log = || std::fs::read_to_string(folder.join("log")).unwrap_or_default();
            assert!(ended.is_none() && begun.elapsed() < PATIENCE, "PostgreSQL does not start: {}", log());
            std::thread::sleep(Duration::from_millis(20));
        }
        Some(Self { programs, port, databases: AtomicU32::new(0), _process: process })
    }
}

/// The folder of the newest PostgreSQL of this machine.
fn programs() -> Option<PathBuf> {
    let versions = std::fs::read_dir("/usr/lib/postgresql").ok()?;
    let folders = versions.filter_map(|version| Some(version.ok()?.path().join("bin")));
    folders.filter(|folder| folder.join("initdb").exists()).max()
}

fn answers(programs: &Path, port: u16) -> bool {
    let is_ready = || {
        let mut command = Command::new(programs.join("pg_isready"));
        command.args(["-q", "-h", "127.0.0.1", "-p", &port.to_string()]).status().is_ok_and(|status| status.success())
    };
    TcpStream::connect(("127.0.0.1", port)).is_ok() && is_ready()
}
