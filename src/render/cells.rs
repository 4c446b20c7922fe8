//! The cells of a grid as they lie over the colours of a drawing: free cells show them, obstacles and unknown cells
//! darken them.

use stillage_core::{Occupancy, OccupancyGrid};

use super::drawing::{Colour, Scale};
use super::encoding::{Palette, encode};

/// A colour over what lies below.
#[derive(Clone, Copy)]
pub(super) struct Veil {
    pub(super) colour: Colour,
    /// 0 leaves what lies below, 255 covers it.
    pub(super) opacity: u8,
}

impl Veil {
    /// The veil of a cell.
    pub(super) const fn of(cell: Occupancy) -> Self {
        match cell {
            Occupancy::Free => Self { colour: [255; 3], opacity: 0 },
            Occupancy::Occupied => Self { colour: [20, 20, 24], opacity: 225 },
            Occupancy::Unknown => Self { colour: [205; 3], opacity: 130 },
        }
    }

    /// What is seen of `below`.
    pub(super) fn over(self, below: Colour) -> Colour {
        let opacity = u32::from(self.opacity);
        std::array::from_fn(|channel| {
            ((u32::from(below[channel]) * (255 - opacity) + u32::from(self.colour[channel]) * opacity + 127) / 255)
                as u8
        })
    }
}

/// The cells by rows from the top, as many to a row as the scale has pixels of cells. Where cells share a pixel, an
/// obstacle hides the rest, so that no wall is lost, and a free cell hides unknown ones.
pub(super) fn rows(grid: &OccupancyGrid, scale: Scale) -> impl Iterator<Item = Vec<Occupancy>> {
    let divisor = if let Scale::Reduced(divisor) = scale { divisor } else { 1 };
    let height = grid.height();
    (0..height.div_ceil(divisor)).map(move |row| {
        let end = height - row * divisor;
        let mut cells = vec![Occupancy::Unknown; grid.width().div_ceil(divisor)];
        for row in end.saturating_sub(divisor)..end {
            for (cell, block) in cells.iter_mut().zip(grid.row(row).chunks(divisor)) {
                *cell = block.iter().copied().chain([*cell]).max_by_key(|&cell| strength(cell)).unwrap_or(*cell);
            }
        }
        cells
    })
}

/// Which of the cells of a pixel is shown: the strongest.
const fn strength(cell: Occupancy) -> u8 {
    match cell {
        Occupancy::Unknown => 0,
        Occupancy::Free => 1,
        Occupancy::Occupied => 2,
    }
}

/// The cells as a PNG that lets what lies below shine through.
pub(super) fn png(grid: &OccupancyGrid, scale: Scale) -> Vec<u8> {
    let veils = [Occupancy::Free, Occupancy::Occupied, Occupancy::Unknown].map(Veil::of);
    let palette = Palette {
        colours: veils.iter().flat_map(|veil| veil.colour).collect(),
        opacities: veils.iter().map(|veil| veil.opacity).collect(),
    };
    let rows: Vec<Vec<Occupancy>> = rows(grid, scale).collect();
    let index = |cell: Occupancy| match cell {
        Occupancy::Free => 0,
        Occupancy::Occupied => 1,
        Occupancy::Unknown => 2,
    };
    let pixels: Vec<u8> = rows.iter().flatten().map(|&cell| index(cell)).collect();
    encode(rows.first().map_or(0, Vec::len), rows.len(), png::ColorType::Indexed, Some(palette), &pixels)
}
