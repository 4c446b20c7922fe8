//! A drawing: shapes in pixels, y down, from which [`png`](super::raster) and [`svg`](super::svg) make the same picture.

use stillage_core::OccupancyGrid;

/// Red, green, blue.
pub(super) type Colour = [u8; 3];

/// A position on the picture, pixels from its upper left corner.
pub(super) type Pixel = [f64; 2];

/// Shapes in the order in which they are drawn.
pub(super) struct Drawing<'a> {
    /// Pixels.
    pub(super) width: usize,
    /// Pixels.
    pub(super) height: usize,
    pub(super) background: Colour,
    pub(super) shapes: Vec<Shape<'a>>,
}

/// One thing on a drawing.
pub(super) enum Shape<'a> {
    /// A filled area without antialiasing, so that neighbours meet without a seam. The rings of its holes run the other
    /// way round.
    Area { rings: Vec<Vec<Pixel>>, colour: Colour, title: String },
    /// The obstacles and the unknown cells of a grid, over what lies below.
    Cells { grid: &'a OccupancyGrid, scale: Scale },
    /// Separate straight lines of one kind.
    Lines { segments: Vec<[Pixel; 2]>, stroke: Stroke },
    /// A line of text. It comes from people: nothing in it is markup.
    Text(Text),
}

/// How a line covers what lies below.
#[derive(Clone, Copy)]
pub(super) struct Stroke {
    pub(super) colour: Colour,
    /// 0 leaves what lies below, 1 covers it.
    pub(super) opacity: f64,
    /// Pixels.
    pub(super) thickness: f64,
}

/// A line of text around its middle.
pub(super) struct Text {
    pub(super) content: String,
    /// Middle of the line of text: half of its width, half of the height of its capitals.
    pub(super) middle: Pixel,
    /// Pixels of an em.
    pub(super) size: f64,
    /// Clockwise on the picture, degrees.
    pub(super) turn: f64,
    pub(super) colour: Colour,
    /// Colour of a rim that keeps the letters apart from what lies below.
    pub(super) halo: Option<Colour>,
}

/// Thickness of a rim, ems on both sides of the outline together.
pub(super) const HALO: f64 = 0.22;

/// Size of a cell on the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scale {
    /// A cell has so many pixels on each side.
    Enlarged(usize),
    /// A pixel stands for so many cells on each side.
    Reduced(usize),
}

impl Scale {
    /// Pixels for so many cells.
    pub(super) const fn pixels(self, cells: usize) -> usize {
        match self {
            Self::Enlarged(factor) => cells * factor,
            Self::Reduced(divisor) => cells.div_ceil(divisor),
        }
    }

    /// Pixels per cell.
    pub(super) fn factor(self) -> f64 {
        match self {
            Self::Enlarged(factor) => factor as f64,
            Self::Reduced(divisor) => 1.0 / divisor as f64,
        }
    }
}
