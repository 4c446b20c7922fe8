//! A server process, and connections to it byte by byte.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process};
use serde_json::{Value, json};

/// Longest wait for bytes of an answer.
const PATIENCE: Duration = Duration::from_secs(30);

/// Longest wait for jobs, on a busy machine and by a debug build.
const IDLE_PATIENCE: Duration = Duration::from_mins(3);

/// Name of the log of a server that is watched.
const LOG: &str = "log";

/// A running server on a folder of its own. Killed when dropped.
pub struct Server {
    process: Child,
    pub address: SocketAddr,
    /// Its own folder, where it was given none.
    folder: Option<tempfile::TempDir>,
}

impl Server {
    pub fn start(arguments: &[&str]) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut server = Self::start_in(folder.path(), arguments);
        server.folder = Some(folder);
        server
    }

    /// The same on a folder that outlives it.
    pub fn start_in(folder: &Path, arguments: &[&str]) -> Self {
        let arguments = [&["--log", "error"], arguments].concat();
        Self::start_with(folder, &arguments, Stdio::inherit())
    }

    /// The same with its log somewhere.
    pub fn start_with(folder: &Path, arguments: &[&str], log: Stdio) -> Self {
        let mut command = stillage(&["serve", "--listen", "127.0.0.1:0", "--min-free-mib", "0"]);
        command.arg("--data").arg(folder).args(arguments).stdout(Stdio::piped()).stderr(log);
        let mut process = command.spawn().expect("the binary runs");
        let mut line = String::new();
        let output = process.stdout.take().expect("it is piped");
        BufReader::new(output).read_line(&mut line).expect("its output is text");
        let address = line.trim().strip_prefix("listening on http://").expect("it listens").parse();
        Self { process, address: address.expect("is an address"), folder: None }
    }

    /// The same on a folder of its own, with a log of errors to be read.
    pub fn start_watched(arguments: &[&str]) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let log = std::fs::File::create(folder.path().join(LOG)).expect("can be made");
        let arguments = [&["--log", "error"], arguments].concat();
        let mut server = Self::start_with(&folder.path().join("data"), &arguments, log.into());
        server.folder = Some(folder);
        server
    }

    /// Its errors and panics so far, where it was started to be watched.
    pub fn logged(&self) -> String {
        let folder = self.folder.as_ref().expect("it has one of its own");
        std::fs::read_to_string(folder.path().join(LOG)).expect("is text")
    }

    /// A connection on which something was sent.
    pub fn connect(&self, bytes: &[u8]) -> TcpStream {
        let mut stream = TcpStream::connect(self.address).expect("it listens");
        stream.set_read_timeout(Some(PATIENCE)).expect("can be set");
        let _ = stream.write_all(bytes);
        stream
    }

    /// The answer to what is sent on a connection of its own, up to the end of the connection.
    pub fn answer(&self, bytes: &[u8]) -> String {
        rest(self.connect(bytes))
    }

    /// What uploading a map answers: head and body.
    pub fn upload(&self, message: &str) -> String {
        let request = format!(
            "POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nConnection: close\r\n\
             Content-Length: {}\r\n\r\n{message}",
            message.len()
        );
        self.answer(request.as_bytes())
    }

    /// A JSON document.
    pub fn json(&self, path: &str) -> Value {
        serde_json::from_str(body(&self.get(path))).expect("is JSON")
    }

    /// Ids of the maps, newest first.
    pub fn maps(&self) -> Vec<String> {
        let maps = self.json("/v1/maps?limit=1000");
        let maps = maps["maps"].as_array().expect("a list of maps");
        maps.iter().map(|map| map["id"].as_str().expect("an id").to_owned()).collect()
    }

    /// Waits until no job waits or runs.
    pub fn wait_until_idle(&self) {
        let begun = Instant::now();
        while self.json("/v1/jobs?status=accepted,running&limit=1")["jobs"]
            .as_array()
            .is_none_or(|jobs| !jobs.is_empty())
        {
            assert!(begun.elapsed() < IDLE_PATIENCE, "jobs do not end");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// The answer to a plain GET.
    pub fn get(&self, path: &str) -> String {
        self.answer(format!("GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n").as_bytes())
    }

    /// Memory of the process, bytes.
    pub fn memory(&self) -> u64 {
        self.bytes_of("VmRSS:")
    }

    /// The most memory that the process had since it began, or since [`Self::forget_peak`], bytes.
    pub fn peak(&self) -> u64 {
        self.bytes_of("VmHWM:")
    }

    pub fn forget_peak(&self) {
        std::fs::write(format!("/proc/{}/clear_refs", self.process.id()), "5").expect("it is ours");
    }

    /// What Linux tells of the memory of the process.
    fn bytes_of(&self, name: &str) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.process.id())).expect("it runs");
        let line = status.lines().find_map(|line| line.strip_prefix(name)).expect("Linux tells it");
        let kibibytes: u64 = line.trim().trim_end_matches(" kB").parse().expect("a number");
        kibibytes << 10
    }

    /// Sockets of the process.
    pub fn sockets(&self) -> usize {
        let files = std::fs::read_dir(format!("/proc/{}/fd", self.process.id())).expect("it runs");
        let targets = files.filter_map(|file| std::fs::read_link(file.ok()?.path()).ok());
        targets.filter(|target| target.to_string_lossy().starts_with("socket:")).count()
    }

    /// Its log, where it is piped and was not taken before.
    pub const fn log(&mut self) -> Option<ChildStderr> {
        self.process.stderr.take()
    }

    /// SIGTERM.
    pub fn ask_to_stop(&self) {
        kill_process(Pid::from_child(&self.process), Signal::TERM).expect("it runs");
    }

    /// The end of the process.
    pub fn wait(&mut self) -> ExitStatus {
        self.process.wait().expect("it ends")
    }
}

/// The program, to be run with these arguments.
pub fn stillage(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stillage"));
    command.args(arguments);
    command
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// What is left to read of a connection; a reset ends it.
pub fn rest(mut stream: TcpStream) -> String {
    let (mut bytes, mut buffer) = (Vec::new(), [0; 8_192]);
    while let Ok(read @ 1..) = stream.read(&mut buffer) {
        bytes.extend_from_slice(&buffer[..read]);
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Whether the other end has closed a connection, without waiting.
pub fn is_closed(stream: &mut TcpStream) -> bool {
    stream.set_nonblocking(true).expect("can be set");
    let mut buffer = [0; 8_192];
    loop {
        match stream.read(&mut buffer) {
            Ok(0) => return true,
            Ok(_) => {}
            Err(error) => return error.kind() != std::io::ErrorKind::WouldBlock,
        }
    }
}

/// The body of an answer.
#[track_caller]
pub fn body(answer: &str) -> &str {
    let Some((_, body)) = answer.split_once("\r\n\r\n") else { panic!("no answer: {answer:?}") };
    body
}

/// A hall with two rows of racks as an `OccupancyGrid` message; a different one for each index.
pub fn hall(index: u64) -> String {
    let (width, height) = (30 + index % 7, 24 + index / 7);
    let is_rack = |column: u64, row: u64| [6, 7, 16, 17].contains(&row) && (5..width - 5).contains(&column);
    let is_wall = |column: u64, row: u64| column == 0 || row == 0 || column == width - 1 || row == height - 1;
    let cell = |column, row| if is_wall(column, row) || is_rack(column, row) { 100 } else { 0 };
    let data: Vec<u8> = (0..height).flat_map(|row| (0..width).map(move |column| cell(column, row))).collect();
    let pose =
        json!({"position": {"x": 0.0, "y": 0.0, "z": 0.0}, "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}});
    let info = json!({"resolution": 0.25, "width": width, "height": height, "origin": pose});
    json!({"header": {"frame_id": "map"}, "info": info, "data": data}).to_string()
}

/// The status of an answer.
#[track_caller]
pub fn status(answer: &str) -> u16 {
    let status = answer.strip_prefix("HTTP/1.1 ").and_then(|rest| rest.get(..3)?.parse().ok());
    status.unwrap_or_else(|| panic!("no answer: {answer:?}"))
}

/// The statuses of all answers on a connection.
pub fn statuses(answers: &str) -> Vec<u16> {
    let behind = answers.split("HTTP/1.1 ").skip(1);
    behind.map(|answer| answer.get(..3).and_then(|status| status.parse().ok()).expect("a status")).collect()
}
