//! Real maps for tests; they are not part of the repository.

use std::env;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use crate::geometry::Point;
use crate::grid::{GridFrame, Occupancy, OccupancyGrid};

/// The path of a file among the maps, or `None` with a printed line where there are no maps.
///
/// # Panics
/// Where there are no maps although `CI` is `true`.
pub(crate) fn find(file: &str) -> Option<PathBuf> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let places = match env::var_os("STILLAGE_SHARED") {
        Some(place) => vec![PathBuf::from(place)],
        None => vec![workspace.join("../shared"), workspace.join("../../shared")],
    };
    let found = places.iter().map(|place| place.join("maps").join(file)).find(|path| path.is_file());
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
    /// Reads a PNG file.
    pub(crate) fn read(path: &Path) -> Self {
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
