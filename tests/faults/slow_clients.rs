//! Clients that send, read or follow slowly, or not at all.

use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use rustix::net::sockopt::set_socket_recv_buffer_size;

use crate::server::{Server, is_closed, status};

/// After this time a connection that waits for its client makes room for another.
const MOMENT: Duration = Duration::from_millis(1_200);
/// A newcomer is answered within this time, on a busy machine and by a debug build.
const SOON: Duration = Duration::from_secs(5);
/// Who stands still is closed by now: 15 s, and something for a busy machine.
const STANDSTILL: Duration = Duration::from_secs(20);

/// Each of some newcomers is answered soon, however often it has to come back.
#[track_caller]
fn newcomers_are_served(server: &Server) {
    for _ in 0..10 {
        let begin = Instant::now();
        while status(&server.get("/health/live")) != 200 {
            assert!(begin.elapsed() < SOON, "{:?}", begin.elapsed());
            std::thread::sleep(Duration::from_millis(50));
        }
    }
}

/// How many of the connections were closed within a time.
fn closed_within(connections: &mut [TcpStream], time: Duration) -> usize {
    let begin = Instant::now();
    loop {
        let closed = connections.iter_mut().filter_map(|stream| is_closed(stream).then_some(())).count();
        if closed == connections.len() || begin.elapsed() > time {
            return closed;
        }
        std::thread::sleep(Duration::from_millis(100));
    }
}

#[test]
fn slow_heads_leave_room_for_newcomers_and_are_closed() {
    let server = Server::start(&["--max-connections", "32"]);
    let head = b"GET /health/live HTTP/1.1\r\nHost: localhost\r\nX-A: ";
    let mut slow: Vec<TcpStream> = (0..16).map(|_| server.connect(head)).collect();
    assert_eq!(
        status(&server.get("/health/live")),
        503,
        "half of the places are of one address, and nobody is late yet"
    );
    std::thread::sleep(MOMENT);
    newcomers_are_served(&server);
    assert_eq!(closed_within(&mut slow, STANDSTILL), 16);
}

#[test]
fn slow_readers_leave_room_for_newcomers_and_are_closed() {
    let server = Server::start(&["--max-connections", "32"]);
    let ask = b"GET /openapi.json HTTP/1.1\r\nHost: localhost\r\n\r\n".repeat(20);
    let before = server.sockets();
    let readers: Vec<TcpStream> = (0..16)
        .map(|_| {
            let mut stream = server.connect(b"");
            set_socket_recv_buffer_size(&stream, 4_096).expect("can be set");
            stream.write_all(&ask).expect("it is read");
            stream
        })
        .collect();
    std::thread::sleep(MOMENT);
    assert!(server.sockets() > before + 8, "they are being answered");
    newcomers_are_served(&server);
    std::thread::sleep(STANDSTILL);
    assert_eq!(server.sockets(), before, "what they did not take is given up");
    drop(readers);
}

#[test]
fn streams_of_events_are_bounded() {
    let server = Server::start(&["--max-event-streams", "8", "--job-slots", "0"]);
    let message = r#"{"info": {"resolution": 0.05, "width": 2, "height": 1, "origin": {"position": {"x": 0, "y": 0, "z": 0},
        "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}}, "data": [0, 100]}"#;
    let upload = format!(
        "POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nConnection: close\r\n\
         Content-Length: {}\r\n\r\n{message}",
        message.len()
    );
    let answer = server.answer(upload.as_bytes());
    let job = answer.lines().find_map(|line| line.strip_prefix("location: ")).expect("where the job is").to_owned();
    let watch = format!("GET {job}/events HTTP/1.1\r\nHost: localhost\r\n\r\n");
    let streams: Vec<TcpStream> = (0..2).map(|_| server.connect(watch.as_bytes())).collect();
    std::thread::sleep(Duration::from_millis(300));
    let refused = server.get(&format!("{job}/events"));
    assert_eq!(status(&refused), 503, "an address has a quarter of them");
    assert!(refused.contains("retry-after: 10\r\n"), "{refused}");
    newcomers_are_served(&server);
    drop(streams);
    std::thread::sleep(Duration::from_millis(300));
    let mut again = server.connect(watch.as_bytes());
    let mut first = [0; 12];
    again.read_exact(&mut first).expect("it answers");
    assert_eq!(&first, b"HTTP/1.1 200");
}
