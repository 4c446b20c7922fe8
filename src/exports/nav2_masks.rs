//! Costmap filter masks of Nav2: where vehicles must not drive, and where they must drive slowly.
//!
//! Source: Nav2, `nav2_costmap_2d/filters` and `map_io.cpp`, github.com/ros-navigation/navigation2.
//!
//! Method: a picture of the size and place of the map, each cell after the face it lies in. A keepout mask is trinary:
//! black is forbidden, white allowed. What lies outside the decomposed part of the map is forbidden: nobody
//! knows what is there. A speed mask is in mode `scale` with thresholds 0 and 1, so that a
//! grey of `100 - v` percent stands for `v` percent of the greatest speed under the filter's usual base 100 and
//! multiplier -1; white is no limit. Cost: O(cells). Limits: the filters themselves are set up in the parameters of
//! Nav2.

use super::archive::NamedFile;
use super::source::ExportSource;
use super::yaml::number;
use super::zones::Ground;

/// Grey of an occupied cell and of a free one, as `map_saver` of Nav2 writes them.
const BLACK: u8 = 0;
const WHITE: u8 = 254;
/// Thresholds that `map_saver` of Nav2 writes.
const OCCUPIED_THRESHOLD: f64 = 0.65;
const FREE_THRESHOLD: f64 = 0.196;
/// Grey without a speed limit.
const NO_LIMIT: u8 = 255;

/// What a keepout mask leaves open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct KeepoutOptions {
    /// Whether work places, like offices, are forbidden.
    pub work_places: bool,
}

impl Default for KeepoutOptions {
    /// A work place is not drivable: robots stop at its door.
    fn default() -> Self {
        Self { work_places: true }
    }
}

impl KeepoutOptions {
    /// Whether vehicles must keep off ground; `None` is that outside the decomposed part of the map.
    pub(super) fn forbids(self, ground: Option<Ground>) -> bool {
        match ground {
            None | Some(Ground::Blocked) => true,
            Some(Ground::WorkPlace) => self.work_places,
            Some(Ground::Way | Ground::Junction) => false,
        }
    }
}

/// Speeds of a speed mask.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedOptions {
    /// Greatest speed in junctions, percent of the vehicle's greatest, 1 to 100.
    pub junction_percent: u8,
    /// Greatest speed in work places, likewise.
    pub work_place_percent: u8,
}

impl Default for SpeedOptions {
    /// Half where ways meet, a quarter where people work.
    fn default() -> Self {
        Self { junction_percent: 50, work_place_percent: 25 }
    }
}

/// Where vehicles must not drive: picture and metadata.
#[must_use]
pub fn keepout(source: &ExportSource<'_>, options: KeepoutOptions) -> [NamedFile; 2] {
    let grey = |ground: Option<Ground>| if options.forbids(ground) { BLACK } else { WHITE };
    let picture = NamedFile { name: "nav2-keepout.pgm".to_owned(), bytes: picture(source, grey) };
    let metadata = metadata(source, &picture.name, "trinary", [OCCUPIED_THRESHOLD, FREE_THRESHOLD]);
    [picture, NamedFile { name: "nav2-keepout.yaml".to_owned(), bytes: metadata }]
}

/// Where vehicles must drive slowly: picture and metadata.
#[must_use]
pub fn speed(source: &ExportSource<'_>, options: SpeedOptions) -> [NamedFile; 2] {
    let grey = |ground: Option<Ground>| match ground {
        Some(Ground::Junction) => speed_grey(options.junction_percent),
        Some(Ground::WorkPlace) => speed_grey(options.work_place_percent),
        None | Some(Ground::Way | Ground::Blocked) => NO_LIMIT,
    };
    let picture = NamedFile { name: "nav2-speed.pgm".to_owned(), bytes: picture(source, grey) };
    let metadata = metadata(source, &picture.name, "scale", [1.0, 0.0]);
    [picture, NamedFile { name: "nav2-speed.yaml".to_owned(), bytes: metadata }]
}

/// The grey that Nav2 reads as `100 - percent`.
fn speed_grey(percent: u8) -> u8 {
    let darkness = f64::from(100 - percent.clamp(1, 100)) / 100.0;
    (f64::from(NO_LIMIT) * (1.0 - darkness)).round() as u8
}

/// A binary PGM, its first row on top.
fn picture(source: &ExportSource<'_>, grey: impl Fn(Option<Ground>) -> u8) -> Vec<u8> {
    let greys: Vec<u8> = Ground::of_faces(source).into_iter().map(grey).collect();
    let (width, height) = (source.grid.width(), source.grid.height());
    let mut bytes = format!("P5\n{width} {height}\n255\n").into_bytes();
    for row in (0..height).rev() {
        for (face, run) in source.cells.runs(row * width..(row + 1) * width) {
            bytes.extend(std::iter::repeat_n(greys[face.index()], run.len()));
        }
    }
    bytes
}

fn metadata(source: &ExportSource<'_>, image: &str, mode: &str, [occupied, free]: [f64; 2]) -> Vec<u8> {
    let frame = source.grid.frame();
    let [x, y, yaw, resolution] = [frame.origin.x, frame.origin.y, frame.yaw, frame.resolution].map(number);
    let place = format!("resolution: {resolution}\norigin: [{x}, {y}, {yaw}]\n");
    let reading = format!("negate: 0\noccupied_thresh: {}\nfree_thresh: {}\n", number(occupied), number(free));
    format!("image: {image}\nmode: {mode}\n{place}{reading}").into_bytes()
}
