//! Jobs: lists, dismissal, events.

use std::time::Duration;

use axum::body::Body;
use axum::http::Method;
use serde_json::Value;

use crate::client::{Answer, Api, HALL, METADATA, pgm, request, upload};

async fn queued(api: &Api) -> String {
    api.send(upload(&pgm(HALL), METADATA)).await.header("location").to_owned()
}

#[tokio::test]
async fn jobs_are_filtered_and_paged() {
    let api = Api::new().await;
    let done = queued(&api).await;
    api.app.run_until_empty().await.expect("the queue can be worked on");
    let waiting = [queued(&api).await, queued(&api).await];
    let list = |query: &'static str| {
        let api = &api;
        async move {
            let page = api.get(&format!("/v1/jobs{query}")).await.json();
            let path = |job: &Value| format!("/v1/jobs/{}", job["jobID"].as_str().expect("an id"));
            page["jobs"].as_array().expect("jobs").iter().map(path).collect::<Vec<String>>()
        }
    };
    let [first, second] = &waiting;
    assert_eq!(list("").await, [second.as_str(), first, &done]);
    assert_eq!(list("?status=successful").await, [done.as_str()]);
    assert_eq!(list("?status=accepted,running&type=process").await, [second.as_str(), first]);
    assert_eq!(list("?limit=1").await, [second.as_str()]);
    let page = api.get("/v1/jobs?limit=1&status=accepted").await.json();
    let next =
        page["links"][1]["href"].as_str().expect("a next page").trim_start_matches("http://stillage.test").to_owned();
    assert!(next.contains("status=accepted"), "{next}");
    let page = api.get(&next).await.json();
    assert_eq!(format!("/v1/jobs/{}", page["jobs"][0]["jobID"].as_str().expect("an id")), waiting[0]);
}

#[tokio::test]
async fn a_queued_job_is_dismissed_once() {
    let api = Api::new().await;
    let job = queued(&api).await;
    let dismiss = || api.send(request(Method::DELETE, &job, &[], Body::empty()));
    let answer = dismiss().await;
    assert_eq!((answer.status.as_u16(), &answer.json()["status"]), (200, &Value::from("dismissed")));
    dismiss().await.problem(409, "conflict");
    api.app.run_until_empty().await.expect("the queue can be worked on");
    assert_eq!(api.get(&job).await.json()["status"], "dismissed");
    let absent = "/v1/jobs/019ab3c2-5d10-7c41-9a53-0242ac120002";
    api.send(request(Method::DELETE, absent, &[], Body::empty())).await.problem(404, "not-found");
}

/// Ids and states of the events of a stream.
fn events(answer: &Answer) -> Vec<(String, String)> {
    assert_eq!(answer.header("content-type"), "text/event-stream");
    let text = answer.text();
    let events = text.split("\n\n").filter(|block| block.contains("event: progress"));
    let field = |block: &str, name: &str| {
        let line = block.lines().find_map(|line| line.strip_prefix(name));
        line.map(|value| value.trim_start_matches(':').trim().to_owned()).expect("the field is there")
    };
    let event = |block: &str| {
        let data: Value = serde_json::from_str(&field(block, "data")).expect("the data is a job");
        (field(block, "id"), data["status"].as_str().expect("a state").to_owned())
    };
    events.map(event).collect()
}

#[tokio::test]
async fn the_events_of_a_job_end_with_its_end() {
    let api = Api::new().await;
    let job = queued(&api).await;
    let path = format!("{job}/events");
    let (stream, worked) = tokio::join!(api.get(&path), api.app.run_until_empty());
    worked.expect("the queue can be worked on");
    let seen = events(&stream);
    assert!(seen.len() >= 2 && seen[0].1 != "successful", "{seen:?}");
    assert_eq!(seen.last().map(|event| event.1.as_str()), Some("successful"), "{seen:?}");
    let ids: Vec<i64> = seen.iter().map(|event| event.0.parse().expect("a number")).collect();
    assert!(ids.is_sorted_by(|earlier, later| earlier < later), "{ids:?}");
    // Whoever lost the connection early gets the end, whoever had it all is told to stay away.
    let resumed = api.get_with(&path, &[("last-event-id", &seen[0].0)]).await;
    assert_eq!(events(&resumed), [seen.last().expect("an end").clone()]);
    let over = api.get_with(&path, &[("last-event-id", &seen.last().expect("an end").0)]).await;
    assert_eq!(over.status, 204);
}

#[tokio::test]
async fn the_events_of_a_job_end_when_its_map_is_deleted() {
    let api = Api::new().await;
    let job = queued(&api).await;
    let map = api.get(&job).await.json()["mapId"].as_str().expect("an id").to_owned();
    let delete = request(Method::DELETE, &format!("/v1/maps/{map}"), &[], Body::empty());
    let events_path = format!("{job}/events");
    // The stream is open before the map goes.
    let later = async {
        tokio::time::sleep(Duration::from_millis(500)).await;
        api.send(delete).await
    };
    let (stream, deleted) = tokio::join!(api.get(&events_path), later);
    assert_eq!(deleted.status, 204);
    let states: Vec<String> = events(&stream).into_iter().map(|event| event.1).collect();
    assert_eq!(states, ["accepted", "dismissed"]);
    assert!(stream.text().contains("the map was deleted, and its jobs with it"), "{}", stream.text());
}

#[tokio::test]
async fn events_are_not_compressed() {
    let api = Api::new().await;
    let job = queued(&api).await;
    api.app.run_until_empty().await.expect("the queue can be worked on");
    let headers = [("accept-encoding", "gzip"), ("accept", "text/event-stream")];
    let answer = api.get_with(&format!("{job}/events"), &headers).await;
    assert_eq!((answer.status.as_u16(), answer.header("content-encoding")), (200, ""));
    api.get_with(&format!("{job}/events"), &[("accept", "application/json")]).await.problem(406, "not-acceptable");
}
