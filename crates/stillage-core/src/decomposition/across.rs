//! How many layers a deep body has, and where they lie.
//!
//! Both sides of a body between aisles are sides of places, and so is the side of a body before a wall that faces the
//! aisle. So its layers are equally deep from there on, with a flue in the middle where they are reached from two sides,
//! and all numbers of layers can be tried. A number is judged by how well places that are alike explain the body: the
//! body is seen strip by strip, for goods end at one layer in one lane and at another in the next; what all places of a
//! number of layers have in common is their shape, each place of each strip has as much of it as it likes, and what this
//! leaves unexplained is noise: a likelihood, with a price for each place (minimum description length, J. Rissanen 1978,
//! doi 10.1016/0005-1098(78)90005-5). Bodies of one direction hold places of one depth, unless another explains one of
//! them much better.
//!
//! Cost: O(cells of the bodies x depths x flues). Limits: layers are straight and equally deep in each body.

use std::ops::Range;

use super::frame::{Axis, Cell, Frame, Patch, Rect};

/// Width of a strip, metres: goods show in every one, and few lanes lie in it.
const STRIP_M: f64 = 0.5;
/// What an unknown cell counts as content beside an occupied one (accuracy study: goods hide what is in them).
const UNKNOWN_CONTENT: f64 = 0.6;
/// Known share of a line of a strip below which nobody looked at it.
const LEAST_KNOWN: f64 = 0.04;
/// Step of the depths that are tried, metres, and how far depths of one kind are apart.
const DEPTH_STEP_M: f64 = 0.025;
const ALIKE_M: f64 = 0.04;
/// Widest flue between layers that are reached from two sides, and its step, metres.
const FLUE_M: f64 = 0.4;
const FLUE_STEP_M: f64 = 0.05;
/// Share of the last layer before a wall that may lie in what stands behind it.
const BEHIND_SHARE: f64 = 0.1;
/// Length along which the noise of content is the same, metres: goods off their mark.
const CORRELATION_M: f64 = 0.2;
/// Share of the energy that is noise even where goods explain all of it.
const LEAST_NOISE: f64 = 0.15;
/// Price of a place of a strip: how full it is, half a logarithm of its cells.
const PLACE_PRICE: f64 = 1.5;
/// Price of a depth of a body's own: its shape of goods, a dozen values of half a logarithm each.
const DEPTH_PRICE: f64 = 25.0;

/// A deep body as strips across its rows.
pub(super) struct Strips {
    /// Content by strip and line, from the low side on.
    content: Vec<Vec<f64>>,
    lines: usize,
    cell: f64,
    fronts: [bool; 2],
}

/// Layers of one depth, cells.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Lattice {
    depth: f64,
    count: usize,
    flue: f64,
    /// Whether the first layer begins at the high side.
    from_high: bool,
}

impl Lattice {
    /// Range of a layer from the side that the lattice begins at.
    fn layer(&self, index: usize) -> [f64; 2] {
        let flue = if index >= self.count.div_ceil(2) { self.flue } else { 0.0 };
        let start = index as f64 * self.depth + flue;
        [start, start + self.depth]
    }

    /// The layers as lines from the low side on; each gets its half of the flue.
    fn ranges(&self, lines: usize) -> Vec<Range<usize>> {
        let half = self.flue / 2.0;
        let range = |index: usize| {
            let [mut start, mut end] = self.layer(index);
            if 2 * index + 2 == self.count {
                end += half;
            }
            if 2 * index == self.count {
                start -= half;
            }
            let [start, end] = [start, end].map(|at| (at.round() as usize).min(lines));
            if self.from_high { lines - end..lines - start } else { start..end }
        };
        let mut ranges: Vec<_> = (0..self.count).map(range).collect();
        ranges.sort_by_key(|range| range.start);
        ranges
    }
}

impl Strips {
    /// Cuts a rectangle into strips across the rows along `axis`.
    pub(super) fn of(frame: &Frame, rect: &Rect, axis: Axis, fronts: [bool; 2]) -> Self {
        let patch = frame.patch(rect, axis);
        let count = patch.width.div_ceil(frame.cells_of(STRIP_M).max(1));
        let strip = |index: usize| {
            let columns = patch.width * index / count..patch.width * (index + 1) / count;
            (0..patch.height).map(|line| content(&patch, line, &columns)).collect()
        };
        Self { content: (0..count).map(strip).collect(), lines: patch.height, cell: frame.cell, fronts }
    }

    /// All ways to fill the body with layers of a depth within a range, metres.
    fn lattices(&self, range: [f64; 2]) -> Vec<Lattice> {
        let lines = self.lines as f64;
        let mut lattices = Vec::new();
        if self.fronts[0] == self.fronts[1] {
            let flues = (0..=(FLUE_M / FLUE_STEP_M).round() as usize).map(|step| step as f64 * FLUE_STEP_M / self.cell);
            for flue in flues {
                let room = lines - flue;
                let most = (room * self.cell / range[0]).floor() as usize;
                let least = ((room * self.cell / range[1]).ceil() as usize).max(1);
                let counts = (least..=most).filter(|count| flue == 0.0 || count % 2 == 0);
                lattices.extend(counts.map(|count| Lattice {
                    depth: room / count as f64,
                    count,
                    flue,
                    from_high: false,
                }));
            }
        } else {
            let steps = ((range[1] - range[0]) / DEPTH_STEP_M).round() as usize;
            let depths = (0..=steps).map(|step| (range[0] + step as f64 * DEPTH_STEP_M) / self.cell);
            // The last layer may reach a little into what stands behind it, or be bare floor.
            let most = |depth: f64| (lines / depth + BEHIND_SHARE) as usize;
            let counts = |depth: f64| most(depth).saturating_sub(1).max(1)..=most(depth).max(1);
            let of_depth = |depth: f64| {
                counts(depth).map(move |count| Lattice { depth, count, flue: 0.0, from_high: self.fronts[1] })
            };
            lattices.extend(depths.flat_map(of_depth));
        }
        lattices
    }

    /// Energy that alike places on a lattice explain in each layer.
    fn explained(&self, lattice: &Lattice) -> Vec<f64> {
        let bins = lattice.depth.ceil() as usize;
        // Lines of each layer, each with its bin from the middle of the place on: goods are even.
        let lines_of = |layer: usize| {
            let [start, end] = lattice.layer(layer);
            let middle = f64::midpoint(start, end);
            let lines = start.round() as usize..(end.round() as usize).min(self.lines);
            lines.map(move |line| {
                let at = if lattice.from_high { self.lines - 1 - line } else { line };
                (at, ((line as f64 + 0.5 - middle).abs() as usize).min(bins - 1))
            })
        };
        let mut shape = vec![0.0; bins];
        for strip in &self.content {
            for (line, bin) in (0..lattice.count).flat_map(lines_of) {
                shape[bin] += strip[line];
            }
        }
        let mut sizes = vec![0.0_f64; bins];
        (0..lattice.count).flat_map(lines_of).for_each(|(_, bin)| sizes[bin] += 1.0);
        shape.iter_mut().zip(&sizes).for_each(|(value, size)| *value /= size.max(1.0));
        let of_layer = |layer: usize| {
            let square: f64 = lines_of(layer).map(|(_, bin)| shape[bin] * shape[bin]).sum();
            let of_strip = |strip: &Vec<f64>| {
                let product: f64 = lines_of(layer).map(|(line, bin)| strip[line] * shape[bin]).sum();
                product * product / square.max(f64::MIN_POSITIVE)
            };
            self.content.iter().map(of_strip).sum()
        };
        (0..lattice.count).map(of_layer).collect()
    }

    /// Every lattice with its score, a logarithm of a likelihood.
    fn scored(&self, range: [f64; 2]) -> Vec<(f64, Lattice)> {
        let energy: f64 = self.content.iter().flatten().map(|content| content * content).sum();
        let lattices = self.lattices(range);
        let explained: Vec<Vec<f64>> = lattices.iter().map(|lattice| self.explained(lattice)).collect();
        let most = explained.iter().map(|layers| layers.iter().sum()).fold(0.0, f64::max);
        let cells = (self.lines * self.content.len()).max(1) as f64;
        let noise = (energy - most).max(LEAST_NOISE * energy).max(f64::MIN_POSITIVE) / cells;
        let weight = self.cell / (2.0 * CORRELATION_M * noise);
        let price = PLACE_PRICE * self.content.len() as f64;
        let score = |(lattice, layers): (Lattice, Vec<f64>)| {
            let score = layers.iter().map(|explained| explained * weight - price).sum();
            (score, lattice)
        };
        lattices.into_iter().zip(explained).map(score).collect()
    }
}

/// Share of a line of a strip that is occupied or unknown; none where nobody looked.
fn content(patch: &Patch, line: usize, columns: &Range<usize>) -> f64 {
    let cells = &patch.row(line)[columns.clone()];
    let share =
        |is: fn(Cell) -> bool| cells.iter().filter(|&&cell| is(cell)).count() as f64 / cells.len().max(1) as f64;
    let unknown = share(Cell::is_unknown);
    if 1.0 - unknown < LEAST_KNOWN { 0.0 } else { share(Cell::is_occupied) + UNKNOWN_CONTENT * unknown }
}

/// The layers of deep bodies, by body, as lines from their low side on; depths in metres.
pub(super) fn layers(bodies: &[Strips], range: [f64; 2]) -> Vec<Vec<Range<usize>>> {
    let scored: Vec<Vec<(f64, Lattice)>> = bodies.iter().map(|body| body.scored(range)).collect();
    let depth_of = |body: &Strips, lattice: &Lattice| lattice.depth * body.cell;
    let best = |body: usize, is_in: &dyn Fn(f64) -> bool| {
        let of_depth = scored[body].iter().filter(|(_, lattice)| is_in(depth_of(&bodies[body], lattice))).copied();
        of_depth.reduce(|best, other| if other.0 > best.0 { other } else { best })
    };
    let own: Vec<_> = (0..bodies.len()).map(|body| best(body, &|_| true)).collect();
    let near = |usual: f64| move |depth: f64| (depth - usual).abs() <= ALIKE_M;
    let steps = ((range[1] - range[0]) / DEPTH_STEP_M).round() as usize;
    let total = |depth: f64| {
        let of_body = |body: usize| {
            let own = own[body].map_or(0.0, |(score, _)| score - DEPTH_PRICE);
            best(body, &near(depth)).map_or(own, |(score, _)| score.max(own))
        };
        (0..bodies.len()).map(of_body).sum::<f64>()
    };
    let depths = (0..=steps).map(|step| range[0] + step as f64 * DEPTH_STEP_M);
    let usual =
        depths.map(|depth| (total(depth), depth)).reduce(|best, other| if other.0 > best.0 { other } else { best });
    let chosen = |body: usize| {
        let alike = usual.and_then(|(_, depth)| best(body, &near(depth)));
        match (alike, own[body]) {
            (Some(alike), Some(own)) if alike.0 >= own.0 - DEPTH_PRICE => Some(alike.1),
            (_, own) => own.map(|own| own.1),
        }
    };
    (0..bodies.len())
        .map(|body| chosen(body).map_or_else(Vec::new, |lattice| lattice.ranges(bodies[body].lines)))
        .collect()
}
