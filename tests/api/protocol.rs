//! What holds for every request.

use axum::body::Body;
use axum::http::Method;
use serde_json::json;

use crate::client::{Api, request};

const MAP: &str = "/v1/maps/019ab3c2-5d10-7c41-9a53-0242ac120002";

#[tokio::test]
async fn the_landing_page_leads_to_everything() {
    let api = Api::new().await;
    let page = api.get("/").await.json();
    assert_eq!(page["links"][0]["href"], "http://stillage.test/");
    for link in page["links"].as_array().expect("links") {
        let path = link["href"].as_str().expect("an address").trim_start_matches("http://stillage.test");
        if !path.starts_with("/v1") && path != "/health/ready" {
            assert_eq!(api.get(path).await.status, 200, "{path}");
        }
    }
}

#[tokio::test]
async fn what_is_not_there_is_a_problem() {
    let api = Api::new().await;
    let problem = api.get("/nowhere").await.problem(404, "not-found");
    assert_eq!(problem["instance"], "/nowhere");
    api.get("/v1/maps/7").await.problem(404, "not-found");
    api.get("/v1/jobs/not-a-job/events").await.problem(404, "not-found");
    api.get("/problems/nonsense").await.problem(404, "not-found");
    assert_eq!(api.get("/problems/not-found").await.json()["status"], 404);
}

#[tokio::test]
async fn a_method_that_does_not_apply_is_told_which_do() {
    let api = Api::new().await;
    let answer = api.send(request(Method::PUT, "/v1/maps", &[], Body::empty())).await;
    answer.problem(405, "method-not-allowed");
    assert_eq!(answer.header("allow"), "GET,HEAD,POST");
}

#[tokio::test]
async fn options_and_head_work() {
    let api = Api::new().await;
    let answer = api.send(request(Method::OPTIONS, MAP, &[], Body::empty())).await;
    assert_eq!(answer.status, 204);
    assert_eq!(answer.header("allow"), "GET,HEAD,PATCH,DELETE");
    let answer = api.send(request(Method::HEAD, "/", &[], Body::empty())).await;
    assert_eq!(answer.status, 200);
    assert!(answer.body.is_empty());
}

#[tokio::test]
async fn the_head_of_an_answer_is_the_same_before_and_after_the_answer() {
    let api = Api::new().await;
    let faces = format!("{}/collections/faces/items", api.hall().await);
    for coding in ["identity", "gzip"] {
        let headers = [("accept-encoding", coding)];
        let head = async || api.send(request(Method::HEAD, &faces, &headers, Body::empty())).await;
        let before = head().await;
        let whole = api.get_with(&faces, &headers).await;
        for head in [before, head().await] {
            assert!(head.body.is_empty());
            assert_eq!(head.header("content-length"), whole.body.len().to_string(), "{coding}");
            for name in ["etag", "content-type", "content-encoding", "content-crs", "vary", "link"] {
                assert_eq!(head.header(name), whole.header(name), "{coding}: {name}");
            }
        }
    }
}

#[tokio::test]
async fn an_unknown_parameter_is_never_ignored() {
    let api = Api::new().await;
    for path in ["/?x=1", "/v1/maps?bogus=1", "/v1/jobs?limit=1&Limit=2", "/health/live?x"] {
        let problem = api.get(path).await.problem(400, "bad-parameter");
        assert!(problem["errors"][0]["parameter"].is_string(), "{path}: {problem}");
    }
    for path in ["/v1/maps?limit=0", "/v1/jobs?status=runing", "/v1/jobs?type=thing", "/v1/maps?after=7"] {
        api.get(path).await.problem(400, "bad-parameter");
    }
}

#[tokio::test]
async fn media_types_are_negotiated() {
    let api = Api::new().await;
    for accept in ["*/*", "application/json", "application/geo+json", "text/html,application/xml;q=0.9,*/*;q=0.8"] {
        assert_eq!(api.get_with("/", &[("accept", accept)]).await.status, 200, "{accept}");
    }
    let page = api.get_with("/", &[("accept", "text/html")]).await;
    assert_eq!((page.status.as_u16(), page.header("content-type")), (200, "text/html; charset=utf-8"));
    let answer = api.get_with("/", &[("accept", "image/png")]).await;
    answer.problem(406, "not-acceptable");
    assert_eq!(answer.header("vary").split(", ").next(), Some("accept"));
}

#[tokio::test]
async fn bodies_say_what_they_are() {
    let api = Api::new().await;
    let post = |path: &'static str, content_type: &'static str, body: &'static str| {
        api.send(request(Method::POST, path, &[("content-type", content_type)], Body::from(body)))
    };
    post("/v1/maps", "text/plain", "x").await.problem(415, "unsupported-media-type");
    post("/v1/rule-sets", "text/plain", "{}").await.problem(415, "unsupported-media-type");
    post("/v1/rule-sets", "application/json", "{").await.problem(400, "bad-request");
    let problem = post("/v1/rule-sets", "application/json", r#"{"labels": [{"id": 7}]}"#).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/labels/0/id");
    post("/v1/maps", "multipart/form-data", "x").await.problem(400, "bad-request");
}

#[tokio::test]
async fn a_body_over_the_limit_is_refused() {
    let api = Api::with(|config| config.limits.max_bytes = 1_000).await;
    let cells = vec![0; 500_000];
    let message = json!({"info": {"resolution": 0.05, "width": 1000, "height": 500}, "data": cells});
    api.send_json(Method::POST, "/v1/maps", &[], &message).await.problem(413, "too-large");
    // A body that says how large it is, is refused before it is read.
    let headers = [("content-type", "application/json"), ("content-length", "999999999")];
    api.send(request(Method::POST, "/v1/maps", &headers, Body::from("{"))).await.problem(413, "too-large");
    let rules = json!({"id": "x", "labels": [], "padding": "x".repeat(9 << 20)});
    api.send_json(Method::POST, "/v1/rule-sets", &[], &rules).await.problem(413, "too-large");
}

#[tokio::test]
async fn a_request_has_one_host() {
    let api = Api::new().await;
    api.send_raw(request(Method::GET, "/", &[], Body::empty())).await.problem(400, "bad-request");
    let two = request(Method::GET, "/", &[("host", "a"), ("host", "b")], Body::empty());
    api.send_raw(two).await.problem(400, "bad-request");
    for host in ["a b", "stillage.test/x", "a@stillage.test"] {
        api.get_with("/", &[("host", host)]).await.problem(400, "bad-request");
    }
    assert_eq!(api.get("http://stillage.test/").await.status, 200);
    let other = api.send(request(Method::GET, "http://evil.example/", &[], Body::empty())).await;
    other.problem(400, "bad-request");
}

#[tokio::test]
async fn a_name_that_leads_here_by_the_will_of_another_site_is_refused() {
    let api = Api::new().await;
    let map = api.hall().await;
    // A page of rebound.example, whose name leads to loopback by now: for the browser it is a page of this service.
    let rebound = [("host", "rebound.example:8080"), ("origin", "http://rebound.example:8080")];
    for (method, path) in [(Method::GET, map.as_str()), (Method::DELETE, &map), (Method::GET, "/health/live")] {
        let problem = api.send(request(method, path, &rebound, Body::empty())).await.problem(421, "misdirected");
        assert!(
            problem["detail"].as_str().is_some_and(|it| it.contains("--allowed-hosts rebound.example ")),
            "{problem}"
        );
    }
    for host in ["localhost:8080", "127.0.0.1:8080", "[::1]:8080", "10.0.0.5"] {
        assert_eq!(api.get_with(&map, &[("host", host)]).await.status, 200, "{host}");
    }
    let told = Api::with(|config| config.allowed_hosts = vec!["*.example".parse().expect("is a pattern")].into()).await;
    assert_eq!(told.get_with("/", &rebound).await.status, 200);
}

#[tokio::test]
async fn behind_a_trusted_proxy_the_host_that_clients_ask_for_counts() {
    let forwarded = [("host", "stillage.test"), ("x-forwarded-host", "rebound.example")];
    let trusting = Api::with(|config| config.trust_proxy = true).await;
    trusting.get_with("/", &forwarded).await.problem(421, "misdirected");
    let wary = Api::new().await;
    assert_eq!(wary.get_with("/", &forwarded).await.status, 200, "the header means nothing");
}

#[tokio::test]
async fn pages_of_other_sites_read_and_do_not_write() {
    let api = Api::new().await;
    let answer = api.get_with("/", &[("origin", "https://example.org")]).await;
    assert_eq!(answer.header("access-control-allow-origin"), "*");
    for name in ["etag", "location", "link", "content-crs", "preference-applied", "retry-after"] {
        assert!(answer.header("access-control-expose-headers").contains(name), "{name}");
    }
    let own = [("origin", "http://stillage.test"), ("content-type", "text/plain")];
    let write = api.send(request(Method::POST, "/v1/rule-sets", &own, Body::from("x"))).await;
    assert_eq!((write.status.as_u16(), write.header("access-control-allow-origin")), (415, ""), "not for writes");
    let preflight = [("origin", "https://example.org"), ("access-control-request-method", "POST")];
    let answer = api.send(request(Method::OPTIONS, "/v1/maps", &preflight, Body::empty())).await;
    assert_eq!(answer.header("access-control-allow-methods"), "GET, HEAD");
    let foreign = [("origin", "https://example.org"), ("content-type", "multipart/form-data; boundary=x")];
    api.send(request(Method::POST, "/v1/maps", &foreign, Body::from("--x--"))).await.problem(403, "cross-origin-write");
}

#[tokio::test]
async fn a_slash_at_the_end_changes_nothing() {
    let api = Api::new().await;
    let map = api.hall().await;
    for path in ["/v1/maps", &map, &format!("{map}/collections"), &format!("{map}/collections/faces/items")] {
        let answer = api.get(&format!("{path}/?f=json")).await;
        assert_eq!((answer.status.as_u16(), answer.body), (200, api.get(path).await.body), "{path}");
    }
}

#[tokio::test]
async fn every_answer_has_an_id_and_is_not_sniffed() {
    let api = Api::new().await;
    let answer = api.get_with("/nowhere", &[("x-request-id", "robot-7")]).await;
    assert_eq!(answer.header("x-request-id"), "robot-7");
    assert_eq!(answer.header("x-content-type-options"), "nosniff");
    assert!(!api.get("/").await.header("x-request-id").is_empty());
}

#[tokio::test]
async fn the_document_is_served_compressed_and_conditionally() {
    let api = Api::new().await;
    let answer = api.get("/openapi.json").await;
    assert_eq!(answer.header("content-type"), "application/vnd.oai.openapi+json;version=3.1");
    assert_eq!(answer.json()["openapi"], "3.1.0");
    let tag = answer.header("etag").to_owned();
    let answer = api.get_with("/openapi.json", &[("if-none-match", &tag)]).await;
    assert_eq!((answer.status.as_u16(), answer.header("etag"), answer.body.len()), (304, tag.as_str(), 0));
    for coding in ["gzip", "zstd"] {
        let answer = api.get_with("/openapi.json", &[("accept-encoding", coding)]).await;
        assert_eq!(answer.header("content-encoding"), coding);
        assert_eq!(answer.header("etag"), tag.trim_end_matches('"').to_owned() + "-" + coding + "\"");
        let own = answer.header("etag").to_owned();
        let again = api.get_with("/openapi.json", &[("accept-encoding", coding), ("if-none-match", &own)]).await;
        assert_eq!((again.status.as_u16(), again.header("etag")), (304, own.as_str()));
    }
}

#[tokio::test]
async fn the_reference_page_loads_nothing_from_elsewhere() {
    let api = Api::new().await;
    assert_eq!(api.get("/docs").await.status, 303);
    let page = api.get_with("/docs/", &[("accept", "text/html")]).await;
    assert_eq!(page.status, 200);
    assert!(!page.text().contains("https://"), "{}", page.text());
    assert!(api.get("/docs/swagger-initializer.js").await.text().contains("/openapi.json"));
    assert_eq!(api.get("/docs/swagger-ui-bundle.js").await.status, 200);
    assert!(page.header("content-security-policy").starts_with("default-src 'self'"));
}
