//! The preset `halmstad2017` against the label images that the paper's author published with his code.
//!
//! The program as people have it: `stillage analyze` on files, and `stillage serve` over HTTP. `STILLAGE_BINARY` names
//! another binary than that of the test's own build; an optimized one takes a few minutes.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Cursor};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use image::{Rgb, RgbImage};
use serde_json::{Value, json};

use crate::shared;

/// The author's maps and the numbers of his categories.
const LABELLED: [(&str, usize); 4] = [("F5_04", 2), ("F5_04", 3), ("F5_04", 4), ("E5_06", 2)];
/// Least adjusted Rand index. The first centroids are not his, so a few cells at the borders of categories differ.
const AGREEMENT: f64 = 0.995;
/// His cells are free above grey 210, all others stop beams; he took every map for one of 0.02 m per pixel.
const METADATA: &str =
    "image: map.png\nresolution: 0.02\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.175\nfree_thresh: 0.174\n";
/// How often a job is asked for.
const TICK: Duration = Duration::from_millis(500);

#[test]
#[ignore = "minutes: see .ci/run"]
fn the_authors_categories_come_from_the_command_line() {
    let Some(golden) = shared("maps/golden/categories-2017") else { return };
    for (map, k) in LABELLED {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        std::fs::write(file("map.png"), opaque(&golden, map)).unwrap();
        std::fs::write(file("map.yaml"), METADATA).unwrap();
        std::fs::write(file("options.json"), options(k).to_string()).unwrap();
        let arguments = ["analyze", "map.yaml", "--options", "options.json", "--out", "result"];
        let output = Command::new(binary()).args(arguments).current_dir(folder.path()).output().unwrap();
        assert!(output.status.success(), "{output:?}");
        compare(&golden, map, k, &std::fs::read(file("result/categories.png")).unwrap());
    }
}

#[test]
#[ignore = "minutes: see .ci/run"]
fn the_authors_categories_come_from_the_service() {
    let Some(golden) = shared("maps/golden/categories-2017") else { return };
    let service = Service::start();
    for (map, k) in LABELLED {
        let map_path = service.analysed(&opaque(&golden, map), &options(k));
        compare(&golden, map, k, &service.get(&format!("{map_path}/categories.png")));
    }
}

fn options(k: usize) -> Value {
    json!({"preset": "halmstad2017", "categorization": {"k": k}})
}

/// A map as the author read it: he took the grey levels and left opacity aside, where a pixel that is not opaque would be
/// unknown here.
fn opaque(golden: &Path, map: &str) -> Vec<u8> {
    let mut png = Cursor::new(Vec::new());
    let grey = image::open(golden.join(format!("{map}.png"))).unwrap().into_luma8();
    grey.write_to(&mut png, image::ImageFormat::Png).unwrap();
    png.into_inner()
}

fn binary() -> PathBuf {
    let named = std::env::var_os("STILLAGE_BINARY").map(PathBuf::from);
    // A relative path is meant from the root of the repository, where cargo runs the tests.
    let named = named.map(|path| Path::new(env!("CARGO_MANIFEST_DIR")).join(path));
    named.unwrap_or_else(|| env!("CARGO_BIN_EXE_stillage").into())
}

/// Compares the categories that were found with the author's, over the cells that have one.
fn compare(golden: &Path, map: &str, k: usize, categories: &[u8]) {
    let found = image::load_from_memory(categories).unwrap().into_rgb8();
    let authors = image::open(golden.join(format!("{map}_labels_km{k}.png"))).unwrap().into_rgb8();
    assert_eq!(found.dimensions(), authors.dimensions());
    let pairs: Vec<(&Rgb<u8>, &Rgb<u8>)> = pixels(&found, &authors).filter(|(found, _)| found.0 != [0; 3]).collect();
    let agreement = adjusted_rand_index(&pairs);
    println!("{map}, k = {k}, {} cells: adjusted Rand index {agreement:.4}", pairs.len());
    assert!(agreement >= AGREEMENT, "{map}, k = {k}: {agreement}");
}

fn pixels<'a>(one: &'a RgbImage, other: &'a RgbImage) -> impl Iterator<Item = (&'a Rgb<u8>, &'a Rgb<u8>)> {
    one.pixels().zip(other.pixels())
}

/// Agreement of two labellings, 1 for equal ones and 0 for chance (L. Hubert and P. Arabie 1985).
fn adjusted_rand_index(pairs: &[(&Rgb<u8>, &Rgb<u8>)]) -> f64 {
    let mut table = BTreeMap::<([u8; 3], [u8; 3]), f64>::new();
    let (mut rows, mut columns) = (BTreeMap::new(), BTreeMap::new());
    for (one, other) in pairs {
        *table.entry((one.0, other.0)).or_default() += 1.0;
        *rows.entry(one.0).or_insert(0.0) += 1.0;
        *columns.entry(other.0).or_insert(0.0) += 1.0;
    }
    let choose = |count: &f64| count * (count - 1.0) / 2.0;
    let [index, one, other]: [f64; 3] =
        [table.values().map(choose).sum(), rows.values().map(choose).sum(), columns.values().map(choose).sum()];
    let expected = one * other / choose(&(pairs.len() as f64));
    (index - expected) / (0.5 * (one + other) - expected)
}

/// `stillage serve` on a temporary store and a free port. Killed when dropped.
struct Service {
    process: Child,
    address: String,
    client: ureq::Agent,
    _data: tempfile::TempDir,
}

impl Service {
    fn start() -> Self {
        let data = tempfile::tempdir().unwrap();
        let arguments = ["serve", "--listen", "127.0.0.1:0", "--min-free-mib", "0", "--log", "error", "--data"];
        let mut process =
            Command::new(binary()).args(arguments).arg(data.path()).stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let address = line.trim().strip_prefix("listening on ").unwrap().to_owned();
        let config = ureq::Agent::config_builder().timeout_global(Some(Duration::from_mins(1)));
        Self { process, address, client: config.build().new_agent(), _data: data }
    }

    /// Uploads a map with options and waits for its analysis: the path of the map.
    fn analysed(&self, image: &[u8], options: &Value) -> String {
        const BOUNDARY: &str = "stillage-test-boundary";
        let part = |name: &str, content: &[u8]| {
            let head = format!("--{BOUNDARY}\r\nContent-Disposition: form-data; name=\"{name}\"\r\n\r\n");
            [head.as_bytes(), content, b"\r\n"].concat()
        };
        let end = format!("--{BOUNDARY}--\r\n");
        let parts = [
            part("image", image),
            part("metadata", METADATA.as_bytes()),
            part("options", options.to_string().as_bytes()),
            end.into_bytes(),
        ];
        let request = self.client.post(format!("{}/v1/maps", self.address));
        let request = request.header("content-type", format!("multipart/form-data; boundary={BOUNDARY}"));
        let mut job: Value = request.send(&parts.concat()).unwrap().body_mut().read_json().unwrap();
        let job_path = format!("/v1/jobs/{}", job["jobID"].as_str().unwrap());
        while job["status"] != "successful" {
            assert!(job["status"] == "accepted" || job["status"] == "running", "{job}");
            std::thread::sleep(TICK);
            job = serde_json::from_slice(&self.get(&job_path)).unwrap();
        }
        format!("/v1/maps/{}", job["mapId"].as_str().unwrap())
    }

    fn get(&self, path: &str) -> Vec<u8> {
        self.client.get(format!("{}{path}", self.address)).call().unwrap().body_mut().read_to_vec().unwrap()
    }
}

impl Drop for Service {
    fn drop(&mut self) {
        // A process that ended already is as good.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
