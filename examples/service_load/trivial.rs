//! An axum handler that answers bytes it has in memory, whatever it is asked: the least that an answer costs.

use std::path::Path;
use std::process::ExitCode;

use axum::Router;
use axum::body::Bytes;
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode};

use crate::client::Answer;
use crate::serving::Serving;

/// Starts a process that gives this answer, with the headers it came with.
pub fn start(answer: &Answer, folder: &Path) -> Serving {
    let path = folder.join("answer.body").display().to_string();
    std::fs::write(&path, &answer.body).expect("the folder can be written");
    let given_by_server = ["content-length", "date", "transfer-encoding"];
    let headers = answer.headers.iter().filter(|(name, _)| !given_by_server.contains(&name.as_str()));
    let headers: Vec<String> = headers.map(|(name, value)| format!("{name}: {value}")).collect();
    let status = answer.status.to_string();
    let mut arguments = vec!["trivial", path.as_str(), status.as_str()];
    arguments.extend(headers.iter().map(String::as_str));
    Serving::start(&arguments)
}

/// Serves: arguments are the file of the body, the status and the headers.
pub fn run() -> ExitCode {
    let mut arguments = std::env::args().skip(2);
    let body = Bytes::from(arguments.next().and_then(|path| std::fs::read(path).ok()).expect("a file"));
    let status: StatusCode = arguments.next().and_then(|status| status.parse().ok()).expect("a status");
    let headers: HeaderMap = arguments.filter_map(|header| pair(&header)).collect();
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build().expect("a runtime");
    runtime.block_on(async {
        let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.expect("a free port");
        println!("http://{}/", listener.local_addr().expect("it is bound"));
        let router = Router::new().fallback(async move || (status, headers.clone(), body.clone()));
        axum::serve(listener, router).await.expect("it serves until it is killed");
    });
    ExitCode::SUCCESS
}

fn pair(header: &str) -> Option<(HeaderName, HeaderValue)> {
    let (name, value) = header.split_once(": ")?;
    Some((name.parse().ok()?, value.parse().ok()?))
}
