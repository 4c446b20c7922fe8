//! Requests as real clients and proxies send them.

use std::io::Write as _;

use axum::body::Body;
use axum::http::{Method, Request};
use flate2::Compression;
use flate2::write::GzEncoder;
use serde_json::json;

use crate::client::{Api, HALL, METADATA, pgm, request};

const MESSAGE: &str = r#"{"info": {"resolution": 0.25, "width": 3, "height": 2, "origin": {"position": {"x": 0, "y": 0, "z": NaN},
    "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}}, "data": [0, 0, 100, -1, 0, 100]}"#;

fn gzip(content: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(content).expect("memory");
    encoder.finish().expect("memory")
}

fn post(headers: &[(&str, &str)], body: impl Into<Body>) -> Request<Body> {
    request(Method::POST, "/v1/maps", headers, body.into())
}

/// A form whose parts come with their headers.
fn form(content_type: &str, parts: &[(&str, &[u8])]) -> Request<Body> {
    let mut body = Vec::new();
    for (headers, content) in parts {
        body.extend(format!("--b=0\r\n{headers}\r\n\r\n").bytes());
        body.extend_from_slice(content);
        body.extend_from_slice(b"\r\n");
    }
    body.extend_from_slice(b"--b=0--\r\n");
    post(&[("content-type", content_type)], body)
}

#[tokio::test]
async fn bodies_come_in_gzip_and_zstd() {
    let api = Api::new().await;
    let zstd = zstd_frame(MESSAGE.as_bytes());
    for (coding, body) in [("gzip", gzip(MESSAGE.as_bytes())), ("X-GZIP", gzip(MESSAGE.as_bytes())), ("zstd", zstd)] {
        let answer = api.send(post(&[("content-type", "application/json"), ("content-encoding", coding)], body)).await;
        assert_eq!(answer.status, 202, "{coding}: {}", answer.text());
    }
    let form = form("multipart/form-data; boundary=b=0", &upload_parts("image", &pgm(HALL)));
    let (mut head, body) = form.into_parts();
    let body = http_body_util::BodyExt::collect(body).await.expect("memory").to_bytes();
    head.headers.insert("content-encoding", "gzip".parse().expect("is a header"));
    let answer = api.send(Request::from_parts(head, Body::from(gzip(&body)))).await;
    assert_eq!(answer.status, 202, "{}", answer.text());
}

/// A zstd frame of one raw block (RFC 8878).
fn zstd_frame(content: &[u8]) -> Vec<u8> {
    let length = content.len() as u32;
    let mut frame = vec![0x28, 0xb5, 0x2f, 0xfd, 0b1010_0000];
    frame.extend(length.to_le_bytes());
    frame.extend(&(length << 3 | 1).to_le_bytes()[..3]);
    frame.extend(content);
    frame
}

#[tokio::test]
async fn other_codings_and_bombs_are_refused() {
    let api = Api::with(|config| config.limits.max_bytes = 1 << 20).await;
    let send = |coding: &'static str, body: Vec<u8>| {
        api.send(post(&[("content-type", "application/json"), ("content-encoding", coding)], body))
    };
    let answer = send("br", b"...".to_vec()).await;
    let problem = answer.problem(415, "unsupported-media-type");
    assert!(problem["detail"].as_str().expect("a text").contains("encoded as br"), "{problem}");
    assert_eq!(answer.header("accept-encoding"), "gzip, zstd");
    send("gzip", b"not gzip".to_vec()).await.problem(400, "bad-request");
    send("gzip", gzip(&vec![b' '; 16 << 20])).await.problem(413, "too-large");
    let base64 = [("content-type", "application/json"), ("content-transfer-encoding", "base64")];
    api.send(post(&base64, "e30=")).await.problem(415, "unsupported-media-type");
}

/// The parts of an upload, the image under a name that may want quotes.
fn upload_parts<'a>(image_name: &str, image: &'a [u8]) -> [(&'static str, &'a [u8]); 2] {
    let image_headers = match image_name {
        "image" => "Content-Disposition: form-data; name=\"image\"; filename=\"hall.pgm\"",
        _ => {
            "Content-Disposition: form-data; name=image; filename=\"=?utf-8?B?SGFsbGUgU8O8ZC5wbmc=?=\"; \
             filename*=utf-8''Halle%20S%C3%BCd.png\r\nContent-Type: image/png"
        }
    };
    [(image_headers, image), ("Content-Disposition: form-data; name=metadata", METADATA.as_bytes())]
}

#[tokio::test]
async fn forms_of_dotnet_have_readable_file_names() {
    let api = Api::new().await;
    let hall = pgm(HALL);
    let parts = upload_parts("bare", &hall);
    for content_type in ["multipart/form-data; boundary=\"b=0\"", "multipart/form-data; boundary=b=0; charset=utf-8"] {
        let answer = api.send(form(content_type, &parts)).await;
        assert_eq!(answer.status, 202, "{content_type}: {}", answer.text());
        let map = api.get(&format!("/v1/maps/{}", answer.json()["mapId"].as_str().expect("an id"))).await.json();
        assert_eq!(map["name"], "Halle Süd", "{content_type}");
    }
    let problem = api.send(form("multipart/form-data", &parts)).await.problem(400, "bad-request");
    assert!(problem["detail"].as_str().expect("a text").contains("boundary"), "{problem}");
}

#[tokio::test]
async fn parts_come_in_gzip_and_base64() {
    let api = Api::new().await;
    let zipped = gzip(&pgm(HALL));
    let metadata = "aW1hZ2U6IG1hcC5wZ20KcmVzb2x1dGlvbjogMC4yNQpvcmlnaW46IFswLCAwLCAwXQpuZWdhdGU6IDAKb2NjdXBpZWRf\r\n\
                    dGhyZXNoOiAwLjY1CmZyZWVfdGhyZXNoOiAwLjE5Ngo=";
    let image = "Content-Disposition: form-data; name=\"image\"; filename=\"hall.pgm.gz\"";
    let coded = "Content-Disposition: form-data; name=\"metadata\"\r\nContent-Transfer-Encoding: base64";
    let content_type = "multipart/form-data; boundary=\"b=0\"";
    let answer = api.send(form(content_type, &[(image, &zipped), (coded, metadata.as_bytes())])).await;
    assert_eq!(answer.status, 202, "{}", answer.text());
    let map = api.get(&format!("/v1/maps/{}", answer.json()["mapId"].as_str().expect("an id"))).await.json();
    assert_eq!((&map["name"], &map["width"]), (&json!("hall"), &json!(62)));
    let strange = format!("{image}\r\nContent-Encoding: br");
    let problem = api.send(form(content_type, &[(&strange, &zipped)])).await.problem(415, "unsupported-media-type");
    assert_eq!(problem["errors"][0]["pointer"], "/image");
}

#[tokio::test]
async fn a_message_comes_as_topic_echo_prints_it() {
    let api = Api::new().await;
    let echo = "info:\n  resolution: 0.25\n  width: 3\n  height: 1\n  origin:\n    position: {x: 0.0, y: 0.0, z: 0.0}\n\
                data:\n- 0\n- 100\n- -1\n---\n";
    let yaml = [("content-type", "application/yaml")];
    let answer = api.send(post(&yaml, echo)).await;
    assert_eq!(answer.status, 202, "{}", answer.text());
    let cut = echo.replace("- 100", "- '...'");
    let problem = api.send(post(&yaml, cut)).await.problem(422, "invalid");
    assert!(problem["detail"].as_str().expect("a text").contains("--full-length"), "{problem}");
    let as_metadata = form(
        "multipart/form-data; boundary=\"b=0\"",
        &[("Content-Disposition: form-data; name=\"metadata\"", echo.as_bytes())],
    );
    let problem = api.send(as_metadata).await.problem(422, "invalid");
    assert!(problem["detail"].as_str().expect("a text").contains("application/yaml"), "{problem}");
}

#[tokio::test]
async fn the_preference_for_an_early_answer_is_honoured() {
    let api = Api::new().await;
    let headers = [("content-type", "application/json"), ("prefer", "wait=10, respond-async")];
    let answer = api.send(post(&headers, MESSAGE)).await;
    assert_eq!((answer.status.as_u16(), answer.header("preference-applied")), (202, "respond-async"));
}

#[tokio::test]
async fn links_and_origins_follow_a_proxy_that_is_trusted() {
    let forwarded = [
        ("host", "10.0.0.5:8080"),
        ("x-forwarded-proto", "https, http"),
        ("x-forwarded-host", "maps.example.com"),
        ("x-forwarded-prefix", "/stillage"),
        ("content-type", "application/json"),
    ];
    let own_page = [forwarded.as_slice(), &[("origin", "https://maps.example.com")]].concat();
    let trusting = Api::with(|config| {
        config.trust_proxy = true;
        config.allowed_hosts = vec!["stillage.test".parse().unwrap(), "maps.example.com".parse().unwrap()].into();
    })
    .await;
    let page = trusting.get_with("/", &forwarded).await.json();
    assert_eq!(page["links"][0]["href"], "https://maps.example.com/stillage/");
    let answer = trusting.send(post(&own_page, MESSAGE)).await;
    assert_eq!(answer.status, 202, "{}", answer.text());
    assert!(answer.header("location").starts_with("/stillage/v1/jobs/"), "{}", answer.header("location"));
    let missing = trusting.get_with("/v1/nothing", &forwarded).await.problem(404, "not-found");
    assert_eq!(missing["instance"], "/stillage/v1/nothing");
    for document in ["/openapi.json", "/openapi-3.0.json"] {
        let through_proxy = trusting.get_with(document, &forwarded).await.json();
        assert_eq!(through_proxy["servers"][0]["url"], "/stillage/", "{document}");
        assert_eq!(trusting.get(document).await.json()["servers"][0]["url"], "/", "{document}");
    }
    let other_page = [forwarded.as_slice(), &[("origin", "https://example.org")]].concat();
    trusting.send(post(&other_page, MESSAGE)).await.problem(403, "cross-origin-write");

    let wary = Api::new().await;
    let page = wary.get_with("/", &forwarded).await.json();
    assert_eq!(page["links"][0]["href"], "http://10.0.0.5:8080/");
    wary.send(post(&own_page, MESSAGE)).await.problem(403, "cross-origin-write");
}
