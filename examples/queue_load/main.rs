//! What the queue of jobs does: uploads a second, the wait of a job, reads while jobs run, two workers beside one, and how soon
//! the job of a worker that died is begun again.
//!
//! `cargo run --release --example queue_load` measures a service on SQLite in temporary folders, every commit synced.
//! `-- postgres://USER:PASSWORD@HOST:PORT` measures processes that share a database, for which it makes databases
//! `queue_load_1` and so on in that server. `STILLAGE_BINARY` names a service other than the one in this program.

#![allow(clippy::print_stdout, clippy::panic, reason = "a program that prints a table, and stops where it cannot")]

mod client;
mod deployment;
#[path = "../service_load/serving.rs"]
#[allow(dead_code, reason = "memory is measured elsewhere")]
mod serving;

use std::process::ExitCode;
use std::time::{Duration, Instant};

use client::{Client, LARGE, SMALL};
use deployment::Deployment;

/// Uploads of a measurement, and how many clients share them.
const UPLOADS: usize = 2_000;
const UPLOADERS: usize = 16;
/// Jobs that come one by one to an idle worker.
const SINGLE_JOBS: usize = 200;
/// Jobs that one or two workers finish.
const SHARED_JOBS: usize = 100;
/// Reads of a measurement, one after the other, and jobs that take longer than those.
const READS: usize = 5_000;
const LONG_JOBS: usize = 10;
/// Maps of a list.
const LISTED: usize = 10;

fn main() -> ExitCode {
    match std::env::args().nth(1).as_deref() {
        // The same program again, as the service.
        Some("serve" | "--version") => return stillage::cli::run(),
        server => measure(server),
    }
    ExitCode::SUCCESS
}

fn measure(server: Option<&str>) {
    println!("| {} | figure |\n| --- | --- |", server.map_or("SQLite", |_| "PostgreSQL"));
    let new = || Deployment::new(server);
    let (per_second, cpu) = uploads(&new());
    println!("| uploads taken, each synced | {per_second:.0} a second, {:.2} CPU ms each |", cpu.as_secs_f64() * 1e3);
    let mut waits = waits(&new());
    let [median, slow] = quantiles(&mut waits);
    println!("| from the upload of a job to its start | p50 {median:.1} ms, p99 {slow:.1} ms |");
    for (cores, arguments) in [("all cores", &[][..]), ("a core of their own", &["--request-cores", "1"])] {
        for (what, mut idle, mut busy) in reads(&new(), arguments) {
            let ([median, slow], [median_busy, slow_busy]) = (quantiles(&mut idle), quantiles(&mut busy));
            println!("| {what} on {cores}, idle | p50 {median:.2} ms, p99 {slow:.2} ms |");
            println!("| {what} on {cores}, while jobs run | p50 {median_busy:.2} ms, p99 {slow_busy:.2} ms |");
        }
    }
    if server.is_some() {
        let [one, two] = [1, 2].map(|workers| shared_jobs(&new(), workers).as_secs_f64());
        println!("| {SHARED_JOBS} jobs by one worker, by two | {one:.2} s, {two:.2} s: {:.2} |", two / one);
        println!("| from the death of a worker until its job begins again | {:.1} s |", rescue(&new()).as_secs_f64());
    }
}

/// Median and 99th percentile, milliseconds.
fn quantiles(times: &mut [Duration]) -> [f64; 2] {
    times.sort_unstable();
    [0.5, 0.99].map(|share| times[((times.len() - 1) as f64 * share) as usize].as_secs_f64() * 1e3)
}

/// How many maps a second are taken, while nobody works on them, and what each costs the service.
fn uploads(deployment: &Deployment) -> (f64, Duration) {
    let service = deployment.start(&["--job-slots", "0"]);
    Client::of(&service).upload(SMALL, 0);
    let (cpu, begun) = (service.cpu(), Instant::now());
    std::thread::scope(|scope| {
        for uploader in 0..UPLOADERS {
            let client = Client::of(&service);
            scope.spawn(move || {
                for index in 0..UPLOADS / UPLOADERS {
                    client.upload(SMALL, 1 + uploader * UPLOADS + index);
                }
            });
        }
    });
    let cpu = service.cpu().saturating_sub(cpu) / UPLOADS as u32;
    (UPLOADS as f64 / begun.elapsed().as_secs_f64(), cpu)
}

/// How long each job waits that comes to an idle worker; in a process of its own where it can be.
fn waits(deployment: &Deployment) -> Vec<Duration> {
    let worker = deployment.is_shared().then(|| deployment.start(&["--role", "worker"]));
    let role = if worker.is_some() { "api" } else { "all" };
    let service = deployment.start(&["--role", role]);
    let client = Client::of(&service);
    let wait = |index| {
        let job = client.upload(SMALL, index);
        client.wait_until_idle();
        client.wait_of(&job)
    };
    let waits = (0..SINGLE_JOBS).map(wait).collect();
    drop(worker);
    waits
}

/// Times of reads without jobs, and with a job all the time on all cores that jobs may use.
fn reads(deployment: &Deployment, arguments: &[&str]) -> [(&'static str, Vec<Duration>, Vec<Duration>); 2] {
    let service = deployment.start(arguments);
    let client = Client::of(&service);
    (0..LISTED).for_each(|index| drop(client.upload(SMALL, index)));
    client.wait_until_idle();
    let list = format!("/v1/maps?limit={LISTED}");
    let maps = client.get(&list);
    let map = format!("/v1/maps/{}", maps["maps"][0]["id"].as_str().expect("one is there"));
    let read = |path: &str| {
        let time = |_| {
            let asked = Instant::now();
            client.get(path);
            asked.elapsed()
        };
        (0..READS).map(time).collect()
    };
    let (idle_map, idle_list) = (read(&map), read(&list));
    (0..LONG_JOBS).for_each(|index| drop(client.upload(LARGE, LISTED + index)));
    let (busy_map, busy_list) = (read(&map), read(&list));
    assert!(client.is_busy(), "the jobs ended before the reads");
    [("reads of a map", idle_map, busy_map), ("lists of ten maps", idle_list, busy_list)]
}

/// How long so many workers take for the jobs, a slot and a thread each.
fn shared_jobs(deployment: &Deployment, workers: usize) -> Duration {
    let service = deployment.start(&["--role", "api"]);
    let client = Client::of(&service);
    (0..SHARED_JOBS).for_each(|index| drop(client.upload(SMALL, index)));
    let begun = Instant::now();
    let start = |_| deployment.start(&["--role", "worker", "--compute-threads", "1"]);
    let workers: Vec<_> = (0..workers).map(start).collect();
    // A look takes time of the cores that the workers need.
    client.wait_until_idle_with(Duration::from_millis(25));
    let took = begun.elapsed();
    drop(workers);
    took
}

/// How long it takes from the death of a worker, with the default lease, until another one has its job.
fn rescue(deployment: &Deployment) -> Duration {
    let service = deployment.start(&["--role", "api"]);
    let client = Client::of(&service);
    let dying = deployment.start(&["--role", "worker"]);
    let job = client.upload(LARGE, 0);
    client.wait_for_attempt(&job, 1);
    drop(dying);
    let begun = Instant::now();
    let _heir = deployment.start(&["--role", "worker"]);
    client.wait_for_attempt(&job, 2);
    begun.elapsed()
}
