//! A PostgreSQL server of the tests' own: in a temporary folder, on a free loopback port, gone with the test's process.
//!
//! It takes the programs of Debian's package `postgresql`, or those in the folder that `STILLAGE_POSTGRES` names. Where they
//! are missing, a test is skipped with one line, and fails under `CI=true`.

#![allow(clippy::print_stderr, reason = "who runs the tests is told what is skipped")]
#![allow(dead_code, reason = "each test target takes what it needs")]

use std::io::Write;
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

/// How long a server may take to start on a busy machine.
const PATIENCE: Duration = Duration::from_mins(1);

/// Makes a cluster in folder `$1` and runs a server of the programs in `$2` on port `$3` until the standard input ends, which it
/// does when the process of the test has ended, however that happened. Each line of it ends the server without warning and
/// starts it again after so many seconds. The settings are in `$4`.
const SCRIPT: &str = r#"
folder=$1 programs=$2 port=$3 settings=$4
serve() {
    "$programs/postgres" -D "$folder/data" -p "$port" -h 127.0.0.1 -k "$folder" -c max_connections=200 $settings \
        >>"$folder/log" 2>&1 </dev/null &
}
"$programs/initdb" -D "$folder/data" -U stillage -A trust --no-sync -E UTF8 --locale=C.UTF-8 >"$folder/log" 2>&1 || exit 1
serve
while read -r seconds; do
    kill -QUIT $!
    wait $!
    sleep "$seconds"
    serve
done
kill -INT $! && wait $!
rm -rf "$folder"
"#;

/// A running server.
#[derive(Debug)]
pub struct Server {
    programs: PathBuf,
    port: u16,
    databases: AtomicU32,
    _process: Child,
    /// The server ends with it.
    input: ChildStdin,
}

/// The address of a new, empty database; `None` where there is no PostgreSQL. The tests on this server kill clients, not the
/// machine: nothing is synced.
pub fn new_database() -> Option<String> {
    static SERVER: OnceLock<Option<Server>> = OnceLock::new();
    Some(SERVER.get_or_init(|| Server::start("-c fsync=off")).as_ref()?.new_database())
}

impl Server {
    /// Starts a server with more settings; `None` where there is no PostgreSQL.
    pub fn start(settings: &str) -> Option<Self> {
        let Some(programs) = programs() else {
            assert!(std::env::var("CI").is_err(), "PostgreSQL is missing: apt-get install postgresql");
            eprintln!("skipped: PostgreSQL is missing (apt-get install postgresql)");
            return None;
        };
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
        command.args(["-c", SCRIPT, "sh"]).args([&folder, &programs]).args([&port.to_string(), settings]);
        let mut process = command.current_dir(&folder).stdin(Stdio::piped()).spawn().expect("a shell");
        let input = process.stdin.take().expect("it is piped");
        let begun = Instant::now();
        while !answers(&programs, port) {
            let ended = process.try_wait().expect("it can be asked");
            let log = || std::fs::read_to_string(folder.join("log")).unwrap_or_default();
            assert!(ended.is_none() && begun.elapsed() < PATIENCE, "PostgreSQL does not start: {}", log());
            std::thread::sleep(Duration::from_millis(20));
        }
        Some(Self { programs, port, databases: AtomicU32::new(0), _process: process, input })
    }

    /// Where it listens.
    pub fn listens_at(&self) -> SocketAddr {
        ([127, 0, 0, 1], self.port).into()
    }

    /// The address of a new, empty database.
    pub fn new_database(&self) -> String {
        let name = format!("test_{}", self.databases.fetch_add(1, Ordering::Relaxed));
        let port = self.port.to_string();
        let made = Command::new(self.programs.join("createdb"))
            .args(["-h", "127.0.0.1", "-p", &port, "-U", "stillage", &name])
            .status()
            .expect("createdb runs");
        assert!(made.success(), "createdb ended with {made}");
        format!("postgres://stillage@127.0.0.1:{port}/{name}")
    }

    /// Ends it at once, as a crash does, and starts it again after so many seconds. Returns when it answers again.
    pub fn crash(&mut self, seconds: u64) {
        writeln!(self.input, "{seconds}").expect("the script reads");
        let begun = Instant::now();
        let mut was_away = false;
        while !(was_away && answers(&self.programs, self.port)) {
            was_away |= TcpStream::connect(self.listens_at()).is_err();
            assert!(begun.elapsed() < PATIENCE, "PostgreSQL does not come back");
            std::thread::sleep(Duration::from_millis(2));
        }
    }
}

/// The folder of the programs: what was asked for, or the newest of this machine.
fn programs() -> Option<PathBuf> {
    if let Some(folder) = std::env::var_os("STILLAGE_POSTGRES") {
        return Some(folder.into());
    }
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
