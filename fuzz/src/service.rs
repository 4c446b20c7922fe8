//! A request to a service in this process, which has one map.
//!
//! The bytes are a request as it is sent. `{mapId}` in its first line stands for the map.

use std::cell::RefCell;
use std::sync::Arc;

use axum::body::Body;
use axum::http::Request;
use http_body_util::BodyExt as _;
use stillage::app::App;
use stillage::config::Config;
use tokio::runtime::{Builder, Runtime};
use tower::ServiceExt as _;

/// Requests after which the service begins anew, as what is stored makes it slower.
const REQUESTS: usize = 2_000;
/// What a service answers that cannot go on at the moment.
const FOR_A_MOMENT: [u16; 2] = [503, 507];

struct Service {
    router: axum::Router,
    map: String,
    left: usize,
    _folder: tempfile::TempDir,
}

thread_local! {
    static RUNTIME: Runtime = Builder::new_current_thread().enable_all().build().expect("threads can be had");
    static SERVICE: RefCell<Option<Service>> = const { RefCell::new(None) };
}

/// A request, which is answered and never fails.
pub fn request(bytes: &[u8]) {
    SERVICE.with_borrow_mut(|service| {
        RUNTIME.with(|runtime| {
            runtime.block_on(async {
                let service = match service.as_mut().filter(|service| service.left > 0) {
                    Some(service) => service,
                    None => service.insert(Service::start().await),
                };
                service.left -= 1;
                if let Some(request) = read(bytes, &service.map) {
                    let (status, _) = service.answer(request).await;
                    assert!(status < 500 || FOR_A_MOMENT.contains(&status), "{status}");
                }
            });
        });
    });
}

impl Service {
    async fn start() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut config = Config::new(folder.path());
        (config.min_free_bytes, config.job_slots) = (0, 0);
        (config.limits.max_bytes, config.limits.max_cells) = (1 << 20, 1 << 16);
        let app = App::open(config).await.expect("the service opens");
        let router = stillage::http::router(Arc::clone(&app));
        let mut service = Self { router, map: String::new(), left: REQUESTS, _folder: folder };
        let upload = Request::post("/v1/maps").header("host", "localhost").header("content-type", "application/json");
        let (status, answer) = service.answer(upload.body(hall().into()).expect("is a request")).await;
        assert_eq!(status, 202, "{answer}");
        app.run_until_empty().await.expect("the queue can be worked on");
        let job: serde_json::Value = serde_json::from_str(&answer).expect("is JSON");
        service.map += job["mapId"].as_str().expect("an id");
        service
    }

    /// Status and beginning of the answer, which is read whole where it ends.
    async fn answer(&self, request: Request<Body>) -> (u16, String) {
        let response = self.router.clone().oneshot(request).await.expect("the router always answers");
        let (head, body) = response.into_parts();
        let is_endless = head.headers.get("content-type").is_some_and(|kind| kind == "text/event-stream");
        let body = if is_endless { Vec::new() } else { body.collect().await.expect("can be read").to_bytes().to_vec() };
        (head.status.as_u16(), String::from_utf8_lossy(&body).into_owned())
    }
}

/// A request out of its bytes, where they are one.
fn read(bytes: &[u8], map: &str) -> Option<Request<Body>> {
    let end = bytes.windows(4).position(|four| four == b"\r\n\r\n")?;
    let mut lines = bytes[..end].split(|byte| *byte == b'\n').map(|line| line.strip_suffix(b"\r").unwrap_or(line));
    let first = std::str::from_utf8(lines.next()?).ok()?.replace("{mapId}", map);
    let mut words = first.split(' ');
    let mut request = Request::builder().method(words.next()?).uri(words.next()?);
    for line in lines {
        let colon = line.iter().position(|byte| *byte == b':')?;
        request = request.header(&line[..colon], line[colon + 1..].trim_ascii());
    }
    request.body(bytes[end + 4..].to_vec().into()).ok()
}

/// A hall with two racks, as a message.
fn hall() -> String {
    let cell = |at: usize| match (at % 40, at / 40) {
        (0 | 39, _) | (_, 0 | 29) | (6..34, 8..11 | 18..21) => "100",
        _ => "0",
    };
    let data = (0..40 * 30).map(cell).collect::<Vec<_>>().join(",");
    format!(
        r#"{{"info": {{"resolution": 0.25, "width": 40, "height": 30, "origin": {{"position": {{"x": 0, "y": 0, "z": 0}},
        "orientation": {{"x": 0, "y": 0, "z": 0, "w": 1}}}}}}, "data": [{data}]}}"#
    )
}
