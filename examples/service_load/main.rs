//! What a request costs the service, beside a trivial axum handler that answers the same bytes, in the same run.
//!
//! `cargo run --release --example service_load` draws a part of a warehouse of the paper's size (9,745 faces), has
//! it analysed by `stillage serve` in a process of its own, and asks the same questions of both processes by turns over
//! loopback. A second service on the same store, without memory for answers, shows what it saves. CPU is user and system
//! time of the whole serving process, which the client does not share. Then it asks what nobody asked before, assigns labels,
//! and tells the memory that the whole warehouse takes.

#![allow(clippy::print_stdout, clippy::panic, reason = "a program that prints a table, and stops where it cannot")]

mod client;
mod question;
mod relabelling;
mod serving;
#[path = "../../crates/stillage-core/examples/paper_scale/site.rs"]
mod site;
mod trivial;
mod upload;

use std::path::Path;
use std::process::ExitCode;

use client::Load;
use question::Question;
use serving::Serving;
use stillage::features::Collection;

/// Connections that ask at once: what the two cores of a small machine can be kept busy with.
const CONNECTIONS: usize = 4;
/// Rounds of each question; service and trivial handler take turns, so that both meet the same neighbours.
const ROUNDS: usize = 3;

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
    let map = upload::analysed_map(&service, upload::PART);
    let items = format!("/v1/maps/{map}/collections/faces/items");
    let whole = client::get(service.address, &format!("{items}?limit=10000"), "");
    let faces = whole.text().matches("\"type\":\"Feature\"").count();
    println!("{faces} faces, {} bytes as GeoJSON, {CONNECTIONS} connections, {ROUNDS} rounds\n", whole.body.len());
    let questions = question::repeated(&items, service.address);
    let beside = questions.iter().map(|question| beside_trivial(question, &service, folder.path()));
    let beside: Vec<(usize, Load, Load)> = beside.collect();
    let fresh: Vec<Question> = question::fresh(&items);
    let made: Vec<(usize, Load, Load)> =
        fresh.iter().map(|question| beside_trivial(question, &service, folder.path())).collect();
    let relabelled = relabelling::times(&service, &map);
    let site = upload::analysed_map(&service, upload::WHOLE);
    // One process at a time has the folder.
    drop(service);
    let service = start("0");
    println!("| asked again | bytes | us CPU, made anew | again | trivial | ratio | again, req/s | p50 ms | p99 ms |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    for (question, (bytes, again, trivial)) in questions.iter().zip(&beside) {
        let anew = question.load(&service).cpu_per_request();
        println!("| {} | {bytes} | {anew:.1} | {}", question.name, compared(again, trivial));
    }
    println!("\n| never asked before | bytes | us CPU | trivial | ratio | req/s | p50 ms | p99 ms |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    for (question, (bytes, own, trivial)) in fresh.iter().zip(&made) {
        println!("| {} | {bytes} | {}", question.name, compared(own, trivial));
    }
    let (median, longest) = (relabelled[relabelled.len() / 2], relabelled[relabelled.len() - 1]);
    println!("\nassignment until faces answer with it: p50 {median:.1} ms, longest {longest:.1} ms");
    drop(service);
    memory(&start("64"), &site);
}

/// CPU of the service and of the trivial handler, and how the service answers, as cells of a table.
fn compared(own: &Load, trivial: &Load) -> String {
    let (cpu, least) = (own.cpu_per_request(), trivial.cpu_per_request());
    let [median, slow] = [0.5, 0.99].map(|share| own.quantile(share));
    let per_second = own.per_second();
    format!("{cpu:.1} | {least:.1} | {:.2} | {per_second:.0} | {median:.2} | {slow:.2} |", cpu / least)
}

/// Tells how much more memory a fresh service takes with a map, and then with all its collections.
fn memory(service: &Serving, map: &str) {
    let before = service.memory();
    let ask = |collection: Collection| {
        let path = format!("/v1/maps/{map}/collections/{}/items?limit=1", collection.id());
        client::get(service.address, &path, "");
    };
    ask(Collection::Faces);
    let with_faces = service.memory() - before;
    Collection::ALL.into_iter().for_each(ask);
    let with_all = service.memory() - before;
    println!("memory of a site of the paper's size: {with_faces:.0} MiB with its faces, {with_all:.0} MiB with all");
}

/// Bytes of the answer, the load of the service and that of the trivial handler.
fn beside_trivial(question: &Question, service: &Serving, folder: &Path) -> (usize, Load, Load) {
    let answer = client::get(service.address, &question.paths[0], &question.headers);
    let trivial = trivial::start(&answer, folder);
    let (mut ours, mut theirs) = (Load::default(), Load::default());
    for _ in 0..ROUNDS {
        ours.add(&question.load(service));
        theirs.add(&question.load(&trivial));
    }
    (answer.body.len(), ours, theirs)
}
