//! An orderly stop under load.

use std::io::{Read as _, Write as _};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use crate::server::{Server, status};

/// A request on a connection that is kept: head and body of the answer; nothing when the connection ended first.
fn ask(stream: &mut std::net::TcpStream) -> Option<String> {
    stream.write_all(b"GET /v1/maps HTTP/1.1\r\nHost: localhost\r\n\r\n").ok()?;
    let (mut bytes, mut buffer) = (Vec::new(), [0; 4_096]);
    loop {
        let read = stream.read(&mut buffer).ok().filter(|read| *read > 0)?;
        bytes.extend_from_slice(&buffer[..read]);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let Some((head, body)) = text.split_once("\r\n\r\n") else { continue };
        let length = head.lines().find_map(|line| line.strip_prefix("content-length: ")).expect("it has a length");
        if body.len() >= length.parse().expect("is a number") {
            return Some(text);
        }
    }
}

#[test]
fn clients_under_way_lose_no_request_when_the_service_is_asked_to_stop() {
    let mut server = Server::start(&["--shutdown-notice-s", "2"]);
    let (answered, lost) = (AtomicUsize::new(0), AtomicUsize::new(0));
    std::thread::scope(|scope| {
        for _ in 0..6 {
            scope.spawn(|| {
                let mut stream = std::net::TcpStream::connect(server.address).expect("it listens");
                loop {
                    let Some(answer) = ask(&mut stream) else {
                        lost.fetch_add(1, Ordering::Relaxed);
                        return;
                    };
                    assert_eq!(status(&answer), 200);
                    answered.fetch_add(1, Ordering::Relaxed);
                    // From now on a balancer asks elsewhere.
                    if answer.contains("connection: close\r\n") {
                        return;
                    }
                }
            });
        }
        std::thread::sleep(Duration::from_millis(500));
        assert_eq!(status(&server.get("/health/ready")), 200);
        server.ask_to_stop();
        let begin = Instant::now();
        std::thread::sleep(Duration::from_millis(300));
        let (ready, live) = (server.get("/health/ready"), server.get("/health/live"));
        assert_eq!((status(&ready), status(&live)), (503, 200), "not ready any more, and still there");
        assert!(begin.elapsed() < Duration::from_secs(2));
    });
    assert!(server.wait().success());
    let (answered, lost) = (answered.into_inner(), lost.into_inner());
    assert!(answered > 20, "{answered}");
    assert_eq!(lost, 0, "of {answered}");
}
