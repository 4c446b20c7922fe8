//! Recursive XY-cut of a region into drivable bands and the bodies between them.
//!
//! Method: G. Nagy and S. Seth, *Hierarchical representation of optically scanned documents* (ICPR 1984), with drivable
//! bands in the place of white space. In a rectangle, straight bands that are mostly drivable are looked for along both
//! directions of the frame; the clearest and longest one decides which direction is cut. Cross aisles are bands across
//! all the bodies that this leaves: clear there, though aisles hide them in the profile of the whole. Where there are
//! some, the rectangle is cut there first and each part by itself again, so one hall may hold racks of both directions,
//! aisles that end, and rows that are missing in one block only.
//!
//! Cost: O(cells x depth of the recursion). Limits: bands are straight and cross their rectangle from side to side.

use std::ops::Range;

use super::ground::{Axis, Cell, Frame, Rect};
use crate::watch::{Stopped, Watch};

/// Share of a line of cells that must be drivable for an aisle (accuracy study: 0.66 to 0.72; the rest is clutter,
/// drift and what a vehicle's square misses at the ends).
const AISLE_SHARE: f64 = 0.7;
/// The same of the lines across the bodies for a cross aisle (accuracy study).
const CROSS_SHARE: f64 = 0.85;
/// Narrowest aisle, metres: a narrow-aisle truck needs 1.5.
const AISLE_WIDTH_M: f64 = 1.4;
/// Narrowest band across bodies, metres: two empty places side by side are no cross aisle.
const CROSS_WIDTH_M: f64 = 1.9;
/// Narrowest band through one body, metres.
const GAP_WIDTH_M: f64 = 2.6;
/// A body thinner than this is not cut across by itself: rows decide what is a gap, metres.
const THIN_M: f64 = 3.6;
/// A body thicker than this may hold rows of the other direction, metres: it is more than two rows back to back.
const DEEP_M: f64 = 7.0;
/// Lines of a rectangle with less ground of the site than this share of the fullest are no evidence.
const GROUND_SHARE: f64 = 0.2;
/// Bands this much worse than the best one of a rectangle wait for the next cut.
const RIVAL_SHARE: f64 = 0.5;
/// No site is cut deeper.
const MOST_CUTS: usize = 24;
/// Borders of aisles move to the rack face within this reach, metres.
const SNAP_REACH_M: f64 = 0.45;

/// What a rectangle of a region is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BlockKind {
    /// Drivable, between bodies.
    Aisle,
    /// Drivable, across the ends of bodies.
    CrossAisle,
    /// Whatever is not drivable, or not cut.
    Body,
}

/// A rectangle of a region.
#[derive(Debug, Clone)]
pub(crate) struct Block {
    pub rect: Rect,
    pub kind: BlockKind,
    /// Direction of the band, or of the aisles beside a body; `None` for a body without aisles.
    pub axis: Option<Axis>,
    /// For a body: whether a drivable band bounds it at the low and the high side across `axis`.
    pub fronts: [bool; 2],
}

/// Cuts a region.
pub(crate) fn cut(frame: &Frame, watch: &Watch<'_>) -> Result<Vec<Block>, Stopped> {
    let mut cutter = Cutter { frame, watch, blocks: Vec::new() };
    let whole = Block { rect: frame.whole(), kind: BlockKind::Body, axis: None, fronts: [false; 2] };
    cutter.cut(&whole, 0)?;
    Ok(cutter.blocks)
}

struct Cutter<'a> {
    frame: &'a Frame,
    watch: &'a Watch<'a>,
    blocks: Vec<Block>,
}

/// A straight band and how good it is.
#[derive(Debug, Clone)]
struct Band {
    range: Range<usize>,
    score: f64,
}

impl Cutter<'_> {
    fn cut(&mut self, block: &Block, depth: usize) -> Result<(), Stopped> {
        self.watch.check()?;
        let Some(rect) = self.trimmed(block) else { return Ok(()) };
        let block = Block { rect, ..block.clone() };
        if depth >= MOST_CUTS {
            self.blocks.push(block);
            return Ok(());
        }
        let mut best: Option<(Axis, Vec<Band>, f64)> = None;
        for axis in Axis::BOTH {
            let bands = self.bands(&block, axis);
            let area: f64 = bands.iter().map(|band| band.score * band.range.len() as f64).sum();
            if area > best.as_ref().map_or(0.0, |best| best.2) {
                best = Some((axis, bands, area));
            }
        }
        let Some((axis, mut bands, _)) = best else {
            self.blocks.push(block);
            return Ok(());
        };
        let best = bands.iter().map(|band| band.score).fold(0.0, f64::max);
        bands.retain(|band| band.score >= RIVAL_SHARE * best);
        if self.is_rows_across(&block, axis) {
            let ranges: Vec<Range<usize>> = bands.into_iter().map(|band| band.range).collect();
            return self.cut_across(&block, axis.other(), &ranges, depth);
        }
        let bodies = between(block.rect.range(axis.other()), &bands);
        let crossings = self.crossings(&block.rect, axis, &bodies);
        if crossings.is_empty() {
            self.cut_bodies(&block, axis, &bands, &bodies, depth)
        } else {
            self.cut_across(&block, axis, &crossings, depth)
        }
    }

    /// Whether a band along `axis` is a passage through the rows of a body, and no aisle of rows of the other direction.
    fn is_rows_across(&self, block: &Block, axis: Axis) -> bool {
        block.axis == Some(axis.other())
            && block.fronts != [false; 2]
            && block.rect.range(axis).len() < self.frame.cells_of(DEEP_M)
    }

    /// Cuts along the bands; bodies are cut again.
    fn cut_bodies(
        &mut self,
        block: &Block,
        axis: Axis,
        bands: &[Band],
        bodies: &[Range<usize>],
        depth: usize,
    ) -> Result<(), Stopped> {
        let across = axis.other();
        for band in bands {
            let rect = block.rect.with(across, band.range.clone());
            self.blocks.push(Block { rect, kind: BlockKind::Aisle, axis: Some(axis), fronts: [false; 2] });
        }
        let whole = block.rect.range(across).clone();
        for body in bodies {
            // The sides that this cut does not make are as they were, if they were sides of the same direction.
            let outer = if block.axis == Some(axis) { block.fronts } else { [false; 2] };
            let fronts = [body.start > whole.start || outer[0], body.end < whole.end || outer[1]];
            let rect = block.rect.with(across, body.clone());
            self.cut(&Block { rect, kind: BlockKind::Body, axis: Some(axis), fronts }, depth + 1)?;
        }
        Ok(())
    }

    /// Cuts at the cross aisles; the parts are cut again.
    fn cut_across(
        &mut self,
        block: &Block,
        axis: Axis,
        crossings: &[Range<usize>],
        depth: usize,
    ) -> Result<(), Stopped> {
        let bands: Vec<Band> = crossings.iter().map(|range| Band { range: range.clone(), score: 1.0 }).collect();
        for range in crossings {
            let rect = block.rect.with(axis, range.clone());
            self.blocks.push(Block { rect, kind: BlockKind::CrossAisle, axis: Some(axis.other()), fronts: [false; 2] });
        }
        for part in between(block.rect.range(axis), &bands) {
            let rect = block.rect.with(axis, part);
            self.cut(&Block { rect, ..block.clone() }, depth + 1)?;
        }
        Ok(())
    }

    /// A block without the lines at its sides that hold no ground of the site.
    fn trimmed(&self, block: &Block) -> Option<Rect> {
        let mut rect = block.rect.clone();
        for axis in Axis::BOTH {
            let profile = Profile::of(self.frame, &rect, axis);
            let first = profile.ground.iter().position(|&ground| ground > 0)?;
            let last = profile.ground.iter().rposition(|&ground| ground > 0)?;
            let start = rect.range(axis.other()).start;
            rect = rect.with(axis.other(), start + first..start + last + 1);
        }
        Some(rect)
    }

    /// Mostly drivable bands along an axis, ascending.
    fn bands(&self, block: &Block, axis: Axis) -> Vec<Band> {
        let rect = &block.rect;
        let thickness = rect.range(axis).len();
        let is_across_body = block.axis == Some(axis.other());
        if is_across_body && thickness < self.frame.cells_of(THIN_M) {
            return Vec::new();
        }
        let least_width = self.frame.cells_of(if is_across_body { GAP_WIDTH_M } else { AISLE_WIDTH_M });
        let profile = Profile::of(self.frame, rect, axis);
        let fullest = profile.ground.iter().copied().max().unwrap_or(0);
        let share = |line: usize| {
            let enough = f64::from(profile.ground[line]) >= GROUND_SHARE * f64::from(fullest);
            if enough && profile.ground[line] > 0 {
                f64::from(profile.drivable[line]) / f64::from(profile.ground[line])
            } else {
                0.0
            }
        };
        let start = rect.range(axis.other()).start;
        runs(profile.ground.len(), |line| share(line) >= AISLE_SHARE)
            .filter(|run| run.len() >= least_width)
            .map(|run| {
                let mean = run.clone().map(share).sum::<f64>() / run.len() as f64;
                let extent = run.clone().map(|line| f64::from(profile.ground[line])).sum::<f64>() / run.len() as f64;
                let range = self.snapped(&profile, &run, thickness);
                Band { range: start + range.start..start + range.end, score: extent * clearness(mean) }
            })
            .filter(|band| band.range.len() * 5 >= least_width * 4)
            .collect()
    }

    /// Moves the borders of a band to the rack faces: the outermost peaks of the occupied cells near them.
    fn snapped(&self, profile: &Profile, run: &Range<usize>, length: usize) -> Range<usize> {
        let reach = self.frame.cells_of(SNAP_REACH_M);
        let end = profile.occupied.len();
        let peaks = |window: Range<usize>| -> Option<Range<usize>> {
            let highest = profile.occupied[window.clone()].iter().copied().fold(0.0, f64::max);
            if highest < 0.02 * length as f64 {
                return None;
            }
            let is_peak = |&line: &usize| {
                let value = profile.occupied[line];
                let near = &profile.occupied[line.saturating_sub(1)..(line + 2).min(end)];
                value >= 0.5 * highest && near.iter().all(|&other| other <= value)
            };
            Some(window.clone().find(is_peak)?..window.rev().find(is_peak)?)
        };
        let low = if run.start == 0 {
            None
        } else {
            peaks(run.start.saturating_sub(reach)..(run.start + reach + 1).min(end)).map(|found| found.end + 1)
        };
        let high = if run.end == end {
            None
        } else {
            peaks(run.end.saturating_sub(reach)..(run.end + reach + 1).min(end)).map(|found| found.start)
        };
        let (low, high) = (low.unwrap_or(run.start), high.unwrap_or(run.end));
        if low < high { low..high } else { run.clone() }
    }

    /// Bands across the bodies that are clear in nearly all of them. A thick body has no more say than two rows back to
    /// back, so nothing that is clear in a wide hall runs through the rows at its end.
    fn crossings(&self, rect: &Rect, axis: Axis, bodies: &[Range<usize>]) -> Vec<Range<usize>> {
        let length = rect.range(axis).len();
        let (mut drivable, mut ground) = (vec![0.0; length], vec![0.0; length]);
        let thin = self.frame.cells_of(THIN_M);
        if bodies.iter().map(ExactSizeIterator::len).sum::<usize>() < thin {
            return Vec::new();
        }
        for body in bodies {
            let say = (thin as f64 / body.len() as f64).min(1.0);
            let profile = Profile::of(self.frame, &rect.with(axis.other(), body.clone()), axis.other());
            for (sum, &value) in drivable.iter_mut().zip(&profile.drivable) {
                *sum += say * f64::from(value);
            }
            for (sum, &value) in ground.iter_mut().zip(&profile.ground) {
                *sum += say * f64::from(value);
            }
        }
        let fullest = ground.iter().copied().fold(0.0, f64::max);
        let is_clear = |line: usize| {
            ground[line] > 0.0 && ground[line] >= GROUND_SHARE * fullest && drivable[line] >= CROSS_SHARE * ground[line]
        };
        let start = rect.range(axis).start;
        let width = self.frame.cells_of(CROSS_WIDTH_M);
        runs(length, is_clear)
            .filter(|run| run.len() >= width && run.len() < length)
            .map(|run| start + run.start..start + run.end)
            .collect()
    }
}

/// How much a drivable share stands out from that of racks with many empty places.
fn clearness(share: f64) -> f64 {
    ((share - 0.5) / 0.5).max(0.0).powi(2)
}

/// What lies between bands.
fn between(range: &Range<usize>, bands: &[Band]) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    let mut start = range.start;
    for band in bands {
        parts.push(start..band.range.start.max(start));
        start = band.range.end.max(start);
    }
    parts.push(start..range.end.max(start));
    parts.retain(|part| !part.is_empty());
    parts
}

/// Maximal runs of numbers below `count` for which `is_in` holds.
pub(crate) fn runs(count: usize, is_in: impl Fn(usize) -> bool) -> impl Iterator<Item = Range<usize>> {
    let mut found = Vec::new();
    let mut start = None;
    for number in 0..=count {
        match (number < count && is_in(number), start) {
            (true, None) => start = Some(number),
            (false, Some(from)) => {
                found.push(from..number);
                start = None;
            }
            _ => {}
        }
    }
    found.into_iter()
}

/// Counts along every line of a rectangle.
pub(crate) struct Profile {
    /// Cells of the site.
    pub ground: Vec<u32>,
    /// Drivable ones among them.
    pub drivable: Vec<u32>,
    /// Occupied cells, smoothed over three lines.
    pub occupied: Vec<f64>,
}

impl Profile {
    /// Lines along `axis`.
    pub(crate) fn of(frame: &Frame, rect: &Rect, axis: Axis) -> Self {
        let lines = rect.range(axis.other()).len();
        let ground = frame.counts(rect, axis, Cell::is_inside);
        let drivable = frame.counts(rect, axis, |cell| cell.is_inside() && cell.is_drivable());
        let occupied = frame.counts(rect, axis, |cell| cell.is_inside() && cell.is_occupied());
        let at = |line: Option<usize>| line.and_then(|line| occupied.get(line)).copied().map_or(0.0, f64::from);
        let smooth = |line: usize| (at(line.checked_sub(1)) + 2.0 * at(Some(line)) + at(Some(line + 1))) / 4.0;
        Self { ground, drivable, occupied: (0..lines).map(smooth).collect() }
    }
}
