//! The semantic map drawn like the paper's Fig. 9: faces in the colour of their label, obstacles dark, edges by
//! cogency, and a legend below.

use stillage_core::annotation::CellFaces;
use stillage_core::arrangement::FaceId;
use stillage_core::geometry::Point;
use stillage_core::semantics::{Cogency, SemanticMap};
use stillage_core::{Analysis, Occupancy, OccupancyGrid};

use super::canvas::{Canvas, Colour, Stroke, mix};
use super::{encode, font};

/// Small maps are enlarged until their longer side has so many pixels.
const SMALLEST_SIDE: usize = 800;
/// Pixels of the longer side per pixel of line thickness.
const SIDE_PER_THICKNESS: usize = 1_200;

const PAPER: Colour = [255, 255, 255];
const INK: Colour = [20, 20, 24];
const UNKNOWN: Colour = [205, 205, 205];
const ACCESS: Colour = [226, 74, 20];

/// Draws the semantic map. `cells` are the faces of the cells of `grid`.
#[must_use]
pub fn semantic(grid: &OccupancyGrid, cells: &CellFaces, analysis: &Analysis, semantic: &SemanticMap) -> Vec<u8> {
    let longer = grid.width().max(grid.height()).max(1);
    let scale = SMALLEST_SIDE.div_ceil(longer);
    let thickness = (longer * scale).div_ceil(SIDE_PER_THICKNESS);
    let legend = Legend::new(semantic, thickness);
    let map_height = grid.height() * scale;
    let width = (grid.width() * scale).max(legend.widest());
    let mut canvas = Canvas::new(width, map_height + legend.height(width), PAPER);
    draw_faces(&mut canvas, grid, cells, semantic, scale);
    let pixels_per_metre = scale as f64 / grid.resolution();
    let pixel = |point: Point| [point.x * pixels_per_metre, map_height as f64 - point.y * pixels_per_metre];
    // What matters most is drawn last.
    for cogency in [Cogency::Invalid, Cogency::Cogent, Cogency::StorageAccess] {
        let stroke = stroke(cogency, thickness);
        for edge in analysis.subdivision.edges().filter(|edge| semantic.cogency[edge.index()] == cogency) {
            let [start, end] = analysis.subdivision.segment(edge);
            canvas.line(pixel(start), pixel(end), stroke);
        }
    }
    legend.draw(&mut canvas, map_height);
    encode(canvas.width, canvas.height, png::ColorType::Rgb, None, &canvas.pixels)
}

const fn stroke(cogency: Cogency, thickness: usize) -> Stroke {
    match cogency {
        Cogency::Cogent => Stroke { colour: INK, opacity: 255, thickness },
        Cogency::StorageAccess => Stroke { colour: ACCESS, opacity: 255, thickness: thickness * 2 },
        Cogency::Invalid => Stroke { colour: INK, opacity: 50, thickness },
    }
}

/// Fills each cell with the colour of its face.
fn draw_faces(canvas: &mut Canvas, grid: &OccupancyGrid, cells: &CellFaces, semantic: &SemanticMap, scale: usize) {
    let colours: Vec<Colour> = semantic.rule_set.labels().iter().map(|label| parse_colour(&label.color)).collect();
    let colour = |face: FaceId, cell: Occupancy| {
        let below = if face == FaceId::OUTER { PAPER } else { colours[usize::from(semantic.labels[face.index()].0)] };
        match cell {
            Occupancy::Free => below,
            Occupancy::Occupied => mix(below, INK, 225),
            Occupancy::Unknown => mix(below, UNKNOWN, 130),
        }
    };
    for row in 0..grid.height() {
        let top = (grid.height() - 1 - row) * scale;
        let line = canvas.row_mut(top);
        let pixels = line.as_chunks_mut::<3>().0.chunks_mut(scale);
        for (column, (pixels, &cell)) in pixels.zip(grid.row(row)).enumerate() {
            pixels.fill(colour(cells.at(column, row), cell));
        }
        let bytes = canvas.width * 3;
        for copy in top + 1..top + scale {
            canvas.pixels.copy_within(top * bytes..(top + 1) * bytes, copy * bytes);
        }
    }
}

/// `#rrggbb`; grey for anything else.
fn parse_colour(text: &str) -> Colour {
    let number = text.strip_prefix('#').filter(|digits| digits.len() == 6);
    let number = number.and_then(|digits| u32::from_str_radix(digits, 16).ok());
    number.map_or(UNKNOWN, |number| [(number >> 16) as u8, (number >> 8) as u8, number as u8])
}

/// The strip below the map: what colours and lines mean.
struct Legend {
    items: Vec<(Sample, String)>,
    /// Pixels of a dot of the letters.
    dot: usize,
    thickness: usize,
}

enum Sample {
    Area(Colour),
    Line(Cogency),
}

impl Legend {
    fn new(semantic: &SemanticMap, thickness: usize) -> Self {
        let labels = semantic.rule_set.labels().iter();
        let areas = labels.map(|label| (Sample::Area(parse_colour(&label.color)), label.name.clone()));
        let lines =
            [(Cogency::Cogent, "obstruction"), (Cogency::StorageAccess, "storage access"), (Cogency::Invalid, "open")];
        let lines = lines.map(|(cogency, name)| (Sample::Line(cogency), name.to_owned()));
        Self { items: areas.chain(lines).collect(), dot: thickness * 2, thickness }
    }

    /// Space around and between items, pixels.
    const fn margin(&self) -> usize {
        font::HEIGHT * self.dot
    }

    const fn line_height(&self) -> usize {
        2 * font::HEIGHT * self.dot
    }

    /// Width of the colour or line before a name.
    const fn sample_width(&self) -> usize {
        2 * font::HEIGHT * self.dot
    }

    /// Width of an item with the space behind it.
    fn width(&self, name: &str) -> usize {
        self.sample_width() + (name.chars().count() + 1) * font::ADVANCE * self.dot + self.margin()
    }

    /// Width that the longest item needs.
    fn widest(&self) -> usize {
        self.items.iter().map(|(_, name)| self.width(name)).max().unwrap_or(0) + self.margin()
    }

    /// Left and top of each item within the strip, and the height of the strip.
    fn layout(&self, width: usize) -> (Vec<[usize; 2]>, usize) {
        let (mut left, mut top) = (self.margin(), self.margin());
        let mut corners = Vec::with_capacity(self.items.len());
        for (_, name) in &self.items {
            if left > self.margin() && left + self.width(name) > width {
                (left, top) = (self.margin(), top + self.line_height());
            }
            corners.push([left, top]);
            left += self.width(name);
        }
        (corners, top + self.line_height())
    }

    fn height(&self, width: usize) -> usize {
        self.layout(width).1
    }

    fn draw(&self, canvas: &mut Canvas, below: usize) {
        let (corners, _) = self.layout(canvas.width);
        let solid = |colour| Stroke { colour, opacity: 255, thickness: self.thickness };
        let height = font::HEIGHT * self.dot;
        for ((sample, name), [left, top]) in self.items.iter().zip(corners) {
            let top = top + below;
            let corner = [left as i64, top as i64];
            let size = [self.sample_width() - self.dot * 2, height];
            match sample {
                Sample::Area(colour) => {
                    canvas.rectangle(corner, size, solid(INK));
                    let inner = [size[0] - 2 * self.thickness, size[1] - 2 * self.thickness];
                    canvas.rectangle(corner.map(|edge| edge + self.thickness as i64), inner, solid(*colour));
                }
                Sample::Line(cogency) => {
                    let middle = top as f64 + height as f64 / 2.0;
                    let ends = [[left as f64, middle], [(left + size[0]) as f64, middle]];
                    canvas.line(ends[0], ends[1], stroke(*cogency, self.thickness));
                }
            }
            let text = [(left + self.sample_width() + self.dot) as i64, top as i64];
            canvas.text(text, name, self.dot, solid(INK));
        }
    }
}
