//! Requests that two programs may read differently: what one takes for the body of a request is to the other the next request.

use crate::server::{Server, statuses};

/// Behind each request of the list: it is answered where the connection goes on.
const NEXT: &str = "GET /health/live HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
/// What is hidden in a body. Whoever reads it as a request answers 404.
const HIDDEN: &str = "GET /hidden HTTP/1.1\r\nHost: localhost\r\n\r\n";
/// Longer than any head.
const MEGABYTE: usize = 1_000_000;

fn get(headers: &str) -> String {
    format!("GET /health/live HTTP/1.1\r\nHost: localhost\r\n{headers}\r\n")
}

/// A write that is refused for its media type (415), whatever its body is.
fn post(headers: &str, body: &str) -> String {
    format!("POST /v1/rule-sets HTTP/1.1\r\nHost: localhost\r\n{headers}\r\n{body}")
}

/// A write in chunks, which is read.
fn chunks(body: &str) -> String {
    post("Content-Type: application/json\r\nTransfer-Encoding: chunked\r\n", body)
}

/// What each request is answered, and 200 at the end where the connection goes on.
#[track_caller]
fn answers(requests: &[(&str, String, &[u16])]) {
    let server = Server::start_watched(&[]);
    for (name, request, expected) in requests {
        let answer = server.answer(format!("{request}{NEXT}").as_bytes());
        assert_eq!(statuses(&answer), *expected, "{name}: {answer}");
        assert!(!answer.contains("//evil"), "{name} leads to another host: {answer}");
    }
    assert_eq!(server.logged(), "", "no panic, and nothing is an error of the service");
}

#[test]
fn lengths_that_contradict_one_another_end_the_connection() {
    let hidden = |headers: &str| post(headers, HIDDEN);
    let no_chunk = |headers: &str| post(headers, &format!("0\r\n\r\n{HIDDEN}"));
    answers(&[
        // Chunks rule over a length (RFC 9112, 6.1), and nobody is believed who sends both.
        ("a length and chunks", no_chunk("Content-Length: 5\r\nTransfer-Encoding: chunked\r\n"), &[415]),
        ("chunks and a length", no_chunk("Transfer-Encoding: chunked\r\nContent-Length: 5\r\n"), &[415]),
        ("a tab before chunks", no_chunk("Transfer-Encoding:\tchunked\r\nContent-Length: 4\r\n"), &[415]),
        ("two lengths", hidden("Content-Length: 0\r\nContent-Length: 60\r\n"), &[400]),
        ("the same length twice", post("Content-Length: 0\r\nContent-Length: 0\r\n", ""), &[415, 200]),
        ("a list of lengths", hidden("Content-Length: 0, 5\r\n"), &[400]),
        ("a length with a plus", post("Content-Length: +5\r\n", "hello"), &[400]),
        ("a negative length", post("Content-Length: -1\r\n", ""), &[400]),
        ("a hexadecimal length", post("Content-Length: 0x5\r\n", "hello"), &[400]),
        ("a length of 2^64", post("Content-Length: 18446744073709551616\r\n", ""), &[400]),
        ("a length with an exponent", post("Content-Length: 1e5\r\n", ""), &[400]),
        ("an unknown coding", no_chunk("Transfer-Encoding: xchunked\r\n"), &[400]),
        ("no coding", hidden("Transfer-Encoding: identity\r\n"), &[400]),
        ("a coding behind chunks", no_chunk("Transfer-Encoding: chunked, identity\r\n"), &[400]),
        ("a blank before the colon", no_chunk("Transfer-Encoding : chunked\r\n"), &[400]),
        ("a vertical tab before chunks", no_chunk("Transfer-Encoding: \x0bchunked\r\nContent-Length: 4\r\n"), &[400]),
        ("two codings", no_chunk("Transfer-Encoding: chunked\r\nTransfer-Encoding: identity\r\n"), &[400]),
        (
            "chunks in HTTP/1.0",
            no_chunk("Transfer-Encoding: chunked\r\nContent-Length: 5\r\n").replace("/1.1", "/1.0"),
            &[400],
        ),
    ]);
}

#[test]
fn a_body_is_never_the_next_request() {
    let length = format!("Content-Length: {}\r\n", HIDDEN.len());
    answers(&[
        ("a GET with a body", get(&length) + HIDDEN, &[200, 200]),
        ("a POST to nowhere", post(&length, HIDDEN).replace("/v1/rule-sets", "/nowhere"), &[404, 200]),
        ("line feeds in a body", post("Content-Length: 3\r\n", "\n\n\n"), &[415, 200]),
        ("a negative chunk", chunks("-1\r\n\r\n0\r\n\r\n"), &[400]),
        ("a chunk of 2^68 bytes", chunks("fffffffffffffffff\r\nabc\r\n0\r\n\r\n"), &[400]),
        ("a chunk with a plus", chunks("+2\r\n{}\r\n0\r\n\r\n"), &[400]),
        ("chunks with line feeds alone", chunks("2\n{}\n0\n\n"), &[400]),
        ("a chunk that is longer than it says", chunks(&format!("2\r\n{{}}XX0\r\n\r\n{HIDDEN}")), &[400]),
        ("an extension of a megabyte", chunks(&format!("2;{}\r\n{{}}\r\n0\r\n\r\n", "a".repeat(MEGABYTE))), &[400]),
        ("a trailer of a megabyte", chunks(&format!("2\r\n{{}}\r\n0\r\nX: {}\r\n\r\n", "a".repeat(MEGABYTE))), &[400]),
    ]);
}

#[test]
fn heads_that_others_read_differently_are_refused() {
    answers(&[
        ("line feeds alone", get("").replace("\r\n", "\n"), &[400]),
        ("one line feed alone", "GET /health/live HTTP/1.1\r\nHost: localhost\nA: b\r\n\r\n".into(), &[400]),
        ("a line feed at the end", "GET /health/live HTTP/1.1\r\nHost: localhost\r\n\n".into(), &[400]),
        ("a folded line", get("A: b\r\n c\r\n"), &[400]),
        ("a carriage return alone", get("A: b\rB: c\r\n"), &[400]),
        ("NUL in a value", get("A: b\0c\r\n"), &[400]),
        ("NUL in a name", get("A\0B: c\r\n"), &[400]),
        ("a blank before a name", "GET /health/live HTTP/1.1\r\n A: b\r\nHost: localhost\r\n\r\n".into(), &[400]),
        ("no name", get(": b\r\n"), &[400]),
        ("200 headers", get(&"A: b\r\n".repeat(200)), &[431]),
        ("a header of a megabyte", get(&format!("A: {}\r\n", "a".repeat(MEGABYTE))), &[431]),
        ("an address of a megabyte", get("").replace("health", &"a".repeat(MEGABYTE)), &[431]),
        ("a control character in the address", get("").replace("/live", "/\x01live"), &[400]),
        ("HTTP/0.9", "GET /health/live\r\n".into(), &[400]),
        ("HTTP/3.7", get("").replace("/1.1", "/3.7"), &[400]),
        ("the preface of HTTP/2", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n".into(), &[]),
    ]);
}

#[test]
fn no_other_host_is_believed() {
    let without_host = |request: &str| request.replace("Host: localhost\r\n", "");
    answers(&[
        ("no host", without_host(&get("")), &[400, 200]),
        ("two hosts", get("Host: evil\r\n"), &[400, 200]),
        ("a blank in the host", get("").replace("localhost", "a b"), &[400, 200]),
        ("a path in the host", get("").replace("localhost", "evil/x"), &[400, 200]),
        ("a user in the host", get("").replace("localhost", "a@evil"), &[400, 200]),
        ("another host in the address", get("").replace("/health", "http://evil/health"), &[400, 200]),
        ("another host", get("").replace("localhost", "evil.example"), &[421, 200]),
        ("a tunnel", "CONNECT evil:80 HTTP/1.1\r\nHost: evil:80\r\n\r\n".into(), &[421, 200]),
        (
            "the host of a proxy that nobody trusts",
            get("X-Forwarded-Host: evil\r\nX-Forwarded-Proto: https\r\n").replace("/health/live", "/v1/maps"),
            &[200, 200],
        ),
    ]);
}

#[test]
fn odd_methods_and_paths_are_answered_once() {
    let path = |path: &str| get("").replace("/health/live", path);
    answers(&[
        ("a method in small letters", get("").replace("GET", "get"), &[405, 200]),
        ("TRACE", get("").replace("GET", "TRACE"), &[405, 200]),
        ("NUL in the path", path("/v1/maps/%00"), &[404, 200]),
        ("a path out of the folder", path("/docs/../../../etc/passwd"), &[404, 200]),
        ("the same, hidden", path("/docs/..%2f..%2f..%2fetc/passwd"), &[404, 200]),
        ("a line end in what comes back", get("X-Request-Id: a%0d%0aSet-Cookie: x\r\n"), &[200, 200]),
    ]);
}
