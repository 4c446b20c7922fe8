//! Requests that two programs may read differently.

use crate::server::{Server, status};

#[test]
fn what_others_read_differently_is_refused() {
    let server = Server::start(&[]);
    for (name, request) in [
        ("line feeds alone", "GET /health/live HTTP/1.1\nHost: localhost\n\n"),
        ("one line feed alone", "GET /health/live HTTP/1.1\r\nHost: localhost\nA: b\r\n\r\n"),
        ("a line feed at the end", "GET /health/live HTTP/1.1\r\nHost: localhost\r\n\n"),
        ("a user in the host", "GET /health/live HTTP/1.1\r\nHost: a@localhost\r\nConnection: close\r\n\r\n"),
        ("another host in the address", "GET http://evil/ HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"),
    ] {
        assert_eq!(status(&server.answer(request.as_bytes())), 400, "{name}");
    }
    let second = "POST /v1/rule-sets HTTP/1.1\r\nHost: localhost\r\nContent-Type: text/plain\r\nContent-Length: 3\r\n\r\n\n\n\n\
                  GET /health/live HTTP/1.1\r\nHost: localhost\n\n";
    let answers = server.answer(second.as_bytes());
    let statuses: Vec<&str> = answers.match_indices("HTTP/1.1 ").map(|(at, _)| &answers[at + 9..at + 12]).collect();
    assert_eq!(statuses, ["415", "400"], "the body is nobody's business, the head behind it is: {answers}");
}
