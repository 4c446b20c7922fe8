//! What is drawn of a rack.

use std::f64::consts::FRAC_PI_4;
use std::ops::Range;

use stillage_core::geometry::Point;

use super::plan::Plan;
use super::style::DrawingStyle;
use crate::random::Random;
use crate::shape::Convex;

/// Rows back to back, or one row. Ranges are metres.
#[derive(Debug, Clone)]
pub(super) struct Rack {
    pub(super) x: Range<f64>,
    pub(super) y: Range<f64>,
    pub(super) rows: Vec<Row>,
}

/// Places side by side.
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub(super) y: Range<f64>,
    /// Whether it faces up.
    pub(super) up: bool,
    /// Places between it and its aisle.
    pub(super) layer: usize,
    pub(super) slots: Vec<Slot>,
}

/// Where one place lies along its row, and whether something stands there.
#[derive(Debug, Clone)]
pub(super) struct Slot {
    pub(super) x: Range<f64>,
    pub(super) full: bool,
}

/// How wide everything is drawn, metres.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pen {
    /// Lines.
    line: f64,
    /// Sides of posts and legs, thickness of frames and dashes.
    post: f64,
    /// Between two solid places, and between two frames back to back.
    gap: f64,
    /// Legs from the border of their place.
    inset: f64,
    /// Distance of the lines of a hatching.
    hatching: f64,
    /// Share of a bay without a dash.
    pause: f64,
}

impl Pen {
    /// The widths of a drawing: what its cells can show at least.
    pub(super) fn new(plan: &Plan, random: &mut Random) -> Self {
        let visible = plan.visible();
        let line = random.within(0.02..0.06).max(visible);
        Self {
            line,
            post: random.within(0.06..0.12).max(visible),
            gap: random.within(0.05..0.15).max(visible + 0.5 * plan.resolution),
            inset: random.within(0.02..0.1),
            hatching: random.within(0.3..0.6).max(5.0 * line),
            pause: random.within(0.2..0.4),
        }
    }

    /// What a style shows of a rack.
    pub(super) fn draw(&self, style: DrawingStyle, rack: &Rack) -> Vec<Convex> {
        let full =
            || rack.rows.iter().flat_map(|row| row.slots.iter().filter(|slot| slot.full).map(|slot| (&slot.x, &row.y)));
        match style {
            DrawingStyle::Solid => {
                full().map(|(x, y)| rectangle(&within(x, self.gap / 2.0), &within(y, self.gap / 2.0))).collect()
            }
            DrawingStyle::Racks => vec![rectangle(&rack.x, &rack.y)],
            DrawingStyle::Outlined => full().flat_map(|(x, y)| self.outline(x, y)).collect(),
            DrawingStyle::Lined => rack.rows.iter().flat_map(|row| self.lined(row, &rack.x)).collect(),
            DrawingStyle::Uprights => {
                let posts = |row: &Row| {
                    let at = borders(row);
                    at.flat_map(|x| faces(&row.y, self.post).map(|y| rectangle(&about(x, self.post), &y)))
                        .collect::<Vec<_>>()
                };
                rack.rows.iter().flat_map(posts).collect()
            }
            DrawingStyle::Pods => full().flat_map(|(x, y)| self.legs(x, y)).collect(),
            DrawingStyle::Ticks => {
                // Shorter than the row is deep, so that two rows back to back are seen to be two.
                let ticks = |row: &Row| {
                    let y = within(&row.y, self.gap / 2.0);
                    borders(row).map(|x| rectangle(&about(x, self.post), &y)).collect::<Vec<_>>()
                };
                rack.rows.iter().flat_map(ticks).collect()
            }
            DrawingStyle::Hatched => self.hatched(rack),
            DrawingStyle::Dashed => {
                let dashes = |(x, y): (&Range<f64>, &Range<f64>)| {
                    let dash = within(x, self.pause / 2.0 * (x.end - x.start));
                    faces(y, self.post).map(|y| rectangle(&dash, &y))
                };
                full().flat_map(dashes).collect()
            }
        }
    }

    /// The four sides of a rectangle, inside of it.
    fn outline(&self, x: &Range<f64>, y: &Range<f64>) -> [Convex; 4] {
        let [low, high] = faces(y, self.line);
        let [left, right] = faces(x, self.line);
        [rectangle(x, &low), rectangle(x, &high), rectangle(&left, y), rectangle(&right, y)]
    }

    fn lined(&self, row: &Row, x: &Range<f64>) -> Vec<Convex> {
        let between = borders(row).map(|x| rectangle(&about(x, self.line), &row.y));
        between.chain(faces(&row.y, self.line).map(|y| rectangle(x, &y))).collect()
    }

    fn legs(&self, x: &Range<f64>, y: &Range<f64>) -> Vec<Convex> {
        let [x, y] = [x, y].map(|range| faces(&within(range, self.inset), self.post));
        x.iter().flat_map(|x| y.iter().map(move |y| rectangle(x, y))).collect()
    }

    /// Lines at 45 degrees within an outline.
    fn hatched(&self, rack: &Rack) -> Vec<Convex> {
        let body = rectangle(&rack.x, &rack.y);
        let [width, depth] = [rack.x.end - rack.x.start, rack.y.end - rack.y.start];
        let step = self.hatching * std::f64::consts::SQRT_2;
        let line = |index: usize| {
            let center = Point::new(rack.x.start + index as f64 * step - depth / 2.0, rack.y.start + depth / 2.0);
            Convex::turned_box(center, [2.0 * depth, self.line], FRAC_PI_4).intersection(&body)
        };
        let lines = (0..=((width + depth) / step) as usize).filter_map(line);
        lines.chain(self.outline(&rack.x, &rack.y)).collect()
    }
}

/// The borders of the places of a row, both ends included.
fn borders(row: &Row) -> impl Iterator<Item = f64> {
    row.slots.first().map(|slot| slot.x.start).into_iter().chain(row.slots.iter().map(|slot| slot.x.end))
}

fn rectangle(x: &Range<f64>, y: &Range<f64>) -> Convex {
    Convex::rectangle(x.clone(), y.clone())
}

/// A range of a width about a middle.
fn about(middle: f64, width: f64) -> Range<f64> {
    middle - width / 2.0..middle + width / 2.0
}

/// A range without so much at both ends.
fn within(range: &Range<f64>, by: f64) -> Range<f64> {
    range.start + by..range.end - by
}

/// The first and the last part of a range, of a width.
fn faces(range: &Range<f64>, width: f64) -> [Range<f64>; 2] {
    [range.start..range.start + width, range.end - width..range.end]
}
