//! A client in the same process.

use std::sync::Arc;

use axum::body::Body;
use axum::http::{HeaderMap, Method, Request, StatusCode};
use http_body_util::BodyExt;
use serde_json::Value;
use stillage::app::App;
use stillage::config::Config;
use tower::ServiceExt;

/// A service in a folder of its own.
pub struct Api {
    pub app: Arc<App>,
    router: axum::Router,
    /// Sent with every request that has no `Authorization` of its own.
    pub key: Option<String>,
    _folder: tempfile::TempDir,
}

/// An answer, read whole.
#[derive(Debug)]
pub struct Answer {
    pub status: StatusCode,
    pub headers: HeaderMap,
    pub body: Vec<u8>,
}

impl Api {
    pub async fn new() -> Self {
        Self::with(|_| {}).await
    }

    pub async fn with(change: impl FnOnce(&mut Config)) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut config = Config::new(folder.path());
        config.min_free_bytes = 0;
        // Jobs run when a test says so.
        config.job_slots = 0;
        config.allowed_hosts = vec!["stillage.test".parse().expect("is a name")].into();
        change(&mut config);
        let app = App::open(config).await.expect("the service opens");
        Self { router: stillage::http::router(Arc::clone(&app)), app, key: None, _folder: folder }
    }

    /// Sends a request. `Host` is set unless the request has its own.
    pub async fn send(&self, mut request: Request<Body>) -> Answer {
        request.headers_mut().entry("host").or_insert("stillage.test".parse().expect("is a header"));
        if let Some(key) = &self.key {
            let bearer = format!("Bearer {key}").parse().expect("is a header");
            request.headers_mut().entry("authorization").or_insert(bearer);
        }
        self.send_raw(request).await
    }

    /// Sends a request as it is.
    pub async fn send_raw(&self, request: Request<Body>) -> Answer {
        let response = self.router.clone().oneshot(request).await.expect("the router always answers");
        let (parts, body) = response.into_parts();
        let body = body.collect().await.expect("the body can be read").to_bytes().to_vec();
        Answer { status: parts.status, headers: parts.headers, body }
    }

    pub async fn get(&self, path: &str) -> Answer {
        self.send(request(Method::GET, path, &[], Body::empty())).await
    }

    pub async fn get_with(&self, path: &str, headers: &[(&str, &str)]) -> Answer {
        self.send(request(Method::GET, path, headers, Body::empty())).await
    }

    pub async fn send_json(&self, method: Method, path: &str, headers: &[(&str, &str)], body: &Value) -> Answer {
        let mut request = request(method, path, headers, Body::from(body.to_string()));
        request.headers_mut().entry("content-type").or_insert("application/json".parse().expect("is a header"));
        self.send(request).await
    }
}

pub fn request(method: Method, path: &str, headers: &[(&str, &str)], body: Body) -> Request<Body> {
    let builder = Request::builder().method(method).uri(path);
    headers
        .iter()
        .fold(builder, |builder, (name, value)| builder.header(*name, *value))
        .body(body)
        .expect("is a request")
}

impl Answer {
    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|error| panic!("{error}: {}", self.text()))
    }

    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    pub fn header(&self, name: &str) -> &str {
        self.headers.get(name).map(|value| value.to_str().expect("is text")).unwrap_or_default()
    }

    /// The answer is a problem detail of this type; returns it.
    #[track_caller]
    pub fn problem(&self, status: u16, kind: &str) -> Value {
        assert_eq!(self.status.as_u16(), status, "{}", self.text());
        assert_eq!(self.header("content-type"), "application/problem+json");
        let problem = self.json();
        assert_eq!(problem["type"], format!("/problems/{kind}"), "{problem}");
        assert_eq!(problem["status"], status);
        for member in ["title", "detail", "instance"] {
            assert!(problem[member].as_str().is_some_and(|text| !text.is_empty()), "{member}: {problem}");
        }
        problem
    }
}

/// A small hall: two aisles between three double rows of pallets, and a cross aisle at either end.
pub const HALL: &str = "
    ##############################################################
    #............................................................#
    #............................................................#
    #............................................................#
    #............................................................#
    #....###..###..###..###..###..###..###..###..###..###........#
    #....#.#..#.#..#.#..#.#..#.#..#.#..#.#..#.#..#.#..#.#........#
    #....#.#..#.#..#.#..#.#..#.#..#.#..#.#..#.#..#.#..#.#........#
    #....###..###..###..###..###..###..###..###..###..###........#
    #............................................................#
    #............................................................#
    #............................................................#
    #............................................................#
    #....###..###..###..###..###..###..###..###..###..###........#
    #....#.#..#.#..#.#..#.#..#.#..#.#..#.#..#.#..#.#..#.#........#
    #....#.#..#.#..#.#..#.#..#.#..#.#..#.#..#.#..#.#..#.#........#
    #....###..###..###..###..###..###..###..###..###..###........#
    #............................................................#
    #............................................................#
    #............................................................#
    #............................................................#
    ##############################################################
";

/// Metadata of a map with cells of a quarter metre, whose origin is not zero.
pub const METADATA: &str = "image: map.pgm\nresolution: 0.25\norigin: [-2.0, -1.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// A picture in characters as a PGM file: `#` occupied, `.` free, anything else unknown.
pub fn pgm(picture: &str) -> Vec<u8> {
    let rows: Vec<&str> = picture.lines().map(str::trim_start).filter(|line| !line.is_empty()).collect();
    let width = rows.iter().map(|row| row.len()).max().unwrap_or_default();
    let mut bytes = format!("P5\n{width} {}\n255\n", rows.len()).into_bytes();
    for row in rows {
        let grey = |cell| match cell {
            b'#' => 0,
            b'.' => 254,
            _ => 205,
        };
        bytes.extend(row.bytes().chain(std::iter::repeat(b'?')).take(width).map(grey));
    }
    bytes
}

/// A form: names, file names and contents of its parts.
pub fn form(parts: &[(&str, Option<&str>, &[u8])]) -> Request<Body> {
    let mut body = Vec::new();
    for (name, file_name, content) in parts {
        let file_name = file_name.map(|file_name| format!("; filename=\"{file_name}\"")).unwrap_or_default();
        body.extend(
            format!("--boundary\r\nContent-Disposition: form-data; name=\"{name}\"{file_name}\r\n\r\n").bytes(),
        );
        body.extend_from_slice(content);
        body.extend_from_slice(b"\r\n");
    }
    body.extend_from_slice(b"--boundary--\r\n");
    request(Method::POST, "/v1/maps", &[("content-type", "multipart/form-data; boundary=boundary")], Body::from(body))
}

/// The form of an upload.
pub fn upload(image: &[u8], metadata: &str) -> Request<Body> {
    form(&[("image", Some("hall.pgm"), image), ("metadata", Some("hall.yaml"), metadata.as_bytes())])
}

impl Api {
    /// Uploads a map and analyses it; its path.
    pub async fn analysed(&self, image: &[u8]) -> String {
        let answer = self.send(upload(image, METADATA)).await;
        assert_eq!(answer.status, 202, "{}", answer.text());
        self.app.run_until_empty().await.expect("the queue can be worked on");
        let job = self.get(answer.header("location")).await.json();
        assert_eq!(job["status"], "successful", "{job}");
        format!("/v1/maps/{}", job["mapId"].as_str().expect("an id"))
    }

    /// An assignment that gives every category of a map one label.
    pub async fn all_labelled(&self, map: &str, label: &str) -> Value {
        let list = self.get(&format!("{map}/categories")).await.json();
        let count = list["categories"].as_array().map_or(0, Vec::len);
        (0..count).map(|category| (category.to_string(), Value::from(label))).collect()
    }

    /// Uploads the hall and analyses it; its path.
    pub async fn hall(&self) -> String {
        self.analysed(&pgm(HALL)).await
    }
}
