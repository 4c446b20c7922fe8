//! A client that costs little: requests written whole, one after the other on each connection.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use crate::CONNECTIONS;
use crate::serving::Serving;

/// Longest time that a question is asked for in a round: what is answered slowly is asked less often.
const LONGEST_ROUND: Duration = Duration::from_secs(4);

/// An answer as it came.
pub struct Answer {
    pub status: u16,
    /// Names in lower case.
    pub headers: Vec<(String, String)>,
    pub body: Vec<u8>,
}

impl Answer {
    pub fn header(&self, name: &str) -> Option<&str> {
        self.headers.iter().find(|(other, _)| other == name).map(|(_, value)| value.as_str())
    }

    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }
}

/// What was asked in some time.
#[derive(Default)]
pub struct Load {
    cpu: Duration,
    wall: Duration,
    /// Time of each request.
    times: Vec<Duration>,
}

impl Load {
    pub fn add(&mut self, other: &Self) {
        self.cpu += other.cpu;
        self.wall += other.wall;
        self.times.extend(&other.times);
    }

    /// Microseconds of the server.
    pub fn cpu_per_request(&self) -> f64 {
        self.cpu.as_secs_f64() * 1e6 / self.times.len() as f64
    }

    pub fn per_second(&self) -> f64 {
        self.times.len() as f64 / self.wall.as_secs_f64()
    }

    /// Milliseconds within which this share of the requests was answered.
    pub fn quantile(&self, share: f64) -> f64 {
        let mut times = self.times.clone();
        times.sort_unstable();
        times[((times.len() - 1) as f64 * share) as usize].as_secs_f64() * 1e3
    }
}

/// Asks once.
pub fn get(address: SocketAddr, path: &str, headers: &str) -> Answer {
    Connection::open(address).ask(&request(address, path, headers))
}

/// Asks for these paths by turns as often as told, but not longer than a round may take.
pub fn load(serving: &Serving, paths: &[String], headers: &str, times: usize) -> Load {
    let requests: Vec<Vec<u8>> = paths.iter().map(|path| request(serving.address, path, headers)).collect();
    // What is made at the first question is there when the time begins to count.
    Connection::open(serving.address).ask(&requests[0]);
    let (cpu, began) = (serving.cpu(), Instant::now());
    let turn = AtomicUsize::new(0);
    let ask = || {
        let mut connection = Connection::open(serving.address);
        let mut times_taken = Vec::with_capacity(times / CONNECTIONS);
        while times_taken.len() < times / CONNECTIONS && began.elapsed() < LONGEST_ROUND {
            let request = &requests[turn.fetch_add(1, Ordering::Relaxed) % requests.len()];
            let asked = Instant::now();
            connection.ask(request);
            times_taken.push(asked.elapsed());
        }
        times_taken
    };
    let times = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..CONNECTIONS).map(|_| scope.spawn(ask)).collect();
        threads.into_iter().flat_map(|thread| thread.join().expect("no thread panics")).collect()
    });
    Load { cpu: serving.cpu().saturating_sub(cpu), wall: began.elapsed(), times }
}

fn request(address: SocketAddr, path: &str, headers: &str) -> Vec<u8> {
    format!("GET {path} HTTP/1.1\r\nhost: {address}\r\n{headers}\r\n").into_bytes()
}

struct Connection {
    stream: BufReader<TcpStream>,
}

impl Connection {
    fn open(address: SocketAddr) -> Self {
        let stream = TcpStream::connect(address).expect("the process listens");
        stream.set_nodelay(true).expect("a socket");
        Self { stream: BufReader::with_capacity(64 << 10, stream) }
    }

    fn ask(&mut self, request: &[u8]) -> Answer {
        self.stream.get_mut().write_all(request).expect("the connection is open");
        let first = self.line();
        let status = first.split(' ').nth(1).and_then(|status| status.parse().ok()).expect("a status");
        let headers: Vec<(String, String)> = std::iter::from_fn(|| Some(self.line()).filter(|line| !line.is_empty()))
            .filter_map(|line| line.split_once(": ").map(|(name, value)| (name.to_ascii_lowercase(), value.to_owned())))
            .collect();
        let mut answer = Answer { status, headers, body: Vec::new() };
        assert!(status < 400, "answered {status}");
        match answer.header("content-length").map(|length| length.parse().expect("a number")) {
            Some(length) => {
                answer.body.resize(length, 0);
                self.stream.read_exact(&mut answer.body).expect("the body comes whole");
            }
            None if status == 304 => {}
            None => answer.body = self.chunks(),
        }
        answer
    }

    fn chunks(&mut self) -> Vec<u8> {
        let mut body = Vec::new();
        loop {
            let length = usize::from_str_radix(&self.line(), 16).expect("the length of a chunk");
            let end = body.len() + length;
            body.resize(end, 0);
            self.stream.read_exact(&mut body[end - length..]).expect("a whole chunk");
            self.line();
            if length == 0 {
                return body;
            }
        }
    }

    fn line(&mut self) -> String {
        let mut line = String::new();
        self.stream.read_line(&mut line).expect("a line");
        line.truncate(line.trim_end().len());
        line
    }
}
