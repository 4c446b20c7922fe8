//! How deep the places of a body are, and which of its sides goods are taken from.
//!
//! A side is a front where vehicles find room along most of it. A body between two fronts is one row, or two back to back
//! with a flue, for every place of a rack must be reached; what is thicker is for [`super::layers`]. The depth of the
//! places is the one that explains the thinner bodies of a region best.
//!
//! Cost: O(cells of the bodies). Limits: where goods hide what is behind them, the usual depth of a pallet decides.

use std::ops::Range;

use crate::decomposition::aisles::Block;
use crate::decomposition::ground::{Axis, Cell, Frame, Rect};

/// The depth that a place has when nothing else is known, metres (a 1.2 m pallet), and what a metre of deviation costs.
const USUAL_DEPTH_M: f64 = 1.15;
const DEPTH_PRIOR: f64 = 0.03;
const DEPTH_STEP_M: f64 = 0.025;
/// Flues that need no excuse, metres; what a metre more costs, and a metre less than none.
const FLUE_M: [f64; 2] = [0.0, 0.25];
const WIDE_FLUE_COST: f64 = 0.3;
const MISSING_DEPTH_COST: f64 = 1.0;
/// Widest flue, metres: building columns stand in it.
const WIDEST_FLUE_M: f64 = 0.7;
/// A body thinner than this share of the depth holds no row.
pub(crate) const THIN_SHARE: f64 = 0.6;
/// The same before a wall, which with its pilasters and what lies behind it is some thickness itself.
pub(crate) const WHOLE_SHARE: f64 = 0.85;
/// A body must be so long to have a say about the depth, metres.
const LEAST_LENGTH_M: f64 = 2.0;
/// Where vehicles must find room before a front, from the border on, metres: borders may lie inside the goods.
const FRONT_STRIP_M: [f64; 2] = [0.25, 0.7];
/// Share of a side along which they must.
const FRONT_SHARE: f64 = 0.5;
/// The direction of the aisles holds unless the other one has so many times more front.
const TURN_FACTOR: f64 = 1.5;
/// The same where only one of both has a wall behind: what stands before a wall is reached from the side across it.
const WALL_FACTOR: f64 = 0.6;
/// That is said of bodies thicker than two rows of shallow places back to back, metres: the end of a rack may stand before
/// a wall as well.
const THICK_M: f64 = 3.0;
/// A block with open floor all around that is as thick as this both ways is no rack, metres.
const DEEP_M: f64 = 7.0;
/// Its fronts are so many times as bare as its sides, and by so much more.
const BARER_FACTOR: f64 = 1.5;
const BARER: f64 = 0.03;

/// A body with the direction of its rows and the sides they are reached from.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    pub rect: Rect,
    pub axis: Axis,
    /// Low and high side across the rows.
    pub fronts: [bool; 2],
}

impl Body {
    /// Looks at what is drivable around a block.
    pub(crate) fn of(frame: &Frame, block: &Block) -> Self {
        let long = if block.rect.u.len() >= block.rect.v.len() { Axis::U } else { Axis::V };
        let usual = block.axis.unwrap_or(long);
        let [usual, other] = [usual, usual.other()].map(|axis| Look::of(frame, &block.rect, axis));
        let look = if other.is_rather(&usual, frame, &block.rect) { other } else { usual };
        Self { rect: block.rect.clone(), axis: look.axis, fronts: look.fronts }
    }

    /// Its range across the rows.
    pub(crate) fn across(&self) -> Range<usize> {
        self.rect.range(self.axis.other()).clone()
    }

    fn thickness(&self, frame: &Frame) -> f64 {
        self.across().len() as f64 * frame.cell
    }

    fn length(&self, frame: &Frame) -> f64 {
        self.rect.range(self.axis).len() as f64 * frame.cell
    }
}

/// What the rows of a block along one of its directions would be like.
struct Look {
    axis: Axis,
    fronts: [bool; 2],
    /// Length of both fronts, cells.
    front: f64,
}

impl Look {
    fn of(frame: &Frame, rect: &Rect, axis: Axis) -> Self {
        let shares = front_shares(frame, rect, axis);
        let front = (shares[0] + shares[1]) * rect.range(axis).len() as f64;
        Self { axis, fronts: shares.map(|share| share >= FRONT_SHARE), front }
    }

    /// Whether the rows run so rather than as usual.
    fn is_rather(&self, usual: &Self, frame: &Frame, rect: &Rect) -> bool {
        let thickness = rect.u.len().min(rect.v.len());
        if thickness >= frame.cells_of(DEEP_M) && self.fronts == [true; 2] && usual.fronts == [true; 2] {
            return self.bareness(frame, rect) > BARER_FACTOR * usual.bareness(frame, rect) + BARER;
        }
        let is_thick = thickness >= frame.cells_of(THICK_M);
        let is_before_wall = |one: &Self, other: &Self| one.fronts[0] != one.fronts[1] && other.fronts == [true; 2];
        let factor = if is_thick && is_before_wall(self, usual) {
            WALL_FACTOR
        } else if is_thick && is_before_wall(usual, self) {
            1.0 / WALL_FACTOR
        } else {
            TURN_FACTOR
        };
        self.front > factor * usual.front
    }

    /// By how much the outermost places along both sides are more free than those between them: lanes are filled from
    /// their far end, so the front that they are filled from is bare before all others.
    fn bareness(&self, frame: &Frame, rect: &Rect) -> f64 {
        let across = rect.range(self.axis.other());
        let depth = frame.cells_of(USUAL_DEPTH_M).min(across.len() / 2);
        let free = |lines: Range<usize>| frame.share(&rect.with(self.axis.other(), lines), Cell::is_free);
        let [low, high] = [across.start + depth, across.end - depth];
        f64::midpoint(free(across.start..low), free(high..across.end)) - free(low..high)
    }
}

/// Share of the two sides along `axis` with room for a vehicle before them.
pub(crate) fn front_shares(frame: &Frame, rect: &Rect, axis: Axis) -> [f64; 2] {
    frame.beside(rect, axis, FRONT_STRIP_M.map(|metres| frame.cells_of(metres))).map(|strip| {
        let patch = frame.patch(&strip, axis);
        let has_room = |column: &usize| (0..patch.height).any(|row| patch.row(row)[*column].is_drivable());
        (0..patch.width).filter(has_room).count() as f64 / patch.width.max(1) as f64
    })
}

/// The depth of a place that explains the bodies between two fronts best.
pub(crate) fn usual(frame: &Frame, bodies: &[Body], range: [f64; 2]) -> f64 {
    let bodies: Vec<[f64; 2]> = bodies
        .iter()
        .filter(|body| body.fronts == [true; 2])
        .map(|body| [body.thickness(frame), body.length(frame)])
        .filter(|&[thickness, length]| {
            thickness >= THIN_SHARE * range[0] && thickness < thickest_pair(range[1]) && length > LEAST_LENGTH_M
        })
        .collect();
    let total: f64 = bodies.iter().map(|body| body[1]).sum();
    let cost = |depth: f64| {
        let misfits = bodies.iter().map(|&[thickness, length]| {
            let single = (thickness - depth).abs();
            length * single.min(misfit_of_pair(thickness, depth))
        });
        misfits.sum::<f64>() / total.max(1.0) + DEPTH_PRIOR * (depth - USUAL_DEPTH_M).abs()
    };
    let steps = ((range[1] - range[0]) / DEPTH_STEP_M).round() as usize;
    let depths = (0..=steps).map(|step| range[0] + step as f64 * DEPTH_STEP_M);
    depths.min_by(|&one, &other| cost(one).total_cmp(&cost(other))).unwrap_or(USUAL_DEPTH_M)
}

/// Two rows back to back cannot be thicker, metres.
pub(crate) fn thickest_pair(deepest: f64) -> f64 {
    2.0 * deepest + WIDEST_FLUE_M
}

fn misfit_of_pair(thickness: f64, depth: f64) -> f64 {
    let flue = thickness - 2.0 * depth;
    if flue < FLUE_M[0] {
        MISSING_DEPTH_COST * (FLUE_M[0] - flue)
    } else {
        WIDE_FLUE_COST * (flue - FLUE_M[1]).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decomposition::aisles::BlockKind;
    use crate::decomposition::ground::drivable;
    use crate::watch::Watch;

    /// The body of a block, drawn in characters of 0.25 m, with lanes of 1.5 m around it or a wall below.
    fn body(rows: &[String], has_wall: bool, axis: Axis) -> Body {
        const CELLS: usize = 5;
        let (width, lane) = (rows[0].len(), 6);
        let floor = vec![".".repeat(width + 2 * lane); lane];
        let beside = ".".repeat(lane);
        let within = rows.iter().map(|row| format!("{beside}{row}{beside}"));
        let below = if has_wall { vec!["#".repeat(width + 2 * lane)] } else { floor.clone() };
        let low = below.len();
        let scaled = |row: String| {
            let row: String = row.chars().flat_map(|cell| [cell; CELLS]).collect();
            (row + "\n").repeat(CELLS)
        };
        let picture: String = floor.into_iter().chain(within).chain(below).map(scaled).collect();
        let (mut frame, whole) = Frame::of_picture(&picture, 0.05);
        drivable::mark(&mut frame, 20, &Watch::unwatched()).expect("nobody stops it");
        let side = |start: usize, low: usize, length: usize| start + low * CELLS..start + (low + length) * CELLS;
        let rect = Rect { u: side(whole.u.start, lane, width), v: side(whole.v.start, low, rows.len()) };
        Body::of(&frame, &Block { rect, kind: BlockKind::Body, axis: Some(axis), fronts: [false; 2] })
    }

    #[test]
    fn what_stands_before_a_wall_is_reached_from_the_side_across_it() {
        let goods = vec!["#".repeat(30); 20];
        let found = body(&goods, true, Axis::V);
        assert_eq!((found.axis, found.fronts), (Axis::U, [false, true]));
        let found = body(&goods, false, Axis::V);
        assert_eq!((found.axis, found.fronts), (Axis::V, [true, true]));
    }

    #[test]
    fn a_block_is_reached_from_its_barer_sides() {
        let (free, goods) = (vec![".".repeat(30); 5], vec!["#".repeat(30); 20]);
        let rows = [free.clone(), goods, free].concat();
        assert_eq!(body(&rows, false, Axis::V).axis, Axis::U);
        assert_eq!(body(&rows, false, Axis::U).axis, Axis::U);
    }
}
