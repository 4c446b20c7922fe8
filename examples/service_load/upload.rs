//! A part of the drawn warehouse, sent to the service as a map server writes maps.

use std::time::Duration;

use serde_json::Value;
use stillage_core::grid::Occupancy;
use ureq::unversioned::multipart::{Form, Part};

use crate::serving::Serving;
use crate::site;

/// Rows of the drawing from its lower edge that hold 9,745 faces, fewer than the most of a page.
pub const PART: usize = 3_400;
/// All its rows: a site of the paper's size.
pub const WHOLE: usize = site::SIZE[1];
/// A pause between two looks at the job.
const PAUSE: Duration = Duration::from_millis(500);

/// Uploads so many rows of the drawing, waits for their analysis, and gives the id of the map.
pub fn analysed_map(service: &Serving, rows: usize) -> String {
    let (image, description) = (pgm(rows), description());
    let image = Part::bytes(&image).file_name("site.pgm");
    let form = Form::new().part("image", image).text("metadata", &description);
    let address = format!("http://{}/v1/maps", service.address);
    let created = ureq::post(&address).send(form).and_then(|mut answer| answer.body_mut().read_json::<Value>());
    let created = created.expect("the map is taken");
    let map = created["mapId"].as_str().expect("the job names its map").to_owned();
    loop {
        let state = ureq::get(format!("{address}/{map}/collections/faces/items?limit=1")).call();
        match state {
            Ok(_) => return map,
            Err(ureq::Error::StatusCode(409)) => std::thread::sleep(PAUSE),
            Err(error) => panic!("the map is not analysed: {error}"),
        }
    }
}

fn description() -> String {
    let rest = "origin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
    format!("image: site.pgm\nresolution: {}\n{rest}", site::RESOLUTION)
}

/// Rows of the drawing as an image, the upper one first.
fn pgm(rows: usize) -> Vec<u8> {
    let columns = site::SIZE[0];
    let grid = site::warehouse([0..columns, 0..rows]);
    let mut bytes = format!("P5\n{columns} {rows}\n255\n").into_bytes();
    let grey = |cell: &Occupancy| match cell {
        Occupancy::Free => 254,
        Occupancy::Occupied => 0,
        Occupancy::Unknown => 205,
    };
    for row in grid.cells().chunks(columns).rev() {
        bytes.extend(row.iter().map(grey));
    }
    bytes
}
