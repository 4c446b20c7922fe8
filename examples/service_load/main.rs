//! What a request costs the service, beside a trivial axum handler that answers the same bytes, in the same run.
//!
//! `cargo run --release --example service_load` draws a part of a warehouse of the paper's size (9,745 faces), has
//! it analysed by `stillage serve` in a process of its own, and asks the same questions of both processes by turns over
//! loopback. A second service on the same store, without memory for answers, shows what it saves. CPU is user and system time of the whole serving process, which the client does not share.

#![allow(clippy::print_stdout, clippy::panic, reason = "a program that prints a table, and stops where it cannot")]

mod client;
mod serving;
#[path = "../../crates/stillage-core/examples/paper_scale/site.rs"]
mod site;
mod trivial;
mod upload;

use std::path::Path;
use std::process::ExitCode;

use client::{Answer, Load};
use serving::Serving;

/// Connections that ask at once: what the two cores of a small machine can be kept busy with.
const CONNECTIONS: usize = 4;
/// Rounds of each question; service and trivial handler take turns, so that both meet the same neighbours.
const ROUNDS: usize = 3;

/// A question, and how often it is asked in a round.
struct Question {
    name: &'static str,
    path: String,
    headers: String,
    times: usize,
}

fn main() -> ExitCode {
    match std::env::args().nth(1).as_deref() {
        // The same program again, as the service or as the trivial handler.
        Some("serve" | "--version") => stillage::cli::run(),
        Some("trivial") => trivial::run(),
        _ => {
            measure();
            ExitCode::SUCCESS
        }
    }
}

fn measure() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let data = folder.path().join("data").display().to_string();
    let start = |mebibytes| {
        let memory = ["--cached-answer-mib", mebibytes];
        Serving::start(&[&["serve", "--listen", "127.0.0.1:0", "--data", &data], memory.as_slice()].concat())
    };
    let service = start("64");
    let map = upload::analysed_map(&service);
    let items = format!("/v1/maps/{map}/collections/faces/items");
    let whole = client::get(service.address, &format!("{items}?limit=10000"), "");
    let faces = whole.text().matches("\"type\":\"Feature\"").count();
    println!("{faces} faces, {} bytes as GeoJSON, {CONNECTIONS} connections, {ROUNDS} rounds\n", whole.body.len());
    let questions = questions(&items, service.address);
    let beside = questions.iter().map(|question| beside_trivial(question, &service, folder.path()));
    let beside: Vec<(usize, Load, Load)> = beside.collect();
    // One process at a time has the folder.
    drop(service);
    let service = start("0");
    println!("| question | bytes | us CPU, made anew | again | trivial | ratio | again, req/s | p50 ms | p99 ms |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    for (question, (bytes, again, trivial)) in questions.iter().zip(beside) {
        let anew = question.load(&service).cpu_per_request();
        let (own, other) = (again.cpu_per_request(), trivial.cpu_per_request());
        println!(
            "| {} | {bytes} | {anew:.1} | {own:.1} | {other:.1} | {:.2} | {:.0} | {:.2} | {:.2} |",
            question.name,
            own / other,
            again.per_second(),
            again.quantile(0.5),
            again.quantile(0.99),
        );
    }
}

impl Question {
    fn load(&self, serving: &Serving) -> Load {
        client::load(serving, &self.path, &self.headers, self.times)
    }
}

/// Bytes of the answer, the load of the service and that of the trivial handler.
fn beside_trivial(question: &Question, service: &Serving, folder: &Path) -> (usize, Load, Load) {
    let answer = client::get(service.address, &question.path, &question.headers);
    let trivial = trivial::start(&answer, folder);
    let (mut ours, mut theirs) = (Load::default(), Load::default());
    for _ in 0..ROUNDS {
        ours.add(&question.load(service));
        theirs.add(&question.load(&trivial));
    }
    (answer.body.len(), ours, theirs)
}

fn questions(items: &str, service: std::net::SocketAddr) -> Vec<Question> {
    let page = format!("{items}?limit=100");
    let tag = |answer: &Answer| answer.header("etag").expect("an entity tag").to_owned();
    let known = format!("if-none-match: {}\r\n", tag(&client::get(service, &page, "")));
    let question = |name, path: &str, headers: &str, times| Question {
        name,
        path: path.to_owned(),
        headers: headers.to_owned(),
        times,
    };
    vec![
        question("304", &page, &known, 30_000),
        question("page of 100", &page, "", 20_000),
        question("page of 100, gzip", &page, "accept-encoding: gzip\r\n", 20_000),
        question("whole layer, gzip", &format!("{items}?limit=10000"), "accept-encoding: gzip\r\n", 3_000),
        question("whole layer, zstd", &format!("{items}?limit=10000"), "accept-encoding: zstd\r\n", 3_000),
        question("/health/live", "/health/live", "", 20_000),
    ]
}
