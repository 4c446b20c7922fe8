//! Real maps for tests; they are not part of the repository.

use std::env;
use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};

use crate::geometry::Point;
use crate::grid::{GridFrame, Occupancy, OccupancyGrid};

/// The path of a file among the maps, or `None` with a printed line where there are no maps.
///
/// # Panics
/// Where there are no maps although `CI` is `true`.
pub(crate) fn find(file: &str) -> Option<PathBuf> {
    find_where(file, Path::is_file)
}

/// The path of a folder among the maps; otherwise as [`find`].
pub(crate) fn find_folder(folder: &str) -> Option<PathBuf> {
    find_where(folder, Path::is_dir)
}

fn find_where(file: &str, is_there: fn(&Path) -> bool) -> Option<PathBuf> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let places = match env::var_os("STILLAGE_SHARED") {
        Some(place) => vec![PathBuf::from(place)],
        None => vec![workspace.join("../shared"), workspace.join("../../shared")],
    };
    let found = places.iter().map(|place| place.join("maps").join(file)).find(|path| is_there(path));
    if found.is_none() {
        assert!(env::var("CI").as_deref() != Ok("true"), "the maps are missing: {file} is in none of {places:?}");
        println!("skipped: {file} is in none of {places:?}");
    }
    found
}

/// A picture as rows of pixels, lowest row first.
pub(crate) struct Picture {
    pub(crate) width: usize,
    pub(crate) height: usize,
    channels: usize,
    pixels: Vec<u8>,
}

impl Picture {
    /// Reads a PNG or PGM file.
    pub(crate) fn read(path: &Path) -> Self {
        if path.extension().is_some_and(|extension| extension == "pgm") { Self::pgm(path) } else { Self::png(path) }
    }

    /// A binary PGM file (`P5`, 8 bits).
    fn pgm(path: &Path) -> Self {
        let bytes = fs::read(path).expect("the file is there");
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
        let pixels = bytes[at..at + width * height].chunks_exact(width).rev().flatten().copied().collect();
        Self { width, height, channels: 1, pixels }
    }

    fn png(path: &Path) -> Self {
        let mut decoder = png::Decoder::new(BufReader::new(File::open(path).expect("the file is there")));
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().expect("the file is a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("the picture fits into memory")];
        let info = reader.next_frame(&mut pixels).expect("the PNG is whole");
        let rows: Vec<&[u8]> = pixels[..info.buffer_size()].chunks_exact(info.line_size).collect();
        let pixels = rows.iter().rev().copied().flatten().copied().collect();
        let channels = info.color_type.samples();
        Self { width: info.width as usize, height: info.height as usize, channels, pixels }
    }

    /// The channels of each pixel.
    pub(crate) fn pixels(&self) -> impl Iterator<Item = &[u8]> {
        self.pixels.chunks_exact(self.channels)
    }

    /// Mean of the colour channels of each pixel, without its alpha.
    pub(crate) fn greys(&self) -> impl Iterator<Item = u8> {
        let colours = if self.channels > 2 { 3 } else { 1 };
        self.pixels().map(move |pixel| {
            let sum: usize = pixel[..colours].iter().map(|&channel| usize::from(channel)).sum();
            (sum / colours) as u8
        })
    }

    /// A grid of cells that are occupied up to one grey level, free from another on, and unknown between.
    pub(crate) fn grid(&self, resolution: f64, occupied_to: u8, free_from: u8) -> OccupancyGrid {
        let cell = |grey| match grey {
            grey if grey <= occupied_to => Occupancy::Occupied,
            grey if grey >= free_from => Occupancy::Free,
            _ => Occupancy::Unknown,
        };
        let frame = GridFrame { resolution, origin: Point::origin(), yaw: 0.0 };
        OccupancyGrid::new(self.width, self.height, frame, self.greys().map(cell).collect())
    }
}
