//! A drawing as pixels.

use tiny_skia::{
    Color, FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, PixmapMut, PremultipliedColorU8, Stroke as PenStroke,
    Transform,
};

use stillage_core::OccupancyGrid;

use super::cells::{self, Veil};
use super::drawing::{Colour, Drawing, HALO, Pixel, Scale, Shape, Stroke, Text};
use super::typeface;

/// Draws the shapes: RGB, top row first.
pub(super) fn pixels(drawing: &Drawing<'_>) -> Vec<u8> {
    let mut pixmap = Pixmap::new(drawing.width as u32, drawing.height as u32)
        .expect("a drawing has at least one pixel and is no larger than its limit");
    let [red, green, blue] = drawing.background;
    pixmap.fill(Color::from_rgba8(red, green, blue, 255));
    for shape in &drawing.shapes {
        draw(&mut pixmap.as_mut(), shape);
    }
    // The background is opaque, so nothing is transparent.
    pixmap.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect()
}

fn draw(pixmap: &mut PixmapMut<'_>, shape: &Shape<'_>) {
    match shape {
        Shape::Area { rings, colour, .. } => {
            if let Some(path) = path(rings, true) {
                let paint = paint(*colour, 1.0, false);
                pixmap.fill_path(&path, &paint, FillRule::EvenOdd, Transform::identity(), None);
            }
        }
        Shape::Cells { grid, scale } => draw_cells(pixmap, grid, *scale),
        Shape::Lines { segments, stroke: Stroke { colour, opacity, thickness } } => {
            if let Some(path) = path(segments, false) {
                let pen = PenStroke { width: *thickness as f32, ..PenStroke::default() };
                pixmap.stroke_path(&path, &paint(*colour, *opacity, true), &pen, Transform::identity(), None);
            }
        }
        Shape::Text(text) => draw_text(pixmap, text),
    }
}

fn draw_text(pixmap: &mut PixmapMut<'_>, text: &Text) {
    let Some(path) = typeface::outlines(&text.content) else { return };
    let [x, y] = text.middle.map(|value| value as f32);
    let size = text.size as f32;
    let place = Transform::from_translate(x, y).pre_rotate(text.turn as f32).pre_scale(size, size);
    if let Some(halo) = text.halo {
        let pen = PenStroke { width: HALO as f32, line_join: LineJoin::Round, ..PenStroke::default() };
        pixmap.stroke_path(&path, &paint(halo, 1.0, true), &pen, place, None);
    }
    pixmap.fill_path(&path, &paint(text.colour, 1.0, true), FillRule::Winding, place, None);
}

fn paint(colour: Colour, opacity: f64, anti_alias: bool) -> Paint<'static> {
    let mut paint = Paint { anti_alias, ..Paint::default() };
    let [red, green, blue] = colour;
    paint.set_color_rgba8(red, green, blue, (opacity * 255.0).round() as u8);
    paint
}

/// Polylines as one path; `None` when there is nothing to draw.
fn path(lines: &[impl AsRef<[Pixel]>], is_closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for line in lines {
        for (index, point) in line.as_ref().iter().enumerate() {
            let [x, y] = point.map(|value| value as f32);
            if index == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
        }
        if is_closed {
            path.close();
        }
    }
    path.finish()
}

/// Lays obstacles and unknown cells over what was drawn.
fn draw_cells(pixmap: &mut PixmapMut<'_>, grid: &OccupancyGrid, scale: Scale) {
    let width = pixmap.width() as usize;
    let repeat = if let Scale::Enlarged(factor) = scale { factor } else { 1 };
    let lines = pixmap.pixels_mut().chunks_mut(width * repeat);
    for (lines, cells) in lines.zip(cells::rows(grid, scale)) {
        for line in lines.chunks_mut(width) {
            for (pixels, &cell) in line.chunks_mut(repeat).zip(&cells) {
                cover(pixels, Veil::of(cell));
            }
        }
    }
}

fn cover(pixels: &mut [PremultipliedColorU8], veil: Veil) {
    if veil.opacity == 0 {
        return;
    }
    for pixel in pixels {
        let [red, green, blue] = veil.over([pixel.red(), pixel.green(), pixel.blue()]);
        *pixel = PremultipliedColorU8::from_rgba(red, green, blue, 255).expect("an opaque colour is its own product");
    }
}
