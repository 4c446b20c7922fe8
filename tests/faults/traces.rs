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

/// What a collector gets of a service that does something and is then stopped.
fn collected(work: impl FnOnce(&Server)) -> Vec<u8> {
    let (endpoint, received) = collector();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let arguments = ["--log", "error", "--otlp-endpoint", &endpoint];
    let mut server = Server::start_with(folder.path(), &arguments, Stdio::inherit());
    work(&server);
    server.ask_to_stop();
    assert!(server.wait().success());
    let mut bytes = Vec::new();
    while let Ok(more) = received.recv_timeout(Duration::from_secs(1)) {
        bytes.extend(more);
    }
    bytes
}

#[test]
fn a_collector_gets_the_spans_of_requests_and_jobs() {
    let bytes = collected(|server| {
        assert_eq!(status(&server.upload(&hall(0))), 202);
        server.wait_until_idle();
    });
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.starts_with("POST /v1/traces HTTP/1.1\r\n"), "{text}");
    for part in ["service.name", "stillage", "request_id", "/v1/maps", "attempt", "job finished"] {
        assert!(text.contains(part), "{part}");
    }
}

#[test]
fn the_trace_of_a_caller_goes_on_in_the_spans_of_its_request() {
    // Of the examples of W3C Trace Context, 3.2.
    let (trace, parent) = (0x4bf9_2f35_77b3_4da6_a3ce_929d_0e0e_4736_u128, 0x00f0_67aa_0ba9_02b7_u64);
    let request = |flags: &str| {
        format!(
            "GET /v1/maps HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\
             traceparent: 00-{trace:032x}-{parent:016x}-{flags}\r\n\r\n"
        )
    };
    let has = |bytes: &[u8], part: &[u8]| bytes.windows(part.len()).any(|window| window == part);
    let recorded = collected(|server| assert_eq!(status(&server.answer(request("01").as_bytes())), 200));
    assert!(has(&recorded, &trace.to_be_bytes()) && has(&recorded, &parent.to_be_bytes()));
    let unrecorded = collected(|server| assert_eq!(status(&server.answer(request("00").as_bytes())), 200));
    assert!(!has(&unrecorded, &trace.to_be_bytes()), "the caller does not record its trace");
}
