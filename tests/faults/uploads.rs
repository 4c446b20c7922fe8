//! Uploads that do not come to their end.

use std::io::Write as _;
use std::net::TcpStream;
use std::time::{Duration, Instant};

use crate::server::{Server, rest, status};

/// Length of an upload, bytes.
const LENGTH: usize = 32 << 20;

/// Begins an upload, all of it but the end.
fn stalled(server: &Server) -> TcpStream {
    let head = format!(
        "POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nContent-Type: multipart/form-data; boundary=b\r\n\
         Content-Length: {}\r\n\r\n--b\r\nContent-Disposition: form-data; name=\"image\"\r\n\r\n",
        LENGTH + 1_000
    );
    let mut stream = server.connect(head.as_bytes());
    let bytes = vec![b'a'; 1 << 20];
    (0..LENGTH >> 20).for_each(|_| stream.write_all(&bytes).expect("it is read"));
    stream
}

#[test]
fn stalled_uploads_take_little_memory_and_end_with_the_standstill() {
    let server = Server::start(&[]);
    let before = server.memory();
    let uploads: Vec<TcpStream> = (0..10).map(|_| stalled(&server)).collect();
    std::thread::sleep(Duration::from_secs(1));
    let grown = server.memory().saturating_sub(before);
    assert!(grown < 64 << 20, "{} MiB for 320 MiB of uploads", grown >> 20);
    let sent = Instant::now();
    for upload in uploads {
        assert_eq!(status(&rest(upload)), 408);
    }
    assert!(sent.elapsed() < Duration::from_secs(20), "what came before gives no credit: {:?}", sent.elapsed());
}

#[test]
fn uploads_have_a_budget() {
    let server = Server::start(&["--max-uploading-mib", "40"]);
    let first = stalled(&server);
    std::thread::sleep(Duration::from_secs(1));
    let head = format!(
        "POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: {LENGTH}\r\n\
         Connection: close\r\n\r\n"
    );
    let refused = server.answer(head.as_bytes());
    assert_eq!(status(&refused), 503);
    assert!(refused.contains("retry-after: 5\r\n") && refused.contains("/problems/overloaded"), "{refused}");
    drop(first);
    std::thread::sleep(Duration::from_secs(1));
    let mut second = server.connect(head.as_bytes());
    second.write_all(&vec![b' '; LENGTH]).expect("there is room again");
    assert_eq!(status(&rest(second)), 422, "it is no map, and it was read whole");
}
