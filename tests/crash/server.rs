//! A server process and its client.

use std::io::{BufRead, BufReader};
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process, waitid};
use serde_json::{Value, json};

use crate::deployment::Deployment;

/// How often a state is asked for while waiting.
const TICK: Duration = Duration::from_millis(20);

/// What matters of an answer.
#[derive(Debug)]
pub struct Answer {
    pub status: u16,
    pub says_when_to_come_back: bool,
    pub location: Option<String>,
    pub text: String,
}

/// A running server. Killed when dropped.
pub struct Server {
    process: Child,
    address: String,
    client: ureq::Agent,
}

/// `stillage serve` on a deployment and a free port.
pub fn command(deployment: &Deployment, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stillage"));
    command.args(["serve", "--listen", "127.0.0.1:0", "--min-free-mib", "0", "--log", "error"]);
    command
        .envs(deployment.environment())
        .args(deployment.arguments())
        .args(arguments)
        .env_remove("STILLAGE_FAIL_POINT");
    command
}

impl Server {
    /// Starts a server; `None` when it dies of its fail point before it listens.
    pub fn start(deployment: &Deployment, fail_point: Option<&str>, arguments: &[&str]) -> Option<Self> {
        let mut command = command(deployment, arguments);
        if let Some(point) = fail_point {
            command.env("STILLAGE_FAIL_POINT", point);
        }
        Self::start_by(command)
    }

    /// [`Self::start`] by a command of one's own.
    pub fn start_by(mut command: Command) -> Option<Self> {
        let mut process = command.stdout(Stdio::piped()).spawn().expect("the binary runs");
        let mut line = String::new();
        let output = process.stdout.take().expect("it is piped");
        BufReader::new(output).read_line(&mut line).expect("its output is text");
        let Some(address) = line.trim().strip_prefix("listening on ") else {
            let status = process.wait().expect("it ended");
            assert_eq!(status.signal(), Some(9), "it does not start: {status}");
            return None;
        };
        let config = ureq::Agent::config_builder().timeout_global(Some(Duration::from_secs(30)));
        let client = config.http_status_as_error(false).build().new_agent();
        Some(Self { process, address: address.to_owned(), client })
    }

    /// Uploads a map: the path of its job when it was accepted, `None` when no answer came.
    pub fn upload(&self, message: &Value, key: &str) -> Option<String> {
        let answer = self.try_upload(message, key)?;
        assert!([200, 202].contains(&answer.status), "{answer:?}");
        Some(answer.location.expect("where the job is"))
    }

    /// Uploads a map, whatever the answer is; `None` when none came.
    pub fn try_upload(&self, message: &Value, key: &str) -> Option<Answer> {
        let request = self.client.post(format!("{}/v1/maps?name={key}", self.address)).header("idempotency-key", key);
        Some(answer(request.send_json(message).ok()?))
    }

    /// Asks, whatever the answer is; `None` when none came.
    pub fn ask(&self, path: &str) -> Option<Answer> {
        Some(answer(self.client.get(format!("{}{path}", self.address)).call().ok()?))
    }

    /// Reads a JSON resource.
    pub fn get(&self, path: &str) -> Value {
        self.try_get(path).expect("it answers")
    }

    fn try_get(&self, path: &str) -> Option<Value> {
        let url = if path.starts_with("http") { path.to_owned() } else { format!("{}{path}", self.address) };
        self.client.get(url).call().ok()?.body_mut().read_json().ok()
    }

    /// Sends a DELETE; whether it is answered is another matter.
    pub fn delete(&self, path: &str) {
        let _ = self.client.delete(format!("{}{path}", self.address)).call();
    }

    /// Sends a POST without a body, which is answered 200.
    pub fn post(&self, path: &str) {
        let answer = self.client.post(format!("{}{path}", self.address)).send_empty().expect("it answers");
        assert_eq!(answer.status().as_u16(), 200);
    }

    /// Ids of the maps.
    pub fn maps(&self) -> Vec<String> {
        let maps = self.get("/v1/maps");
        let maps = maps["maps"].as_array().expect("a list of maps");
        maps.iter().map(|map| map["id"].as_str().expect("an id").to_owned()).collect()
    }

    /// Waits until no job waits or runs.
    pub fn wait_until_idle(&self, patience: Duration) {
        let begun = Instant::now();
        while !self.is_idle().expect("it answers") {
            assert!(begun.elapsed() < patience, "jobs are still under way after {patience:?}");
            std::thread::sleep(TICK);
        }
    }

    fn is_idle(&self) -> Option<bool> {
        let jobs = self.try_get("/v1/jobs?status=accepted,running&limit=1")?;
        Some(jobs["jobs"].as_array()?.is_empty())
    }

    /// Waits for the process to die by itself: its signal.
    pub fn wait_for_death(&mut self, patience: Duration) -> Option<i32> {
        let begun = Instant::now();
        while begun.elapsed() < patience {
            if let Some(status) = self.process.try_wait().expect("it can be asked") {
                return status.signal();
            }
            std::thread::sleep(TICK);
        }
        None
    }

    /// Waits until the process dies (its signal) or has nothing to do.
    pub fn wait_for_death_or_idle(&mut self, patience: Duration) -> Option<i32> {
        let begun = Instant::now();
        loop {
            if let Some(status) = self.process.try_wait().expect("it can be asked") {
                return status.signal();
            }
            if self.is_idle() == Some(true) {
                return None;
            }
            assert!(begun.elapsed() < patience, "neither dead nor idle after {patience:?}");
            std::thread::sleep(TICK);
        }
    }

    /// SIGKILL, now.
    pub fn kill(&mut self) {
        self.process.kill().expect("it runs");
        self.process.wait().expect("it ends");
    }

    /// Stands still, as a process does on a machine that swaps or sleeps.
    pub fn freeze(&self) {
        kill_process(Pid::from_child(&self.process), Signal::STOP).expect("it runs");
    }

    /// Goes on.
    pub fn thaw(&self) {
        kill_process(Pid::from_child(&self.process), Signal::CONT).expect("it stands still");
    }

    /// Waits until a job runs.
    pub fn wait_until_busy(&self, patience: Duration) {
        let begun = Instant::now();
        while self.get("/v1/jobs?status=running&limit=1")["jobs"].as_array().is_some_and(Vec::is_empty) {
            assert!(begun.elapsed() < patience, "no job runs after {patience:?}");
        }
    }

    /// SIGTERM, and an orderly end.
    pub fn stop(self) {
        self.ask_to_stop();
        self.wait_for_success();
    }

    /// SIGTERM.
    pub fn ask_to_stop(&self) {
        kill_process(Pid::from_child(&self.process), Signal::TERM).expect("it runs");
    }

    /// Waits until the process has ended; its status is for [`Self::wait_for_success`].
    pub fn wait_for_end(&self) {
        let options = WaitIdOptions::EXITED | WaitIdOptions::NOWAIT;
        waitid(WaitId::Pid(Pid::from_child(&self.process)), options).expect("it is a child");
    }

    /// The orderly end of a process that was asked to stop.
    pub fn wait_for_success(mut self) {
        let status = self.process.wait().expect("it ends");
        assert!(status.success(), "told to stop, it ended with {status}");
    }

    /// `http://` and its address.
    pub fn address(&self) -> &str {
        &self.address
    }
}

fn answer(mut response: ureq::http::Response<ureq::Body>) -> Answer {
    let header = |name| Some(response.headers().get(name)?.to_str().expect("is text").to_owned());
    let (location, says_when_to_come_back) = (header("location"), header("retry-after").is_some());
    let status = response.status().as_u16();
    Answer { status, says_when_to_come_back, location, text: response.body_mut().read_to_string().unwrap_or_default() }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// A small hall with two rows of racks as an `OccupancyGrid` message; a different one for each index.
pub fn map_message(index: u64) -> Value {
    hall_message(30 + index % 7, 24)
}

/// The hall with so many columns and rows of cells.
pub fn hall_message(width: u64, height: u64) -> Value {
    let is_rack = |column: u64, row: u64| [6, 7, 16, 17].contains(&row) && (5..width - 5).contains(&column);
    let is_wall = |column: u64, row: u64| column == 0 || row == 0 || column == width - 1 || row == height - 1;
    let cell = |column, row| if is_wall(column, row) || is_rack(column, row) { 100 } else { 0 };
    let data: Vec<u8> = (0..height).flat_map(|row| (0..width).map(move |column| cell(column, row))).collect();
    let pose =
        json!({"position": {"x": 0.0, "y": 0.0, "z": 0.0}, "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}});
    json!({
        "header": {"frame_id": "map"},
        "info": {"resolution": 0.25, "width": width, "height": height, "origin": pose},
        "data": data,
    })
}

/// A small generator of numbers, so that a run can be repeated.
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// A number from 0 to `bound`, exclusive. (Knuth's linear congruence, MMIX.)
    pub fn below(&mut self, bound: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % bound
    }
}
