//! Recursive XY-cut of a region into drivable bands and the bodies between them.
//!
//! Method: G. Nagy and S. Seth, *Hierarchical representation of optically scanned documents* (ICPR 1984), with drivable
//! bands in the place of white space. A rectangle is searched for straight, mostly drivable bands along both directions of
//! the frame. The direction with the larger total of band area, weighted by clearness, is cut. Before that, bands across
//! the bodies that this cut would leave are looked for: a cross aisle is clear in every body, although the aisles hide it
//! in the profile of the whole rectangle. Where there are cross aisles, the rectangle is cut at these first and each part
//! by itself again. So one hall may hold racks of both directions, aisles that end, and rows that are missing in a part.
//!
//! Cost: O(cells x depth of the recursion). Limits: bands are straight and cross their rectangle from side to side.

use std::ops::Range;

use super::ground::{Axis, Cell, LineProfile, Rect, RegionFrame};
use super::parcel::Parcel;
use crate::plot::PlotKind;
use crate::runs::runs_where;
use crate::watch::{Stopped, Watch};

/// Share of a line of cells that must be drivable for an aisle (accuracy study: 0.66 to 0.72). The rest is clutter,
/// drift, and the ends of the line that the square of a vehicle does not reach.
const AISLE_SHARE: f64 = 0.7;
/// Greatest occupied share of a line of an empty aisle: the posts of bare racks, between which a vehicle would fit, take more.
const EMPTY_AISLE_SHARE: f64 = 0.004;
/// The same for a line across all bodies, for a cross aisle (accuracy study).
const CROSS_SHARE: f64 = 0.85;
/// Narrowest band of drivable lines that is an aisle, in widths of a vehicle: the lines beside its racks, which have
/// goods that jut out, are not drivable (1.4 m for trucks of 1.7 m in the accuracy study).
const AISLE_WIDTH: f64 = 0.82;
/// Narrowest cross aisle, metres: wider than two empty places side by side.
const CROSS_WIDTH_M: f64 = 1.9;
/// Narrowest band through a single body, metres: with one body as evidence, wider than a cross aisle.
const THROUGH_WIDTH_M: f64 = 2.6;
/// A body thinner than this is not cut across, metres: it is at most two rows back to back, and passages through rows are
/// found later, from several rows together.
const THIN_M: f64 = 3.6;
/// A body thicker than this may hold rows of the other direction, metres: it is more than two rows back to back.
const DEEP_M: f64 = 7.0;
/// Lines of a rectangle with less ground of the site than this share of the fullest line are ignored.
const GROUND_SHARE: f64 = 0.2;
/// Storage is at least this deep, metres; weight of bands between which everything is thinner.
const LEAST_DEPTH_M: f64 = 0.45;
const LINES_WEIGHT: f64 = 0.1;
/// Bands that score less than this share of the best band of their rectangle are left to the next cut.
const RIVAL_SHARE: f64 = 0.5;
/// Deepest recursion: no site needs more cuts, one within another.
const MOST_CUTS: usize = 24;
/// The border of an aisle moves to a rack face within this distance, metres.
const SNAP_REACH_M: f64 = 0.45;
/// Occupied share of a line below which it is no rack face.
const LEAST_FACE_SHARE: f64 = 0.02;
/// A rack face is a peak at least this high, as a share of the highest one within reach.
const FACE_PEAK_SHARE: f64 = 0.5;
/// A band between rack faces may be this much narrower than the narrowest one, a ratio.
const SNAPPED_WIDTH: [usize; 2] = [4, 5];

/// A region cut into bands and bodies.
pub(crate) struct AisleCut {
    /// Aisles, and cross aisles as open floor.
    pub bands: Vec<Parcel>,
    /// What lies between them.
    pub bodies: Vec<BodyArea>,
}

/// A rectangle of a region between drivable bands.
#[derive(Debug, Clone)]
pub(crate) struct BodyArea {
    pub rect: Rect,
    /// Direction of the aisles beside it; `None` where there are none.
    pub axis: Option<Axis>,
    /// Whether a drivable band bounds it at the low and the high side across `axis`.
    pub fronts: [bool; 2],
}

/// What may stand in an aisle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AisleContent {
    /// Things that a vehicle finds room beside.
    Things,
    /// Nothing: whatever stands in a line is part of a rack.
    Nothing,
    /// No row, for these are known: bands through a single body are aisles as well.
    NoRows,
}

/// Cuts a region.
pub(crate) fn cut(frame: &RegionFrame, content: AisleContent, watch: &Watch<'_>) -> Result<AisleCut, Stopped> {
    let most_occupied = match content {
        AisleContent::Things | AisleContent::NoRows => 1.0,
        AisleContent::Nothing => EMPTY_AISLE_SHARE,
    };
    let mut cut =
        XyCut { frame, watch, most_occupied, content, found: AisleCut { bands: Vec::new(), bodies: Vec::new() } };
    cut.cut(&BodyArea { rect: frame.whole(), axis: None, fronts: [false; 2] }, 0)?;
    Ok(cut.found)
}

struct XyCut<'a> {
    frame: &'a RegionFrame,
    watch: &'a Watch<'a>,
    content: AisleContent,
    /// Greatest occupied share of a line of an aisle.
    most_occupied: f64,
    found: AisleCut,
}

/// A straight band as a range of lines, and its score: its mean length, cells, weighted by [`clearness`].
#[derive(Debug, Clone)]
struct BandCandidate {
    range: Range<usize>,
    score: f64,
}

/// A direction and the bands along it, ascending.
type AxisBands = (Axis, Vec<Range<usize>>);

impl XyCut<'_> {
    fn cut(&mut self, area: &BodyArea, depth: usize) -> Result<(), Stopped> {
        let Some(rect) = self.trimmed(&area.rect)? else { return Ok(()) };
        let area = BodyArea { rect, ..*area };
        let best = if depth < MOST_CUTS { self.best_bands(&area)? } else { None };
        let Some((axis, bands)) = best else {
            self.found.bodies.push(area);
            return Ok(());
        };
        if self.is_through_rows(&area, axis) {
            return self.cut_across(&area, axis.other(), &bands, depth);
        }
        let bodies = between(area.rect.range(axis.other()), &bands);
        let crossings = self.crossings(&area.rect, axis, &bodies)?;
        if crossings.is_empty() {
            self.cut_bodies(&area, axis, &bands, &bodies, depth)
        } else {
            self.cut_across(&area, axis, &crossings, depth)
        }
    }

    /// The direction whose bands have the largest area, weighted by clearness, and the best of these bands; `None` where
    /// there are none.
    fn best_bands(&self, area: &BodyArea) -> Result<Option<AxisBands>, Stopped> {
        let (mut best, mut most) = (None, 0.0);
        for axis in Axis::BOTH {
            let bands = self.bands(area, axis)?;
            let whole: f64 = bands.iter().map(|band| band.score * band.range.len() as f64).sum();
            let score = if self.leaves_lines(&bands) { LINES_WEIGHT * whole } else { whole };
            if score > most {
                (best, most) = (Some((axis, bands)), score);
            }
        }
        Ok(best.map(|(axis, bands)| {
            let least = RIVAL_SHARE * bands.iter().map(|band| band.score).fold(0.0, f64::max);
            (axis, bands.into_iter().filter(|band| band.score >= least).map(|band| band.range).collect())
        }))
    }

    /// Whether all that stands between two bands is thinner than any storage: the frames of racks, seen from their ends.
    fn leaves_lines(&self, bands: &[BandCandidate]) -> bool {
        let mut bodies = bands.windows(2).map(|pair| pair[1].range.start.saturating_sub(pair[0].range.end)).peekable();
        bodies.peek().is_some() && bodies.all(|body| body < self.frame.cells_of(LEAST_DEPTH_M))
    }

    /// Whether a band along `axis` leads through the rows of a body, and is no aisle of rows of the other direction.
    fn is_through_rows(&self, area: &BodyArea, axis: Axis) -> bool {
        area.axis == Some(axis.other())
            && area.fronts != [false; 2]
            && area.rect.range(axis).len() < self.frame.cells_of(DEEP_M)
    }

    /// Cuts along the bands; bodies are cut again.
    fn cut_bodies(
        &mut self,
        area: &BodyArea,
        axis: Axis,
        bands: &[Range<usize>],
        bodies: &[Range<usize>],
        depth: usize,
    ) -> Result<(), Stopped> {
        let across = axis.other();
        let aisle =
            |band: &Range<usize>| Parcel::new(area.rect.with(across, band.clone()), PlotKind::Aisle, Some(axis));
        self.found.bands.extend(bands.iter().map(aisle));
        let whole = area.rect.range(across).clone();
        for body in bodies {
            // A side that this cut does not make keeps its state if it is a side across the same direction.
            let outer = if area.axis == Some(axis) { area.fronts } else { [false; 2] };
            let fronts = [body.start > whole.start || outer[0], body.end < whole.end || outer[1]];
            let rect = area.rect.with(across, body.clone());
            self.cut(&BodyArea { rect, axis: Some(axis), fronts }, depth + 1)?;
        }
        Ok(())
    }

    /// Cuts at the cross aisles, given as ranges along `axis`; the parts are cut again.
    fn cut_across(
        &mut self,
        area: &BodyArea,
        axis: Axis,
        crossings: &[Range<usize>],
        depth: usize,
    ) -> Result<(), Stopped> {
        let cross_aisle = |range: &Range<usize>| {
            Parcel::new(area.rect.with(axis, range.clone()), PlotKind::OpenFloor, Some(axis.other()))
        };
        self.found.bands.extend(crossings.iter().map(cross_aisle));
        for part in between(area.rect.range(axis), crossings) {
            let rect = area.rect.with(axis, part);
            self.cut(&BodyArea { rect, ..*area }, depth + 1)?;
        }
        Ok(())
    }

    /// A rectangle without the lines at its sides that hold no ground of the site; `None` where no line holds any.
    fn trimmed(&self, rect: &Rect) -> Result<Option<Rect>, Stopped> {
        let mut rect = rect.clone();
        for axis in Axis::BOTH {
            self.watch.check()?;
            let ground = self.frame.counts(&rect, axis, Cell::is_inside);
            let has_ground = |&count: &u32| count > 0;
            let Some(first) = ground.iter().position(has_ground) else { return Ok(None) };
            let last = ground.iter().rposition(has_ground).unwrap_or(first);
            let start = rect.range(axis.other()).start;
            rect = rect.with(axis.other(), start + first..start + last + 1);
        }
        Ok(Some(rect))
    }

    /// Mostly drivable bands along an axis, ascending.
    fn bands(&self, area: &BodyArea, axis: Axis) -> Result<Vec<BandCandidate>, Stopped> {
        let rect = &area.rect;
        let thickness = rect.range(axis).len();
        let is_across_body = area.axis == Some(axis.other());
        if is_across_body && thickness < self.frame.cells_of(THIN_M) {
            return Ok(Vec::new());
        }
        let is_guess = is_across_body && self.content != AisleContent::NoRows;
        let least_width =
            self.frame.cells_of(if is_guess { THROUGH_WIDTH_M } else { AISLE_WIDTH * self.frame.vehicle_m });
        let profile = LineProfile::of(self.frame, rect, axis, self.watch)?;
        let fullest = profile.ground.iter().copied().max().unwrap_or(0);
        let share = |line: usize| {
            let enough = f64::from(profile.ground[line]) >= GROUND_SHARE * f64::from(fullest);
            let is_crossed = profile.occupied[line] > self.most_occupied * f64::from(profile.ground[line]);
            if enough && profile.ground[line] > 0 && !is_crossed {
                f64::from(profile.drivable[line]) / f64::from(profile.ground[line])
            } else {
                0.0
            }
        };
        let start = rect.range(axis.other()).start;
        let bands = runs_where(profile.ground.len(), |line| share(line) >= AISLE_SHARE)
            .filter(|run| run.len() >= least_width)
            .map(|run| {
                let mean = run.clone().map(share).sum::<f64>() / run.len() as f64;
                let extent = run.clone().map(|line| f64::from(profile.ground[line])).sum::<f64>() / run.len() as f64;
                let range = self.snapped(&profile, &run, thickness);
                BandCandidate { range: start + range.start..start + range.end, score: extent * clearness(mean) }
            })
            .filter(|band| band.range.len() * SNAPPED_WIDTH[1] >= least_width * SNAPPED_WIDTH[0]);
        Ok(bands.collect())
    }

    /// Moves the borders of a band to the rack faces: the outermost peaks of the occupied cells near them.
    fn snapped(&self, profile: &LineProfile, run: &Range<usize>, length: usize) -> Range<usize> {
        let reach = self.frame.cells_of(SNAP_REACH_M);
        let end = profile.occupied.len();
        let peaks = |window: Range<usize>| -> Option<Range<usize>> {
            let highest = profile.occupied[window.clone()].iter().copied().fold(0.0, f64::max);
            if highest < LEAST_FACE_SHARE * length as f64 {
                return None;
            }
            let is_peak = |&line: &usize| {
                let value = profile.occupied[line];
                let near = &profile.occupied[line.saturating_sub(1)..(line + 2).min(end)];
                value >= FACE_PEAK_SHARE * highest && near.iter().all(|&other| other <= value)
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

    /// Bands across the bodies that are clear in nearly all of them, as ranges along `axis`. The weight of a thick body is
    /// that of two rows back to back, so that a wide hall does not decide over the rows at its end.
    fn crossings(&self, rect: &Rect, axis: Axis, bodies: &[Range<usize>]) -> Result<Vec<Range<usize>>, Stopped> {
        let length = rect.range(axis).len();
        let (mut drivable, mut ground) = (vec![0.0; length], vec![0.0; length]);
        let thin = self.frame.cells_of(THIN_M);
        if bodies.iter().map(ExactSizeIterator::len).sum::<usize>() < thin {
            return Ok(Vec::new());
        }
        for body in bodies {
            let weight = (thin as f64 / body.len() as f64).min(1.0);
            let within = rect.with(axis.other(), body.clone());
            let profile = LineProfile::of(self.frame, &within, axis.other(), self.watch)?;
            for (sum, &value) in drivable.iter_mut().zip(&profile.drivable) {
                *sum += weight * f64::from(value);
            }
            for (sum, &value) in ground.iter_mut().zip(&profile.ground) {
                *sum += weight * f64::from(value);
            }
        }
        let fullest = ground.iter().copied().fold(0.0, f64::max);
        let is_clear = |line: usize| {
            ground[line] > 0.0 && ground[line] >= GROUND_SHARE * fullest && drivable[line] >= CROSS_SHARE * ground[line]
        };
        let start = rect.range(axis).start;
        let width = self.frame.cells_of(CROSS_WIDTH_M);
        Ok(runs_where(length, is_clear)
            .filter(|run| run.len() >= width && run.len() < length)
            .map(|run| start + run.start..start + run.end)
            .collect())
    }
}

/// Weight of a band by its drivable share: 0 for a half, which racks with many empty places reach, and 1 for all of it.
fn clearness(share: f64) -> f64 {
    ((share - 0.5) / 0.5).max(0.0).powi(2)
}

/// The parts of a range between bands, ascending.
fn between(range: &Range<usize>, bands: &[Range<usize>]) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    let mut start = range.start;
    for band in bands {
        parts.push(start..band.start.max(start));
        start = band.end.max(start);
    }
    parts.push(start..range.end.max(start));
    parts.retain(|part| !part.is_empty());
    parts
}
