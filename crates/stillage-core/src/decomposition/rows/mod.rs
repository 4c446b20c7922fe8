//! From the bodies between aisles to rows, from rows to places.
//!
//! The bodies are cut into rows by the depth of their places ([`super::bodies::layers`]), the rows into places by the comb, with
//! the pitch and the goods that [`row_model`] finds in all rows of one direction together. Where nothing repeats,
//! there is no comb: walls, shelves and furniture are not cut into places. Cost: O(cells x pitches).

mod comb;
pub(crate) mod evidence;
mod load_template;
mod periodicity;
mod pieces;
pub(crate) mod row_model;
mod storage_lanes;

use std::ops::Range;

use crate::decomposition::aisles::{Block, BlockKind};
use crate::decomposition::bodies::depth::{self, Body};
use crate::decomposition::bodies::layers::{self, Layers, Stack};
use crate::decomposition::ground::{Axis, Frame, Patch, Rect};
use crate::decomposition::plot::{Parcel, PlotKind};
use crate::watch::{Stopped, Watch};

use evidence::Evidence;
use periodicity::{Bar, Periodicity};
use row_model::{Reading, Rows};

/// Depths of places that occur, metres: from 0.8 m (Euro pallets along the aisle) to 1.3 m and what drift adds.
pub(crate) const DEPTHS_M: [f64; 2] = [0.8, 1.45];
/// Widths of places that occur, metres.
pub(crate) const PITCHES_M: [f64; 2] = [0.8, 1.6];
/// Cells above this are too coarse for gaps and posts, metres.
const COARSEST_CELL_M: f64 = 0.1;

/// Hints of the user, metres.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hints {
    pub pitch: [f64; 2],
    pub depth: [f64; 2],
}

impl Hints {
    /// Widths that places may have.
    fn widths(&self) -> [f64; 2] {
        [self.pitch[0] - comb::NARROWER_M, self.pitch[1] + comb::WIDER_M]
    }
}

/// One row of places, or several that are reached from one side, one behind the other: their lanes run through.
struct Row {
    /// All layers together.
    rect: Rect,
    axis: Axis,
    layers: Stack,
    /// Share of its length with room for a vehicle on one side, whatever layers of the same stack are in between.
    open: f64,
}

impl Row {
    /// What the cells of each layer say.
    fn evidence(&self, frame: &Frame, hints: &Hints) -> Vec<Evidence> {
        self.patches(frame).map(|layer| Evidence::of(&layer, frame.cell, hints.widths())).collect()
    }

    /// The cells of each layer.
    fn patches(&self, frame: &Frame) -> impl Iterator<Item = Patch> {
        self.layers.iter().map(|layer| frame.patch(&self.rect.with(self.axis.other(), layer.clone()), self.axis))
    }

    /// The next layers, so many of each, as rows of their own.
    fn parted(&self, counts: &[usize]) -> Vec<Self> {
        let mut start = 0;
        let part = |&count: &usize| {
            let layers = self.layers[start..start + count].to_vec();
            start += count;
            Self { rect: self.rect.with(self.axis.other(), spanned(&layers)), layers, ..*self }
        };
        counts.iter().map(part).collect()
    }
}

/// From the first line of some layers to the last.
fn spanned(layers: &[Range<usize>]) -> Range<usize> {
    let start = layers.iter().map(|layer| layer.start).min().unwrap_or(0);
    let end = layers.iter().map(|layer| layer.end).max().unwrap_or(start);
    start..end
}

/// Lays the blocks of a region out.
pub(crate) fn lay_out(
    frame: &Frame,
    blocks: &[Block],
    hints: &Hints,
    watch: &Watch<'_>,
) -> Result<Vec<Parcel>, Stopped> {
    let mut parcels = Vec::new();
    let mut bodies = Vec::new();
    for block in blocks {
        match block.kind {
            BlockKind::Aisle => parcels.push(Parcel::new(block.rect.clone(), PlotKind::Aisle, block.axis)),
            BlockKind::CrossAisle => parcels.push(Parcel::new(block.rect.clone(), PlotKind::OpenFloor, block.axis)),
            BlockKind::Body => bodies.push(Body::of(frame, block)),
        }
    }
    let depth = depth::usual(frame, &bodies, hints.depth);
    let [along, across] = Axis::BOTH.map(|axis| Direction::of(frame, &bodies, axis, depth, hints, watch));
    let mut directions = [along?, across?];
    if !directions.iter().any(|direction| direction.periodicity.is_certain()) {
        for direction in &mut directions {
            direction.ask_each_row(frame, hints);
            watch.check()?;
        }
    }
    let is_storage = directions.iter().any(|direction| direction.periodicity.is_sure());
    for direction in directions {
        parcels = direction.lay_out(frame, parcels, is_storage, hints);
        watch.check()?;
    }
    Ok(parcels)
}

/// The rows of one direction.
struct Direction<'a> {
    axis: Axis,
    bodies: Vec<&'a Body>,
    rows: Vec<Row>,
    evidence: Vec<Evidence>,
    /// What is left beside the rows.
    rests: Vec<Parcel>,
    /// Rows that reach into the aisles before their body.
    reaching: Vec<Rect>,
    /// How all rows are read in common; none where they are too short or their cells too coarse to tell.
    reading: Option<Reading>,
    periodicity: Periodicity,
}

impl<'a> Direction<'a> {
    fn of(
        frame: &Frame,
        bodies: &'a [Body],
        axis: Axis,
        depth: f64,
        hints: &Hints,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let bodies: Vec<&Body> = bodies.iter().filter(|body| body.axis == axis).collect();
        let layers = layers::cut(frame, &bodies, depth, hints.depth, watch)?;
        let Standing { stacks, rests, reaching } = Standing::of(frame, &bodies, layers);
        watch.check()?;
        let (rows, evidence) = in_lanes(frame, stacks, hints);
        watch.check()?;
        let reading = in_common(frame, &evidence, hints).in_common();
        watch.check()?;
        let mut found =
            Self { axis, bodies, rows, evidence, rests, reaching, reading, periodicity: Periodicity::default() };
        if let Some(reading) = &found.reading {
            let pitches = row_model::pitches(hints.pitch);
            found.periodicity = found.excess(frame, hints, |row| reading.best_fit(row, &pitches), Bar::IN_COMMON);
        }
        Ok(found)
    }

    /// Asks each row by itself how surely it repeats itself.
    fn ask_each_row(&mut self, frame: &Frame, hints: &Hints) {
        if self.reading.is_none() {
            return;
        }
        let pitches = row_model::pitches(hints.pitch);
        let fit = |row: &Evidence| {
            let own = Rows { rows: vec![row], pitches: pitches.clone() }.in_common();
            own.map_or((0.0, 0.0), |own| own.fit(row))
        };
        let periodicity = self.excess(frame, hints, fit, Bar::BY_THEMSELVES);
        if periodicity.is_certain() {
            self.periodicity = periodicity;
        }
    }

    fn excess(
        &self,
        frame: &Frame,
        hints: &Hints,
        fit: impl Fn(&Evidence) -> (f64, f64) + Sync,
        bar: Bar,
    ) -> Periodicity {
        let layers = |row: usize| -> Vec<Patch> { self.rows[row].patches(frame).collect() };
        Periodicity::of(&self.evidence, |row| self.rows[row].open, layers, hints.widths(), fit, bar)
    }

    /// Adds the places of the rows, or the bodies as they are: walls and furniture are not read. In a storage it takes less
    /// to be rows of places.
    fn lay_out(self, frame: &Frame, parcels: Vec<Parcel>, is_storage: bool, hints: &Hints) -> Vec<Parcel> {
        let is_read = self.periodicity.is_certain() || is_storage && self.periodicity.is_likely();
        let Some(first) = self.reading.filter(|_| is_read) else {
            let whole = |body: &&Body| Parcel::new(body.rect.clone(), PlotKind::Other, Some(self.axis));
            return parcels.into_iter().chain(self.bodies.iter().map(whole)).collect();
        };
        let readings = in_common(frame, &self.evidence, hints).read(first);
        let mut parcels = self.reaching.iter().fold(parcels, |parcels, row| without(parcels, row, self.axis));
        parcels.extend(self.rests);
        for ((row, evidence), reading) in self.rows.iter().zip(&self.evidence).zip(readings) {
            match reading {
                Some(reading) => {
                    let pieces = pieces::of_comb(&reading.cut(evidence), reading.pitch, frame);
                    parcels.extend(parcels_of(row, pieces));
                }
                None => parcels.push(Parcel::new(row.rect.clone(), PlotKind::Other, Some(row.axis))),
            }
        }
        parcels
    }
}

/// What stands in the bodies of one direction.
#[derive(Default)]
struct Standing {
    stacks: Vec<Row>,
    rests: Vec<Parcel>,
    /// Rows that reach into the aisles before their body.
    reaching: Vec<Rect>,
}

impl Standing {
    fn of(frame: &Frame, bodies: &[&Body], layers: Vec<Layers>) -> Self {
        let mut standing = Self::default();
        for (body, layers) in bodies.iter().zip(layers) {
            let axis = body.axis;
            let across = body.across();
            let part = |range, kind| Parcel::new(body.rect.with(axis.other(), range), kind, Some(axis));
            standing.rests.extend(layers.floors.into_iter().map(|floor| part(floor, PlotKind::Aisle)));
            standing.rests.extend(layers.rests.into_iter().map(|rest| part(rest, PlotKind::Other)));
            for stack in layers.stacks {
                let own = spanned(&stack);
                let rect = body.rect.with(axis.other(), own.clone());
                if own.start < across.start || own.end > across.end {
                    standing.reaching.push(rect.clone());
                }
                let [before, within, after] = in_region(frame, &rect, axis).map(|part| rect.with(axis, part));
                let beside = [before, after].into_iter().filter(|rest| !rest.range(axis).is_empty());
                standing.rests.extend(beside.map(|rest| Parcel::new(rest, PlotKind::Other, Some(axis))));
                if !within.range(axis).is_empty() {
                    let open = depth::front_shares(frame, &within, axis).into_iter().fold(0.0, f64::max);
                    standing.stacks.push(Row { rect: within, axis, layers: stack, open });
                }
            }
        }
        standing
    }
}

/// Parcels without the ground of a row: deep rows may reach into the aisles before them.
fn without(parcels: Vec<Parcel>, row: &Rect, axis: Axis) -> Vec<Parcel> {
    let rest = |parcel: Parcel| {
        let rects = parcel.rect.without(row, axis);
        rects.into_iter().map(move |rect| Parcel { rect, ..parcel.clone() })
    };
    parcels.into_iter().flat_map(rest).collect()
}

/// Rows with what their cells say: the layers of a stack that share their lanes are one.
fn in_lanes(frame: &Frame, stacks: Vec<Row>, hints: &Hints) -> (Vec<Row>, Vec<Evidence>) {
    let evidence: Vec<Vec<Evidence>> = stacks.iter().map(|stack| stack.evidence(frame, hints)).collect();
    let shared = storage_lanes::shared(&evidence, &row_model::pitches(hints.pitch));
    let (mut rows, mut of_rows) = (Vec::new(), Vec::new());
    for ((stack, evidence), counts) in stacks.into_iter().zip(evidence).zip(shared) {
        let mut layers = evidence.into_iter();
        of_rows.extend(counts.iter().map(|&count| Evidence::bundle(layers.by_ref().take(count))));
        rows.extend(stack.parted(&counts));
    }
    (rows, of_rows)
}

/// The parts of a layer before, within and behind its region: a region is bounded by tiles, its blocks are rectangles, and
/// what the next region holds stands in another direction.
fn in_region(frame: &Frame, layer: &Rect, axis: Axis) -> [Range<usize>; 3] {
    let patch = frame.patch(layer, axis);
    let along = layer.range(axis);
    let is_within = |&column: &usize| {
        2 * (0..patch.height).filter(|&row| patch.row(row)[column].is_inside()).count() >= patch.height
    };
    let first = (0..patch.width).find(is_within).unwrap_or(patch.width);
    let end = (first..patch.width).rfind(is_within).map_or(first, |last| last + 1);
    [along.start..along.start + first, along.start + first..along.start + end, along.start + end..along.end]
}

/// Rows that are read together; none where cells are too coarse.
fn in_common<'a>(frame: &Frame, evidence: &'a [Evidence], hints: &Hints) -> Rows<'a> {
    let evidence = if frame.cell > COARSEST_CELL_M { &[] } else { evidence };
    Rows { rows: evidence.iter().collect(), pitches: row_model::pitches(hints.pitch) }
}

/// The pieces of a row as parcels.
fn parcels_of(row: &Row, pieces: Vec<(Range<usize>, PlotKind)>) -> impl Iterator<Item = Parcel> {
    let start = row.rect.range(row.axis).start;
    pieces.into_iter().map(move |(piece, kind)| {
        let rect = row.rect.with(row.axis, start + piece.start..start + piece.end);
        Parcel { layers: row.layers.clone(), ..Parcel::new(rect, kind, Some(row.axis)) }
    })
}
