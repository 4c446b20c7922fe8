//! Spans that a collector gets.

use std::io::{Read as _, Write as _};
use std::net::TcpListener;
use std::process::Stdio;
use std::sync::mpsc;
use std::time::Duration;

use crate::server::{Server, hall, status};

/// A collector that takes everything: its address, and the bytes that it gets.
fn collector() -> (String, mpsc::Receiver<Vec<u8>>) {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
    let address = format!("http://{}", listener.local_addr().expect("has one"));
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        for stream in listener.incoming() {
            let (mut stream, sender) = (stream.expect("it comes"), sender.clone());
            std::thread::spawn(move || {
                let mut buffer = [0; 8_192];
                while let Ok(read @ 1..) = stream.read(&mut buffer) {
                    let bytes = buffer[..read].to_vec();
                    if bytes.starts_with(b"POST") {
                        let _ = stream.write_all(b"HTTP/1.1 200 OK\r\nContent-Length: 0\r\n\r\n");
                    }
                    let _ = sender.send(bytes);
                }
            });
        }
    });
    (address, receiver)
}

#[test]
fn a_collector_gets_the_spans_of_requests_and_jobs() {
    let (endpoint, received) = collector();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let arguments = ["--log", "error", "--otlp-endpoint", &endpoint];
    let mut server = Server::start_with(folder.path(), &arguments, Stdio::inherit());
    assert_eq!(status(&server.upload(&hall(0))), 202);
    server.wait_until_idle();
    server.ask_to_stop();
    assert!(server.wait().success());
    let mut bytes = Vec::new();
    while let Ok(more) = received.recv_timeout(Duration::from_secs(1)) {
        bytes.extend(more);
    }
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.starts_with("POST /v1/traces HTTP/1.1\r\n"), "{text}");
    for part in ["service.name", "stillage", "request_id", "/v1/maps", "attempt", "job finished"] {
        assert!(text.contains(part), "{part}");
    }
}
