//! How many layers a deep body has, and where they lie.
//!
//! The side of a body that faces an aisle is a side of places. So its layers are equally deep from there on, with a flue in
//! the middle where they are reached from two sides, and all numbers of layers can be tried. Each is scored by how well
//! places of one shape explain the body. The body is divided into strips across its rows, since goods end at one layer in
//! one storage lane and at another in the next. The shape is what all places of a number of layers have in common, each
//! place of each strip has its own amplitude of it, and what this leaves is noise: a likelihood, less the description
//! length of the places ([`crate::decomposition::likelihood`]). Bodies of one direction hold places of one depth, unless
//! another depth explains one of them much better.
//!
//! Cost: O(cells of the bodies x depths x flues). Limits: layers are straight and equally deep in each body.

use std::ops::Range;

use rayon::prelude::*;

use super::body::Body;
use super::depth::WHOLE_SHARE;
use crate::decomposition::ground::{self, Cell, Patch, RegionFrame};
use crate::decomposition::likelihood::{self, LEAST_NOISE, LOAD_COST, PLACE_COST};
use crate::watch::{Stopped, Watch};

/// Width of a strip, metres: wide enough to show goods, narrow enough to hold parts of few storage lanes.
const STRIP_M: f64 = 0.5;
/// Step of the depths that are tried, metres, and largest difference between depths that count as equal.
const DEPTH_STEP_M: f64 = 0.025;
const ALIKE_M: f64 = 0.04;
/// Most layers: storage lanes are at most twelve places deep from either side, and thicker bodies are halls.
const MOST_LAYERS: usize = 24;
/// Widest flue between layers that are reached from two sides, and its step, metres.
const FLUE_M: f64 = 0.4;
const FLUE_STEP_M: f64 = 0.05;
/// Share of the last layer before a wall that may lie in what stands behind it.
const BEHIND_SHARE: f64 = 0.1;
/// Least share of the energy that goods explain; walls across a body are explained by less.
const LEAST_EXPLAINED: f64 = 0.5;

/// A deep body as strips across its rows.
pub(super) struct Strips {
    /// Content by strip and line, from the low side on.
    content: Vec<Vec<f64>>,
    /// Line of the frame where the strips begin.
    low: usize,
    /// The extents that the layers may fill, lines of the frame.
    extents: Vec<Range<usize>>,
    cell: f64,
    fronts: [bool; 2],
}

/// Layers of one depth, cells.
#[derive(Debug, Clone, PartialEq)]
struct LayerLattice {
    /// The lines that the layers fill.
    extent: Range<usize>,
    depth: f64,
    count: usize,
    flue: f64,
    /// Whether the first layer begins at the high side.
    from_high: bool,
}

impl LayerLattice {
    /// Range of a layer from the side that the lattice begins at.
    fn layer(&self, index: usize) -> [f64; 2] {
        let flue = if index >= self.count.div_ceil(2) { self.flue } else { 0.0 };
        let start = index as f64 * self.depth + flue;
        [start, start + self.depth]
    }

    /// Number of distances from the middle of a place.
    fn bins(&self) -> usize {
        (self.depth.ceil() as usize).max(1)
    }

    /// A line of the extent, counted from the side that the lattice begins at.
    fn line(&self, line: usize) -> usize {
        if self.from_high { self.extent.end - 1 - line } else { self.extent.start + line }
    }

    /// Lines of each layer, each with its distance from the middle of the place; shapes are even.
    fn lines(&self) -> Vec<Vec<(usize, usize)>> {
        let bins = self.bins();
        let of_layer = |layer: usize| {
            let [start, end] = self.layer(layer);
            let middle = f64::midpoint(start, end);
            let lines = start.round() as usize..(end.round() as usize).min(self.extent.len());
            let line = |line: usize| (self.line(line), ((line as f64 + 0.5 - middle).abs() as usize).min(bins - 1));
            lines.map(line).collect()
        };
        (0..self.count).map(of_layer).collect()
    }

    /// The layers as lines from the low side on; each gets its half of the flue.
    fn ranges(&self) -> Vec<Range<usize>> {
        let half = self.flue / 2.0;
        let range = |index: usize| {
            let [mut start, mut end] = self.layer(index);
            if 2 * index + 2 == self.count {
                end += half;
            }
            if 2 * index == self.count {
                start -= half;
            }
            let [start, end] = [start, end].map(|at| (at.round() as usize).min(self.extent.len()));
            if self.from_high {
                self.extent.end - end..self.extent.end - start
            } else {
                self.extent.start + start..self.extent.start + end
            }
        };
        let mut ranges: Vec<_> = (0..self.count).map(range).collect();
        ranges.sort_by_key(|range| range.start);
        ranges
    }
}

impl Strips {
    /// Cuts a body into strips across its rows; its layers fill one of some extents, which may reach out of it.
    pub(super) fn of(frame: &RegionFrame, body: &Body, extents: &[Range<usize>]) -> Self {
        let low = extents.iter().map(|extent| extent.start).min().unwrap_or(0);
        let high = extents.iter().map(|extent| extent.end).max().unwrap_or(low);
        let patch = frame.patch(&body.rect.with(body.axis.other(), low..high), body.axis);
        let count = patch.width.div_ceil(frame.cells_of(STRIP_M).max(1));
        let strip = |index: usize| {
            let columns = patch.width * index / count..patch.width * (index + 1) / count;
            (0..patch.height).map(|line| content(&patch, line, &columns)).collect()
        };
        Self {
            content: (0..count).map(strip).collect(),
            low,
            extents: extents.to_vec(),
            cell: frame.cell,
            fronts: body.fronts,
        }
    }

    /// All ways to fill the extents with layers of a depth within a range, metres.
    fn lattices(&self, range: [f64; 2]) -> Vec<LayerLattice> {
        self.extents.iter().flat_map(|extent| self.lattices_in(extent, range)).collect()
    }

    fn lattices_in(&self, extent: &Range<usize>, range: [f64; 2]) -> Vec<LayerLattice> {
        let lines = extent.len() as f64;
        let mut lattices = Vec::new();
        if lines * self.cell > MOST_LAYERS as f64 * range[1] {
            return lattices;
        }
        let from_high = self.fronts == [false, true];
        let lattice = |depth: f64, count: usize, flue: f64| LayerLattice {
            extent: extent.clone(),
            depth,
            count,
            flue,
            from_high,
        };
        if self.fronts[0] == self.fronts[1] {
            let flues = (0..=(FLUE_M / FLUE_STEP_M).round() as usize).map(|step| step as f64 * FLUE_STEP_M / self.cell);
            for flue in flues {
                let filled = lines - flue;
                let most = (filled * self.cell / range[0]).floor() as usize;
                let least = ((filled * self.cell / range[1]).ceil() as usize).max(1);
                let counts = (least..=most).filter(|count| flue == 0.0 || count % 2 == 0);
                lattices.extend(counts.map(|count| lattice(filled / count as f64, count, flue)));
            }
        } else {
            let steps = ((range[1] - range[0]) / DEPTH_STEP_M).round() as usize;
            let depths = (0..=steps).map(|step| (range[0] + step as f64 * DEPTH_STEP_M) / self.cell);
            for depth in depths.filter(|depth| lines >= WHOLE_SHARE * depth) {
                // The last layer may reach a little into what stands behind it, or be bare floor.
                let most = (lines / depth + BEHIND_SHARE) as usize;
                let counts = most.saturating_sub(1).max(1)..=most.max(1);
                lattices.extend(counts.map(|count| lattice(depth, count, 0.0)));
            }
        }
        lattices
    }

    /// Energy that places of one shape on a lattice explain in each layer.
    fn explained(&self, lattice: &LayerLattice) -> Vec<f64> {
        let layers = lattice.lines();
        let (mut shape, mut sizes) = (vec![0.0; lattice.bins()], vec![0.0_f64; lattice.bins()]);
        for &(line, bin) in layers.iter().flatten() {
            shape[bin] += self.content.iter().map(|strip| strip[line - self.low]).sum::<f64>();
            sizes[bin] += 1.0;
        }
        shape.iter_mut().zip(&sizes).for_each(|(value, size)| *value /= size.max(1.0));
        let of_layer = |lines: &Vec<(usize, usize)>| {
            let square: f64 = lines.iter().map(|&(_, bin)| shape[bin] * shape[bin]).sum();
            let of_strip = |strip: &Vec<f64>| {
                let product: f64 = lines.iter().map(|&(line, bin)| strip[line - self.low] * shape[bin]).sum();
                product * product / square.max(f64::MIN_POSITIVE)
            };
            self.content.iter().map(of_strip).sum()
        };
        layers.iter().map(of_layer).collect()
    }

    /// Every lattice with its score, a logarithm of a likelihood.
    fn scored(&self, range: [f64; 2]) -> Vec<(f64, LayerLattice)> {
        let energy: f64 = self.content.iter().flatten().map(|content| content * content).sum();
        let lattices = self.lattices(range);
        let explained: Vec<Vec<f64>> = lattices.iter().map(|lattice| self.explained(lattice)).collect();
        let most = explained.iter().map(|layers| layers.iter().sum()).fold(0.0, f64::max);
        if most < LEAST_EXPLAINED * energy {
            return Vec::new();
        }
        let cells = self.content.iter().map(Vec::len).sum::<usize>().max(1) as f64;
        let noise = (energy - most).max(LEAST_NOISE * energy).max(f64::MIN_POSITIVE) / cells;
        let weight = likelihood::weight(noise, self.cell);
        let cost = PLACE_COST * self.content.len() as f64;
        let score = |(lattice, layers): (LayerLattice, Vec<f64>)| {
            let score = layers.iter().map(|explained| explained * weight - cost).sum();
            (score, lattice)
        };
        lattices.into_iter().zip(explained).map(score).collect()
    }
}

/// Content of a line of a strip.
fn content(patch: &Patch, line: usize, columns: &Range<usize>) -> f64 {
    let cells = &patch.row(line)[columns.clone()];
    let share =
        |is: fn(Cell) -> bool| cells.iter().filter(|&&cell| is(cell)).count() as f64 / cells.len().max(1) as f64;
    let unknown = share(Cell::is_unknown);
    ground::content(share(Cell::is_occupied), unknown, 1.0 - unknown)
}

/// The layers of bodies, as ranges of lines of the frame, ascending; depths in metres. Empty where nothing fits.
pub(super) fn layers(bodies: &[Strips], range: [f64; 2], watch: &Watch<'_>) -> Result<Vec<Vec<Range<usize>>>, Stopped> {
    let score = |body: &Strips| watch.check().map(|()| ScoredLattices { scored: body.scored(range), cell: body.cell });
    let choices: Vec<ScoredLattices> = bodies.par_iter().map(score).collect::<Result<_, _>>()?;
    let steps = ((range[1] - range[0]) / DEPTH_STEP_M).round() as usize;
    let (mut usual, mut most) = (range[0], f64::NEG_INFINITY);
    for depth in (0..=steps).map(|step| range[0] + step as f64 * DEPTH_STEP_M) {
        watch.check()?;
        let total = choices.iter().filter_map(|choice| choice.at(depth)).map(|(score, _)| score).sum::<f64>();
        if total > most {
            (usual, most) = (depth, total);
        }
    }
    let ranges = |choice: &ScoredLattices| choice.at(usual).map_or_else(Vec::new, |(_, lattice)| lattice.ranges());
    Ok(choices.iter().map(ranges).collect())
}

/// All lattices of a body with their scores.
struct ScoredLattices {
    scored: Vec<(f64, LayerLattice)>,
    cell: f64,
}

impl ScoredLattices {
    /// The best lattice where other bodies have places of a depth, metres; `None` if no lattice explains more than the
    /// description length of its places.
    fn at(&self, depth: f64) -> Option<(f64, &LayerLattice)> {
        let cost = |lattice: &LayerLattice| {
            let is_alike = (lattice.depth * self.cell - depth).abs() <= ALIKE_M;
            if is_alike { 0.0 } else { LOAD_COST }
        };
        let scored = self.scored.iter().map(|(score, lattice)| (score - cost(lattice), lattice));
        scored.filter(|(score, _)| *score > 0.0).reduce(|best, other| if other.0 > best.0 { other } else { best })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strips drawn from left to right, four lines to a character: goods (#), half of them hidden (+), nothing (.).
    fn check(picture: &[&str], fronts: [bool; 2], wanted: &expect_test::Expect) {
        check_extents(picture, fronts, &[0], wanted);
    }

    /// The same with extents from some lines on.
    fn check_extents(picture: &[&str], fronts: [bool; 2], starts: &[usize], wanted: &expect_test::Expect) {
        let content = |symbol| match symbol {
            '#' => 1.0,
            '+' => 0.5,
            _ => 0.0,
        };
        let strip = |row: &&str| row.chars().flat_map(|symbol| [content(symbol); 4]).collect::<Vec<f64>>();
        let content: Vec<Vec<f64>> = picture.iter().map(strip).collect();
        let lines = content[0].len();
        let extents = starts.iter().map(|&start| start..lines).collect();
        let body = Strips { content, low: 0, extents, cell: 0.05, fronts };
        let found = layers(&[body], [0.8, 1.45], &Watch::unwatched()).expect("nobody stops it");
        let found = found[0].iter().map(|layer| format!("{}..{}", layer.start, layer.end));
        wanted.assert_eq(&found.collect::<Vec<_>>().join(" "));
    }

    #[test]
    fn goods_that_end_at_other_layers_in_other_lanes_tell_the_depth() {
        // Three bearers on each place of 1.2 m: between two places the bearers stand closer than within one.
        let pallet = "#.++.#";
        let lane = |free: usize| ".".repeat(6 * free) + &pallet.repeat(5 - free);
        let lanes: Vec<String> = [0, 2, 1, 3, 0, 1].map(lane).into();
        let picture: Vec<&str> = lanes.iter().map(String::as_str).collect();
        check(&picture, [true, false], &expect_test::expect!["0..24 24..48 48..72 72..96 96..120"]);
        check(&picture, [true, true], &expect_test::expect!["0..24 24..48 48..72 72..96 96..120"]);
    }

    #[test]
    fn few_goods_of_an_outer_layer_make_it_one_but_a_thing_in_the_aisle_does_not() {
        let pallet = "#.++.#";
        let lane = |first: &str| first.to_owned() + &pallet.repeat(3);
        let (free, full, thing) = (lane("......"), lane(pallet), lane("...#.."));
        check_extents(
            &[&free, &full, &free, &full, &free],
            [true, false],
            &[24, 0],
            &expect_test::expect!["0..24 24..48 48..72 72..96"],
        );
        check_extents(
            &[&free, &thing, &free, &free, &free],
            [true, false],
            &[24, 0],
            &expect_test::expect!["24..48 48..72 72..96"],
        );
    }

    #[test]
    fn layers_that_are_reached_from_two_sides_may_have_a_flue() {
        let half = "####+#####+#";
        let full = half.to_owned() + "." + half;
        let front = ".".repeat(6) + &full[6..];
        let back = full[..19].to_owned() + &".".repeat(6);
        check(&[&full, &front, &back, &full], [true, true], &expect_test::expect!["0..24 24..50 50..76 76..100"]);
    }

    #[test]
    fn bodies_without_goods_or_as_thick_as_halls() {
        check(&[&".".repeat(30)], [true, true], &expect_test::expect![""]);
        check(&[&"#".repeat(300)], [true, true], &expect_test::expect![""]);
        check(&["#"], [true, true], &expect_test::expect![""]);
    }
}
