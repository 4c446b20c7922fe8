//! Analyses a map without the service:
//! `cargo run --release -p stillage-core --example analyze_map -- map.yaml OUT [corrections.json]`.
//!
//! Reads the `map_server` metadata beside its PGM or PNG image, writes `OUT/faces.geojson` and `OUT/edges.geojson`
//! under the default rule set with the suggested labels, and prints the time of every stage. With few beams on few
//! cells, since it is about the decomposition; `stillage analyze` knows every option. A list of corrections is applied to
//! the analysis, and what became of each is printed.

#![allow(clippy::print_stdout, reason = "an example prints what it measured")]

use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;
use std::sync::Mutex;
use std::time::Instant;

use stillage_core::arrangement::{CellFaces, FaceId};
use stillage_core::corrections::{self, Corrected, Correction};
use stillage_core::geometry::Point;
use stillage_core::grid::{GridFrame, Occupancy, OccupancyGrid};
use stillage_core::semantics::{self, Assignment, RuleSet};
use stillage_core::watch::{Observer, Stage, StopFlag};
use stillage_core::{Analysis, AnalysisOptions, Watch, analyze};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path, out, corrections @ ..] = arguments.as_slice() else {
        return Err("usage: analyze_map map.yaml OUT [corrections.json]".into());
    };
    let grid = read(Path::new(path))?;
    let mut options = AnalysisOptions::default();
    options.categorization.stride = 4;
    options.categorization.beams = 90;
    let spec = options.check().map_err(|problems| problems[0].to_string())?;
    let (flag, clock) = (StopFlag::default(), Clock::default());
    let analysis = analyze(&grid, &spec, &Watch::new(&flag, &clock))?;
    let list: Vec<Correction> = match corrections.first() {
        Some(path) => serde_json::from_str(&fs::read_to_string(path)?)?,
        None => Vec::new(),
    };
    let cells = CellFaces::of_grid(&analysis.subdivision, &grid);
    let Corrected { analysis, labels, outcomes, .. } = corrections::apply(&grid, &analysis, &cells, &list);
    outcomes.iter().zip(1..).for_each(|(outcome, number)| println!("correction {number}: {outcome:?}"));
    let rules = RuleSet::default();
    let assignment = semantics::suggest(&analysis, &rules)
        .into_iter()
        .map(|suggestion| (suggestion.category, rules.label(suggestion.label).id.clone()))
        .collect();
    let overrides = labels.into_iter().map(|(face, label)| (face.0, label)).collect();
    let assignment = Assignment { assignment, overrides };
    let semantic = semantics::apply(&analysis, &rules, &assignment).map_err(|problems| problems[0].to_string())?;

    fs::create_dir_all(out)?;
    let label = |face: FaceId| semantic.label(face).id.clone();
    let place = |face: FaceId| semantic.face_places[face.index()];
    fs::write(Path::new(out).join("faces.geojson"), faces(&analysis, label, place))?;
    let cogency = |edge: usize| format!("{:?}", semantic.cogency[edge]);
    fs::write(Path::new(out).join("edges.geojson"), edges(&analysis, cogency))?;
    println!(
        "{} faces, {} lines, {} regions, {} places, {} rooms, {} doors",
        analysis.faces.len() - 1,
        analysis.lines.len(),
        analysis.regions.regions.len(),
        semantic.places.len(),
        semantic.places.iter().filter(|place| place.room.is_some()).count(),
        analysis.rooms.doors.len(),
    );
    for region in &analysis.regions.regions {
        let angles: Vec<String> =
            region.orientations.iter().map(|angle| format!("{:.3}", angle.to_degrees())).collect();
        println!("region with {:.2} of the map: {}", region.share, angles.join(" "));
    }
    Ok(())
}

/// Prints how long each stage took.
#[derive(Default)]
struct Clock(Mutex<Option<Instant>>);

impl Observer for Clock {
    fn progress(&self, stage: Stage, fraction: f64) {
        let Ok(mut start) = self.0.lock() else { return };
        if fraction == 0.0 {
            *start = Some(Instant::now());
        } else if let (true, Some(start)) = (fraction >= 1.0, *start) {
            println!("{:15} {:7.3} s", stage.name(), start.elapsed().as_secs_f64());
        }
    }
}

fn collection(features: &[String]) -> String {
    format!("{{\"type\":\"FeatureCollection\",\"features\":[{}]}}", features.join(",\n"))
}

fn faces(analysis: &Analysis, label: impl Fn(FaceId) -> String, place: impl Fn(FaceId) -> Option<u32>) -> String {
    let text = |point: &Point| {
        let point = analysis.frame.to_map(*point);
        format!("[{:.4},{:.4}]", point.x, point.y)
    };
    let features: Vec<String> = analysis
        .subdivision
        .faces()
        .map(|face| {
            let rings: Vec<String> = analysis
                .subdivision
                .rings(face)
                .iter()
                .map(|ring| format!("[{}]", ring.iter().chain(ring.first()).map(text).collect::<Vec<_>>().join(",")))
                .collect();
            let annotation = &analysis.faces[face.index()];
            let mut properties = String::new();
            if let Some(place) = place(face) {
                let _ = write!(properties, "\"place\":{place},");
            }
            let _ = write!(
                properties,
                "\"id\":{face},\"category\":{},\"label\":\"{}\",\"free\":{:.3},\"occupied\":{:.3},\
                 \"unknown\":{:.3},\"inside\":{:.4},\"kind\":\"{}\",\"long\":{:.2},\"short\":{:.2}",
                annotation.category,
                label(face),
                annotation.free_fraction,
                annotation.occupied_fraction,
                annotation.unknown_fraction,
                annotation.inside_occupied_fraction,
                annotation.kind.map_or(String::new(), |kind| format!("{kind:?}").to_lowercase()),
                annotation.extent[0],
                annotation.extent[1],
            );
            format!(
                "{{\"type\":\"Feature\",\"properties\":{{{properties}}},\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":[{}]}}}}",
                rings.join(",")
            )
        })
        .collect();
    collection(&features)
}

fn edges(analysis: &Analysis, cogency: impl Fn(usize) -> String) -> String {
    let features: Vec<String> = analysis
        .subdivision
        .edges()
        .map(|edge| {
            let [start, end] = analysis.subdivision.segment(edge).map(|point| analysis.frame.to_map(point));
            let [left, right] = analysis.subdivision.sides(edge);
            let kebab = match cogency(edge.index()).as_str() {
                "StorageAccess" => "storage-access".to_owned(),
                other => other.to_lowercase(),
            };
            format!(
                "{{\"type\":\"Feature\",\"properties\":{{\"faceLeft\":{left},\"faceRight\":{right},\"cogency\":\"{kebab}\"}},\
                 \"geometry\":{{\"type\":\"LineString\",\"coordinates\":[[{:.4},{:.4}],[{:.4},{:.4}]]}}}}",
                start.x, start.y, end.x, end.y
            )
        })
        .collect();
    collection(&features)
}

/// Reads a map: `image`, `resolution` and `origin` of the metadata, the usual thresholds.
fn read(metadata: &Path) -> Result<OccupancyGrid, Box<dyn std::error::Error>> {
    let text = fs::read_to_string(metadata)?;
    let entry = |key: &str| {
        let line = text.lines().find_map(|line| line.trim().strip_prefix(key)?.strip_prefix(':'));
        line.map(|value| value.trim().trim_matches(['"', '\'']).to_owned()).ok_or(format!("no entry {key}"))
    };
    let image = metadata.with_file_name(entry("image")?);
    let origin: Vec<f64> = entry("origin")?
        .trim_matches(['[', ']'])
        .split(',')
        .map(|number| number.trim().parse())
        .collect::<Result<_, _>>()?;
    let [x, y, yaw] = origin.as_slice() else { return Err("origin has three numbers".into()) };
    let frame = GridFrame { resolution: entry("resolution")?.parse()?, origin: Point::new(*x, *y), yaw: *yaw };
    let (width, height, greys) = if image.extension().is_some_and(|extension| extension == "pgm") {
        pgm(&fs::read(image)?)?
    } else {
        png(&image)?
    };
    let cell = |grey: &u8| match grey {
        0..90 => Occupancy::Occupied,
        206.. => Occupancy::Free,
        _ => Occupancy::Unknown,
    };
    let cells = greys.chunks_exact(width).rev().flat_map(|row| row.iter().map(cell)).collect();
    Ok(OccupancyGrid::new(width, height, frame, cells))
}

/// Width, height and grey levels, first row on top.
type Greys = (usize, usize, Vec<u8>);

fn pgm(bytes: &[u8]) -> Result<Greys, Box<dyn std::error::Error>> {
    let (mut at, mut numbers) = (2, Vec::new());
    while numbers.len() < 3 {
        let rest = bytes.get(at..).ok_or("the header ends early")?;
        let end = rest.iter().position(u8::is_ascii_whitespace).ok_or("the header ends early")?;
        if rest.first() == Some(&b'#') {
            at += rest.iter().position(|&byte| byte == b'\n').ok_or("a comment that does not end")? + 1;
            continue;
        }
        if end > 0 {
            numbers.push(std::str::from_utf8(&rest[..end])?.parse::<usize>()?);
        }
        at += end + 1;
    }
    Ok((numbers[0], numbers[1], bytes[at..at + numbers[0] * numbers[1]].to_vec()))
}

fn png(path: &Path) -> Result<Greys, Box<dyn std::error::Error>> {
    let mut decoder = png::Decoder::new(BufReader::new(File::open(path)?));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let mut pixels = vec![0; reader.output_buffer_size().ok_or("the picture is too large")?];
    let info = reader.next_frame(&mut pixels)?;
    let greys = pixels[..info.buffer_size()].chunks_exact(info.color_type.samples()).map(|pixel| pixel[0]).collect();
    Ok((info.width as usize, info.height as usize, greys))
}
