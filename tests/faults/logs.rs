//! What operators read in the log: lines with the ids of what they are about.

use std::io::Read as _;
use std::process::Stdio;

use serde_json::Value;

use crate::server::{Server, body, hall, status};

/// The lines that a service writes while something is done with it, until it has ended.
fn lines(arguments: &[&str], work: impl FnOnce(&Server)) -> Vec<String> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut server = Server::start_with(folder.path(), arguments, Stdio::piped());
    work(&server);
    let mut log = server.log().expect("it is piped");
    server.ask_to_stop();
    let mut text = String::new();
    log.read_to_string(&mut text).expect("is text");
    assert!(server.wait().success());
    text.lines().map(str::to_owned).collect()
}

#[test]
fn every_line_is_json_and_has_the_id_of_its_request_or_job() {
    let mut job = String::new();
    let lines = lines(&["--log-format", "json", "--log-level", "stillage=debug"], |server| {
        let message = hall(0);
        let answer = server.answer(
            format!(
                "POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nX-Request-Id: upload-7\r\n\
                 Connection: close\r\nContent-Length: {}\r\n\r\n{message}",
                message.len()
            )
            .as_bytes(),
        );
        assert!(status(&answer) == 202 && answer.contains("x-request-id: upload-7\r\n"), "{answer}");
        let document: Value = serde_json::from_str(body(&answer)).expect("is JSON");
        job = document["jobID"].as_str().expect("an id").to_owned();
        server.wait_until_idle();
        let odd = server
            .answer(b"GET /health/live HTTP/1.1\r\nHost: localhost\r\nX-Request-Id: a b\r\nConnection: close\r\n\r\n");
        assert!(odd.contains("x-request-id: ") && !odd.contains("a b"), "an id that is not plain is replaced: {odd}");
    });
    let lines: Vec<Value> =
        lines.iter().map(|line| serde_json::from_str(line).unwrap_or_else(|_| panic!("{line}"))).collect();
    for line in &lines {
        let members = ["timestamp", "level", "message", "target"];
        assert!(members.iter().all(|member| line[member].is_string()), "{line}");
    }
    let about = |message: &str| lines.iter().find(|line| line["message"] == message).expect("it is told");
    assert!(about("started")["version"].is_string());
    for message in ["job begun", "job finished"] {
        assert_eq!(
            (&about(message)["span"]["name"], &about(message)["span"]["job"]),
            (&"job".into(), &job.clone().into())
        );
    }
    let uploads: Vec<&Value> = lines.iter().filter(|line| line["span"]["request_id"] == "upload-7").collect();
    let answered = uploads.iter().find(|line| line["message"] == "answered").expect("it was");
    assert_eq!((&answered["status"], &answered["span"]["path"]), (&202.into(), &"/v1/maps".into()));
    let without = ["started", "stopping: running requests and jobs may end", "stopped"];
    for line in &lines {
        let has_id = line["span"]["request_id"].is_string() || line["span"]["job"].is_string();
        assert!(has_id || without.iter().any(|message| line["message"] == *message), "whose line is that? {line}");
    }
}

#[test]
fn a_warning_has_its_ids_where_only_warnings_are_logged() {
    let lines = lines(&["--log-format", "json", "--log-level", "warn", "--shutdown-grace-s", "0"], |server| {
        // It is put back when the service stops, or it ended before: then nothing is worth a warning.
        assert_eq!(status(&server.upload(&hall(0))), 202);
    });
    for line in lines {
        let line: Value = serde_json::from_str(&line).expect("is JSON");
        assert!(line["span"]["job"].is_string(), "{line}");
    }
}

#[test]
fn lines_for_people_have_them_too() {
    let lines = lines(&["--log", "info"], |server| {
        assert_eq!(status(&server.upload(&hall(0))), 202);
        server.wait_until_idle();
    });
    let finished = lines.iter().find(|line| line.contains("job finished")).expect("it is told");
    assert!(finished.contains("job=") && finished.contains("map="), "{finished}");
}
