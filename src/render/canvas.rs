//! An RGB picture to draw on: rectangles, lines and words. Nothing is antialiased, so the same drawing is the same
//! bytes everywhere.

use super::font;

/// Red, green, blue.
pub(super) type Colour = [u8; 3];

/// A picture, top row first.
pub(super) struct Canvas {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) pixels: Vec<u8>,
}

/// How a stroke covers what lies below.
#[derive(Clone, Copy)]
pub(super) struct Stroke {
    pub(super) colour: Colour,
    /// 0 leaves what lies below, 255 covers it.
    pub(super) opacity: u8,
    /// Pixels.
    pub(super) thickness: usize,
}

/// `share` (of 255) of one colour over another.
pub(super) fn mix(below: Colour, above: Colour, share: u8) -> Colour {
    let share = u32::from(share);
    std::array::from_fn(|channel| {
        ((u32::from(below[channel]) * (255 - share) + u32::from(above[channel]) * share + 127) / 255) as u8
    })
}

impl Canvas {
    pub(super) fn new(width: usize, height: usize, background: Colour) -> Self {
        Self { width, height, pixels: background.repeat(width * height) }
    }

    /// A row of pixels, three bytes each.
    pub(super) fn row_mut(&mut self, row: usize) -> &mut [u8] {
        &mut self.pixels[row * self.width * 3..(row + 1) * self.width * 3]
    }

    /// Fills a rectangle, as far as it lies on the picture.
    pub(super) fn rectangle(&mut self, [left, top]: [i64; 2], [width, height]: [usize; 2], stroke: Stroke) {
        let clip = |start: i64, length: usize, most: usize| {
            let most = most as i64;
            start.clamp(0, most) as usize..start.saturating_add(length as i64).clamp(0, most) as usize
        };
        let columns = clip(left, width, self.width);
        for row in clip(top, height, self.height) {
            for pixel in self.row_mut(row)[columns.start * 3..columns.end * 3].as_chunks_mut::<3>().0 {
                *pixel = mix(*pixel, stroke.colour, stroke.opacity);
            }
        }
    }

    /// Draws a straight line. One step per pixel along its longer axis, so that faint lines stay even.
    pub(super) fn line(&mut self, start: [f64; 2], end: [f64; 2], stroke: Stroke) {
        let along: [f64; 2] = std::array::from_fn(|axis| end[axis] - start[axis]);
        let steps = along[0].abs().max(along[1].abs()).ceil().max(1.0);
        // The brush: across the line, one pixel along it.
        let brush = if along[0].abs() >= along[1].abs() { [1, stroke.thickness] } else { [stroke.thickness, 1] };
        for step in 0..steps as usize {
            let share = (step as f64 + 0.5) / steps;
            let corner = std::array::from_fn(|axis| {
                let middle = start[axis] + along[axis] * share;
                (middle - (brush[axis] as f64 - 1.0) / 2.0).floor() as i64
            });
            self.rectangle(corner, brush, stroke);
        }
    }

    /// Writes a word with dots of `scale` pixels.
    pub(super) fn text(&mut self, [left, top]: [i64; 2], text: &str, scale: usize, stroke: Stroke) {
        for (index, letter) in text.chars().enumerate() {
            for (row, bits) in font::glyph(letter).into_iter().enumerate() {
                for column in (0..font::WIDTH).filter(|column| bits >> (font::WIDTH - 1 - column) & 1 == 1) {
                    let dot = [index * font::ADVANCE + column, row].map(|dots| (dots * scale) as i64);
                    self.rectangle([left + dot[0], top + dot[1]], [scale; 2], stroke);
                }
            }
        }
    }
}
