//! The strip below a map: what colours and lines mean, and how long a metre is.

use stillage_core::semantics::{Cogency, SemanticMap};

use super::drawing::{Colour, Drawing, Pixel, Shape, Stroke, Text};
use super::frame::Frame;
use super::mark::Mark;
use super::style::{INK, PAPER, parse_colour, stroke};
use super::typeface;

/// Distances in ems: around and between the items, from line to line, width of a colour or line, from it to its name.
const MARGIN: f64 = 1.2;
const LINE: f64 = 2.0;
const SAMPLE: f64 = 1.8;
const GAP: f64 = 0.5;
/// Height of a colour, ems.
const SWATCH: f64 = 1.1;
/// Thickness of thin lines, ems.
const THIN: f64 = 0.08;
/// Least length of the scale bar, ems.
const BAR: f64 = 5.0;

/// What is explained, in its order.
pub(super) struct Legend {
    items: Vec<Item>,
    /// Pixels of an em.
    em: f64,
}

/// A thing on the map, and its name.
pub(super) struct Item {
    sample: Sample,
    name: String,
}

/// What a thing looks like.
pub(super) enum Sample {
    /// An area of a colour.
    Area(Colour),
    /// A line; its thickness in pixels.
    Line(Stroke),
    /// A mark of a size of 1 em.
    Mark(Mark, Colour),
    /// The scale bar, its length in ems.
    Bar(f64),
}

impl Item {
    pub(super) fn new(sample: Sample, name: impl Into<String>) -> Self {
        Self { sample, name: name.into() }
    }

    fn sample_width(&self) -> f64 {
        match self.sample {
            Sample::Bar(length) => length,
            Sample::Mark(..) => 1.0,
            Sample::Area(_) | Sample::Line(_) => SAMPLE,
        }
    }

    /// Ems with the space behind it.
    fn width(&self) -> f64 {
        self.sample_width() + GAP + typeface::width(&self.name) + MARGIN
    }
}

impl Legend {
    /// The scale bar and what is explained behind it.
    pub(super) fn new(items: impl IntoIterator<Item = Item>, frame: &Frame) -> Self {
        let metres = round_length(BAR * frame.em / frame.per_metre);
        let bar = Item::new(Sample::Bar(metres * frame.per_metre / frame.em), format!("{metres} m"));
        Self { items: std::iter::once(bar).chain(items).collect(), em: frame.em }
    }

    /// The labels of the rule set and the kinds of edges.
    pub(super) fn of_labels(semantic: &SemanticMap, frame: &Frame) -> Self {
        let labels = semantic.rule_set.labels().iter();
        let areas = labels.map(|label| Item::new(Sample::Area(parse_colour(&label.color)), label.name.clone()));
        let lines =
            [(Cogency::Cogent, "obstruction"), (Cogency::StorageAccess, "storage access"), (Cogency::Invalid, "open")];
        let lines = lines.map(|(cogency, name)| Item::new(Sample::Line(stroke(cogency, THIN * frame.em)), name));
        Self::new(areas.chain(lines), frame)
    }

    /// Pixels that the longest item needs.
    fn least_width(&self) -> usize {
        let widest = self.items.iter().map(Item::width).fold(0.0, f64::max);
        ((widest + MARGIN) * self.em).ceil() as usize
    }

    /// The drawing of a map with the strip below it.
    pub(super) fn below<'a>(&self, frame: &Frame, mut shapes: Vec<Shape<'a>>) -> Drawing<'a> {
        let width = frame.size[0].max(self.least_width()).max(1);
        let height = self.draw([width, frame.size[1]], &mut shapes);
        Drawing { width, height: frame.size[1] + height, background: PAPER, shapes }
    }

    /// Draws the strip for a picture of some width below some height; the height of the strip, pixels.
    fn draw(&self, [width, top]: [usize; 2], shapes: &mut Vec<Shape<'_>>) -> usize {
        let most = width as f64 / self.em;
        let (mut left, mut middle) = (MARGIN, MARGIN + LINE / 2.0);
        for item in &self.items {
            if left > MARGIN && left + item.width() > most {
                (left, middle) = (MARGIN, middle + LINE);
            }
            self.draw_item(item, left, |[x, y]| [x * self.em, top as f64 + (middle + y) * self.em], shapes);
            left += item.width();
        }
        ((middle + LINE / 2.0 + MARGIN) * self.em).ceil() as usize
    }

    /// Draws an item; `place` takes ems from the left border and from the middle of the line.
    fn draw_item(&self, item: &Item, left: f64, place: impl Fn(Pixel) -> Pixel, shapes: &mut Vec<Shape<'_>>) {
        let right = left + item.sample_width();
        let rectangle = |inset: f64, height: f64, colour: Colour| {
            let ([x0, x1], y) = ([left + inset, right - inset], height / 2.0 - inset);
            let ring = [[x0, -y], [x1, -y], [x1, y], [x0, y]].map(&place).to_vec();
            Shape::Area { rings: vec![ring], colour, title: String::new() }
        };
        match item.sample {
            Sample::Area(colour) => shapes.extend([rectangle(0.0, SWATCH, INK), rectangle(THIN, SWATCH, colour)]),
            Sample::Line(stroke) => {
                let segments = vec![[[left, 0.0], [right, 0.0]].map(&place)];
                shapes.push(Shape::Lines { segments, stroke });
            }
            Sample::Mark(mark, colour) => {
                shapes.push(mark.shape(place([left + 0.5, 0.0]), self.em, colour, String::new()));
            }
            Sample::Bar(_) => {
                let ends = [left, right].map(|x| [[x, -0.4], [x, 0.4]].map(&place));
                let segments = vec![ends[0], [[left, 0.0], [right, 0.0]].map(&place), ends[1]];
                let stroke = Stroke { colour: INK, opacity: 1.0, thickness: 1.5 * THIN * self.em };
                shapes.push(Shape::Lines { segments, stroke });
            }
        }
        shapes.push(Shape::Text(Text {
            content: item.name.clone(),
            middle: place([right + GAP + typeface::width(&item.name) / 2.0, 0.0]),
            size: self.em,
            turn: 0.0,
            colour: INK,
            halo: None,
        }));
    }
}

/// The least of 1, 2, 5, 10, 20, 50, ... (and 0.5, 0.2, ...) that is not below a length.
fn round_length(least: f64) -> f64 {
    let power = 10_f64.powf(least.log10().floor());
    let digit = [1.0, 2.0, 5.0].into_iter().find(|digit| digit * power >= least).unwrap_or(10.0);
    // Divided by whole tens, a fraction is written without a tail of digits.
    if power < 1.0 { digit / (1.0 / power).round() } else { digit * power }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_bar_has_a_round_length() {
        let lengths = [0.03, 0.6, 1.0, 3.4, 7.0, 130.0].map(round_length);
        assert_eq!(lengths, [0.05, 1.0, 1.0, 5.0, 10.0, 200.0]);
    }
}
