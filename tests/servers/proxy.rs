//! A TCP proxy of the tests' own: it passes bytes on, or does to them what networks and broken servers do.

#![allow(dead_code, reason = "each test target takes the faults that it needs")]

use std::io::{Read, Write};
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// How often a connection that is held looks whether it may go on.
const TICK: Duration = Duration::from_millis(5);

/// What happens to the bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// Nothing: they are passed on.
    None,
    /// Connections are closed, open ones too.
    Outage,
    /// Nothing arrives, and nobody is told: what a cut cable does. What was sent arrives when it ends.
    Partition,
    /// So many bytes a second on each connection.
    Slow(u32),
    /// Requests of HTTP are answered with the status 500.
    Refusal,
    /// One byte of what the server answers is another one, in each part that arrives of the body of an answer of HTTP.
    Corruption,
}

/// A running proxy; it ends with the process of the test.
#[derive(Debug, Clone)]
pub struct Proxy {
    address: SocketAddr,
    shared: Arc<Shared>,
}

#[derive(Debug)]
struct Shared {
    server: SocketAddr,
    fault: Mutex<Fault>,
    connections: Mutex<Vec<TcpStream>>,
    /// Whether a request came with a condition.
    saw_condition: AtomicBool,
}

impl Proxy {
    /// Begins to pass on what comes to a port of its own.
    pub fn before(server: SocketAddr) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let address = listener.local_addr().expect("it has one");
        let (fault, connections) = (Mutex::new(Fault::None), Mutex::default());
        let shared = Arc::new(Shared { server, fault, connections, saw_condition: AtomicBool::new(false) });
        let accepting = Arc::clone(&shared);
        std::thread::spawn(move || {
            for client in listener.incoming().flatten() {
                accepting.serve(client);
            }
        });
        Self { address, shared }
    }

    /// Where it listens.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// From now on this happens.
    pub fn set(&self, fault: Fault) {
        *self.shared.fault.lock().unwrap_or_else(PoisonError::into_inner) = fault;
        if fault == Fault::Outage {
            let mut connections = self.shared.connections.lock().unwrap_or_else(PoisonError::into_inner);
            for connection in connections.drain(..) {
                let _ = connection.shutdown(Shutdown::Both);
            }
        }
    }

    /// Whether a request came with `If-None-Match` or `If-Match`.
    pub fn saw_condition(&self) -> bool {
        self.shared.saw_condition.load(Ordering::Relaxed)
    }
}

impl Shared {
    fn fault(&self) -> Fault {
        *self.fault.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn serve(self: &Arc<Self>, client: TcpStream) {
        // The server may start again meanwhile.
        let Some(server) = (self.fault() != Fault::Outage).then(|| TcpStream::connect(self.server).ok()).flatten()
        else {
            return;
        };
        let both = [&client, &server].map(|end| end.try_clone().expect("it can be cloned"));
        self.connections.lock().unwrap_or_else(PoisonError::into_inner).extend(both);
        let ends = [&client, &server].map(|end| end.try_clone().expect("it can be cloned"));
        let [client_again, server_again] = ends;
        let (to_server, to_client) = (Arc::clone(self), Arc::clone(self));
        std::thread::spawn(move || to_server.pass_on(client, server, Shared::request));
        std::thread::spawn(move || to_client.pass_on(server_again, client_again, Shared::answer));
    }

    /// Passes on until an end closes; `change` sees each part before, and says whether it goes on to the other end.
    fn pass_on(&self, mut from: TcpStream, mut to: TcpStream, change: fn(&Self, &mut [u8], &mut TcpStream) -> bool) {
        let mut buffer = [0; 16 << 10];
        while let Ok(read @ 1..) = from.read(&mut buffer) {
            let part = &mut buffer[..read];
            while self.fault() == Fault::Partition {
                std::thread::sleep(TICK);
            }
            if let Fault::Slow(rate) = self.fault() {
                std::thread::sleep(Duration::from_secs_f64(read as f64 / f64::from(rate)));
            }
            if change(self, part, &mut from) && to.write_all(part).is_err() {
                break;
            }
        }
        let _ = to.shutdown(Shutdown::Write);
    }

    /// A part that the client sent.
    fn request(&self, part: &mut [u8], client: &mut TcpStream) -> bool {
        let text = String::from_utf8_lossy(part).to_lowercase();
        if text.contains("if-none-match:") || text.contains("if-match:") {
            self.saw_condition.store(true, Ordering::Relaxed);
        }
        if self.fault() != Fault::Refusal {
            return true;
        }
        if ["get ", "put ", "post ", "delete ", "head "].iter().any(|method| text.starts_with(method)) {
            let answer = b"HTTP/1.1 500 Internal Server Error\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";
            let _ = client.write_all(answer);
            let _ = client.shutdown(Shutdown::Write);
        }
        false
    }

    /// A part that the server sent.
    fn answer(&self, part: &mut [u8], _: &mut TcpStream) -> bool {
        if self.fault() == Fault::Corruption {
            let head = part.windows(4).position(|bytes| bytes == b"\r\n\r\n").filter(|_| part.starts_with(b"HTTP/"));
            let begin = head.map_or(0, |end| end + 4);
            if let Some(byte) = part[begin..].last_mut() {
                *byte ^= 1;
            }
        }
        true
    }
}
