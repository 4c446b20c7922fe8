//! Pictures of a map, as PNG bytes: row 0 is the top, as people see maps.
//!
//! - [`image()`]: the cells as `map_saver` draws them (occupied 0, unknown 205, free 254);
//! - [`categories`]: a palette picture, the index of a pixel is its category + 1, 0 for none;
//! - [`regions`]: a palette picture, regions coloured over the dimmed map;
//! - [`semantic_png`] and [`semantic_svg`]: drawn like the paper's Fig. 9, with codes, a legend and a scale bar. Both are
//!   made from one drawing: a list of shapes in pixels;
//! - [`graph_report_png`]: the navigation graph over the map, with what its report finds, drawn likewise.
//!
//! The first three have the size of the map. Deterministic; O(cells).

mod cells;
mod drawing;
mod encoding;
mod frame;
mod graph_report;
mod legend;
mod mark;
mod raster;
mod semantic;
mod style;
mod svg;
mod typeface;

use stillage_core::{Analysis, Occupancy, OccupancyGrid};

pub use graph_report::graph_report_png;
pub use semantic::{semantic_png, semantic_svg};

use cells::Veil;
use encoding::{Palette, encode};
use style::colour;

/// Grey levels of `map_saver`.
const FREE: u8 = 254;
const UNKNOWN: u8 = 205;
const OCCUPIED: u8 = 0;

/// The cells, as `map_saver` draws them.
#[must_use]
pub fn image(grid: &OccupancyGrid) -> Vec<u8> {
    let rows = (0..grid.height()).rev().flat_map(|row| grid.row(row));
    let pixels: Vec<u8> = rows.map(|&cell| grey(cell)).collect();
    encode(grid.width(), grid.height(), png::ColorType::Grayscale, None, &pixels)
}

const fn grey(cell: Occupancy) -> u8 {
    match cell {
        Occupancy::Free => FREE,
        Occupancy::Occupied => OCCUPIED,
        Occupancy::Unknown => UNKNOWN,
    }
}

/// The category of each cell: the palette index is the category + 1, 0 for none.
#[must_use]
pub fn categories(analysis: &Analysis) -> Vec<u8> {
    let categories = analysis.categories.categories.len().min(255);
    let palette = std::iter::once([0; 3]).chain((0..categories).map(colour)).flatten().collect();
    let rows = analysis.categories.cells.chunks(analysis.width.max(1)).rev();
    // `CategoryMap::NONE` is 255: it wraps to 0.
    let pixels: Vec<u8> = rows.flatten().map(|category| category.wrapping_add(1)).collect();
    encode(analysis.width, analysis.height, png::ColorType::Indexed, Some(Palette::opaque(palette)), &pixels)
}

/// The regions, coloured over the dimmed map.
#[must_use]
pub fn regions(analysis: &Analysis, grid: &OccupancyGrid) -> Vec<u8> {
    const SHADES: usize = 3;
    // Three shades of 84 regions and of none fill a palette; further regions share colours.
    const MOST: usize = 84;
    let shades = |region: Option<usize>| {
        [Occupancy::Free, Occupancy::Occupied, Occupancy::Unknown].map(|cell| {
            let below = [grey(cell); 3];
            let veil = region.map_or(Veil { colour: [UNKNOWN; 3], opacity: 160 }, |region| Veil {
                colour: colour(region),
                opacity: 140,
            });
            veil.over(below)
        })
    };
    let regions = analysis.regions.regions.len().min(MOST);
    let palette = std::iter::once(None).chain((0..regions).map(Some)).flat_map(shades).flatten().collect();
    let mut pixels = Vec::with_capacity(grid.cells().len());
    for row in (0..grid.height()).rev() {
        pixels.extend(grid.row(row).iter().enumerate().map(|(column, &cell)| {
            let region =
                analysis.regions.region_of_cell(column, row).map_or(0, |region| usize::from(region) % MOST + 1);
            (region * SHADES + cell as usize) as u8
        }));
    }
    encode(grid.width(), grid.height(), png::ColorType::Indexed, Some(Palette::opaque(palette)), &pixels)
}

#[cfg(test)]
mod tests;
