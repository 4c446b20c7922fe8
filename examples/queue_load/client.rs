//! What a client asks.

use std::time::Duration;

use jiff::Timestamp;
use serde_json::{Value, json};

use crate::serving::Serving;

/// A pause between two looks.
const TICK: Duration = Duration::from_millis(5);

/// Columns and rows of a map whose job takes milliseconds, and of one whose job takes seconds.
pub const SMALL: [usize; 2] = [30, 24];
pub const LARGE: [usize; 2] = [2_000, 1_000];

/// A client of one process.
pub struct Client {
    agent: ureq::Agent,
    address: String,
}

impl Client {
    pub fn of(service: &Serving) -> Self {
        Self { agent: ureq::Agent::new_with_defaults(), address: format!("http://{}", service.address) }
    }

    pub fn get(&self, path: &str) -> Value {
        let answer = self.agent.get(format!("{}{path}", self.address)).call();
        answer.and_then(|mut answer| answer.body_mut().read_json()).expect("it answers")
    }

    /// Uploads a hall, which is another one for each number. Answers the path of its job.
    pub fn upload(&self, [columns, rows]: [usize; 2], number: usize) -> String {
        let is_rack =
            |column, row: usize| row % 8 < 2 && row > 5 && row + 6 < rows && (5..columns - 5).contains(&column);
        let is_wall = |column, row| column == 0 || row == 0 || column + 1 == columns || row + 1 == rows;
        // The number in binary stands along a wall.
        let is_mark = |column, row| row == 1 && column < 24 && number >> column & 1 == 1;
        let value = |column, row| {
            if is_wall(column, row) || is_rack(column, row) || is_mark(column, row) { 100 } else { 0 }
        };
        let data: Vec<u8> = (0..rows).flat_map(|row| (0..columns).map(move |column| value(column, row))).collect();
        let position = json!({"x": 0.0, "y": 0.0, "z": 0.0});
        let orientation = json!({"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0});
        let origin = json!({"position": position, "orientation": orientation});
        let info = json!({"resolution": 0.25, "width": columns, "height": rows, "origin": origin});
        let message = json!({"header": {"frame_id": "map"}, "info": info, "data": data});
        let answer = self.agent.post(format!("{}/v1/maps", self.address)).send_json(message).expect("it is taken");
        answer.headers()["location"].to_str().expect("is text").to_owned()
    }

    /// Whether a job runs.
    pub fn is_busy(&self) -> bool {
        self.has_jobs("running")
    }

    /// Waits until no job waits or runs.
    pub fn wait_until_idle(&self) {
        self.wait_until_idle_with(TICK);
    }

    /// The same with another pause between two looks.
    pub fn wait_until_idle_with(&self, pause: Duration) {
        while self.has_jobs("accepted,running") {
            std::thread::sleep(pause);
        }
    }

    /// Waits until a job runs for the n-th time.
    pub fn wait_for_attempt(&self, job: &str, attempt: u64) {
        while (self.job(job)["status"].as_str(), self.job(job)["attempt"].as_u64()) != (Some("running"), Some(attempt))
        {
            std::thread::sleep(TICK);
        }
    }

    fn job(&self, path: &str) -> Value {
        self.get(path.strip_prefix(&self.address).unwrap_or(path))
    }

    fn has_jobs(&self, states: &str) -> bool {
        self.get(&format!("/v1/jobs?status={states}&limit=1"))["jobs"].as_array().is_some_and(|jobs| !jobs.is_empty())
    }

    /// How long a job waited before it began.
    pub fn wait_of(&self, job: &str) -> Duration {
        let job = self.job(job);
        let time = |name: &str| -> Timestamp { job[name].as_str().expect("a time").parse().expect("a time") };
        time("started").duration_since(time("created")).unsigned_abs()
    }
}
