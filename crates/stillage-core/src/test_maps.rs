//! Maps for tests: drawn rack halls, and real maps that lie outside the repository.

use std::fs;
use std::path::{Path, PathBuf};

use crate::geometry::{Point, direction, normal};
use crate::grid::{GridFrame, Occupancy, OccupancyGrid};

/// Thresholds of `map_server` under which grey 205 stays unknown.
const OCCUPIED_FROM: f64 = 0.65;
const FREE_UP_TO: f64 = 0.196;

/// A rectangle of floor with rows of racks, at any angle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hall {
    /// Middle of the floor, metres.
    pub center: [f64; 2],
    /// Length along the racks and width across them, metres.
    pub size: [f64; 2],
    /// Direction of the racks, degrees.
    pub angle_deg: f64,
}

impl Hall {
    /// What the hall has at a point: walls of 0.2 m, racks 1.1 m deep every 4 m, posts in them every 2.7 m.
    fn at(&self, point: Point) -> Option<Occupancy> {
        let angle = self.angle_deg.to_radians();
        let offset = point - Point::from(self.center);
        let (along, across) = (direction(angle).dot(&offset), normal(angle).dot(&offset));
        let [length, width] = self.size.map(|side| side / 2.0);
        if along.abs() > length || across.abs() > width {
            return None;
        }
        let wall = along.abs() > length - 0.2 || across.abs() > width - 0.2;
        let in_rack =
            along.abs() < length - 3.0 && (across + width - 2.0).rem_euclid(4.0) < 1.1 && across < width - 2.0;
        let on_face = {
            let depth = (across + width - 2.0).rem_euclid(4.0);
            !(0.1..=1.0).contains(&depth)
        };
        let post = (along + length).rem_euclid(2.7) < 0.1;
        Some(match (wall, in_rack) {
            (true, _) => Occupancy::Occupied,
            (false, true) if on_face || post => Occupancy::Occupied,
            (false, true) => Occupancy::Unknown,
            (false, false) => Occupancy::Free,
        })
    }
}

/// Draws halls on a grid of `width` x `height` metres; the first hall that has a point decides.
pub(crate) fn draw(halls: &[Hall], [width, height]: [f64; 2], resolution: f64) -> OccupancyGrid {
    let (columns, rows) = ((width / resolution).round() as usize, (height / resolution).round() as usize);
    let frame = GridFrame { resolution, origin: Point::origin(), yaw: 0.0 };
    let cells = (0..rows * columns)
        .map(|index| {
            let (column, row) = (index % columns, index / columns);
            let center = Point::new((column as f64 + 0.5) * resolution, (row as f64 + 0.5) * resolution);
            halls.iter().find_map(|hall| hall.at(center)).unwrap_or(Occupancy::Unknown)
        })
        .collect();
    OccupancyGrid::new(columns, rows, frame, cells)
}

/// A real map by the name of its folder; `None`, with a line in the output, where the maps are not at hand.
///
/// # Panics
/// Where the maps are missing on a build server (`CI=true`), and where a map cannot be read.
pub(crate) fn real(name: &str, resolution: f64) -> Option<OccupancyGrid> {
    let Some(folder) = shared_folder() else {
        assert!(std::env::var("CI").as_deref() != Ok("true"), "the shared maps are missing: set STILLAGE_SHARED");
        println!("skipped: {name} is not at hand (set STILLAGE_SHARED)");
        return None;
    };
    let folder = folder.join("maps/dev").join(name);
    let (width, height, greys) = if folder.join("map.png").exists() {
        read_png(&folder.join("map.png"))
    } else {
        read_pgm(&folder.join("map.pgm"))
    };
    let occupancy = |grey: u8| match 1.0 - f64::from(grey) / 255.0 {
        darkness if darkness >= OCCUPIED_FROM => Occupancy::Occupied,
        darkness if darkness <= FREE_UP_TO => Occupancy::Free,
        _ => Occupancy::Unknown,
    };
    let cells = greys.chunks_exact(width).rev().flatten().map(|&grey| occupancy(grey)).collect();
    let frame = GridFrame { resolution, origin: Point::origin(), yaw: 0.0 };
    Some(OccupancyGrid::new(width, height, frame, cells))
}

fn shared_folder() -> Option<PathBuf> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let beside = [workspace.join("../shared"), workspace.join("../../shared")];
    std::env::var_os("STILLAGE_SHARED").map(PathBuf::from).into_iter().chain(beside).find(|folder| folder.is_dir())
}

/// Width, height and grey levels of a PNG picture of 8 bits per channel.
fn read_png(path: &Path) -> (usize, usize, Vec<u8>) {
    let file = std::io::BufReader::new(fs::File::open(path).expect("a map that can be opened"));
    let mut decoder = png::Decoder::new(file);
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().expect("a PNG picture");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a picture that fits the memory")];
    let info = reader.next_frame(&mut bytes).expect("a whole PNG picture");
    let (samples, colors) = (info.color_type.samples(), info.color_type.samples().min(3));
    let colors = if samples == 2 { 1 } else { colors };
    let grey = |pixel: &[u8]| (pixel[..colors].iter().map(|&value| usize::from(value)).sum::<usize>() / colors) as u8;
    let greys = bytes[..info.buffer_size()].chunks_exact(samples).map(grey).collect();
    (info.width as usize, info.height as usize, greys)
}

/// Width, height and grey levels of a binary PGM picture (`P5`, 8 bits).
fn read_pgm(path: &Path) -> (usize, usize, Vec<u8>) {
    let bytes = fs::read(path).expect("a map that can be opened");
    let mut at = 0;
    let mut word = || {
        loop {
            let end = at + bytes[at..].iter().position(u8::is_ascii_whitespace).expect("a PGM header");
            let word = std::str::from_utf8(&bytes[at..end]).expect("a PGM header in ASCII");
            at = end + 1;
            if word.starts_with('#') {
                at = end + bytes[end..].iter().position(|&byte| byte == b'\n').expect("a comment that ends") + 1;
            } else if !word.is_empty() {
                return word;
            }
        }
    };
    assert_eq!(word(), "P5");
    let [width, height, _] = [(); 3].map(|()| word().parse::<usize>().expect("a number in the PGM header"));
    (width, height, bytes[at..at + width * height].to_vec())
}
