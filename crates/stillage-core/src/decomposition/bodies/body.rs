//! The direction of the rows of a body, and which of its sides goods are taken from.
//!
//! A side is a front where a vehicle finds room along most of it. The rows run along the aisles beside the body unless
//! the other direction has clearly more front, or fits better what stands before a wall or alone on open floor.
//!
//! Cost: O(cells beside the bodies), and O(cells) of the thick ones. Limits: a body has one direction.

use std::ops::Range;

use crate::decomposition::aisles::BodyArea;
use crate::decomposition::ground::{Axis, Cell, Rect, RegionFrame};

/// Where a vehicle must find room before a front, metres from the border on: borders may lie inside the goods.
const FRONT_STRIP_M: [f64; 2] = [0.25, 0.7];
/// Share of a side with such room that makes it a front.
const FRONT_SHARE: f64 = 0.5;
/// Rows run across the aisles beside them if that way they have this many times as much front.
const TURN_FACTOR: f64 = 1.5;
/// The same factor where, along one direction only, the body has a front on one side and a wall on the other: goods before
/// a wall are reached from the side across it, so that direction is preferred.
const WALL_FACTOR: f64 = 0.6;
/// A body at least this thick may be preferred so, metres: more than two rows of shallow places back to back, since the
/// end of a rack may stand before a wall as well.
const THICK_M: f64 = 3.0;
/// A body with open floor all around that is this thick both ways is block storage rather than a rack, metres.
const BLOCK_M: f64 = 7.0;
/// The fronts of block storage are barer than its other sides by this factor and, on top, this share of cells.
const BARER_FACTOR: f64 = 1.5;
const BARER_SHARE: f64 = 0.03;
/// Depth of the outermost places that are compared with the inner ones, metres: that of a pallet.
const PLACE_DEPTH_M: f64 = 1.15;

/// A body with the direction of its rows and the sides they are reached from.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    pub rect: Rect,
    pub axis: Axis,
    /// Low and high side across the rows.
    pub fronts: [bool; 2],
}

impl Body {
    /// Decides by what is drivable around an area.
    pub(crate) fn of(frame: &RegionFrame, area: &BodyArea) -> Self {
        let long = if area.rect.u.len() >= area.rect.v.len() { Axis::U } else { Axis::V };
        let usual = area.axis.unwrap_or(long);
        let [usual, other] = [usual, usual.other()].map(|axis| RowDirection::of(frame, &area.rect, axis));
        let chosen = if other.is_preferred_to(&usual, frame, &area.rect) { other } else { usual };
        Self { rect: area.rect.clone(), axis: chosen.axis, fronts: chosen.fronts }
    }

    /// Its range across the rows.
    pub(crate) fn across(&self) -> Range<usize> {
        self.rect.range(self.axis.other()).clone()
    }

    pub(super) fn thickness(&self, frame: &RegionFrame) -> f64 {
        self.across().len() as f64 * frame.cell
    }

    pub(super) fn length(&self, frame: &RegionFrame) -> f64 {
        self.rect.range(self.axis).len() as f64 * frame.cell
    }
}

/// The fronts that a body has if its rows run along one of its directions.
struct RowDirection {
    axis: Axis,
    fronts: [bool; 2],
    /// Length of both fronts, cells.
    front: f64,
}

impl RowDirection {
    fn of(frame: &RegionFrame, rect: &Rect, axis: Axis) -> Self {
        let shares = front_shares(frame, rect, axis);
        let front = (shares[0] + shares[1]) * rect.range(axis).len() as f64;
        Self { axis, fronts: shares.map(|share| share >= FRONT_SHARE), front }
    }

    /// Whether the rows run along this direction rather than along the usual one.
    fn is_preferred_to(&self, usual: &Self, frame: &RegionFrame, rect: &Rect) -> bool {
        let thickness = rect.u.len().min(rect.v.len());
        if thickness >= frame.cells_of(BLOCK_M) && self.fronts == [true; 2] && usual.fronts == [true; 2] {
            return self.bareness(frame, rect) > BARER_FACTOR * usual.bareness(frame, rect) + BARER_SHARE;
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

    /// Free share of the outermost places along both sides, less that of the places between them. Storage lanes are filled
    /// from their far end, so the places at their front are the first to be empty.
    fn bareness(&self, frame: &RegionFrame, rect: &Rect) -> f64 {
        let across = rect.range(self.axis.other());
        let depth = frame.cells_of(PLACE_DEPTH_M).min(across.len() / 2);
        let free = |lines: Range<usize>| frame.share(&rect.with(self.axis.other(), lines), Cell::is_free);
        let [low, high] = [across.start + depth, across.end - depth];
        f64::midpoint(free(across.start..low), free(high..across.end)) - free(low..high)
    }
}

/// Share of the two sides along `axis` with room for a vehicle before them.
pub(crate) fn front_shares(frame: &RegionFrame, rect: &Rect, axis: Axis) -> [f64; 2] {
    frame.beside(rect, axis, FRONT_STRIP_M.map(|metres| frame.cells_of(metres))).map(|strip| {
        let patch = frame.patch(&strip, axis);
        let has_room = |column: &usize| (0..patch.height).any(|row| patch.row(row)[*column].is_drivable());
        (0..patch.width).filter(has_room).count() as f64 / patch.width.max(1) as f64
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decomposition::ground::drivable;
    use crate::watch::Watch;

    /// The body of an area drawn in characters of 0.25 m, with 1.5 m of open floor around it or a wall below.
    fn body(rows: &[String], has_wall: bool, axis: Axis) -> Body {
        const CELLS: usize = 5;
        let (width, floor_width) = (rows[0].len(), 6);
        let floor = vec![".".repeat(width + 2 * floor_width); floor_width];
        let beside = ".".repeat(floor_width);
        let within = rows.iter().map(|row| format!("{beside}{row}{beside}"));
        let below = if has_wall { vec!["#".repeat(width + 2 * floor_width)] } else { floor.clone() };
        let low = below.len();
        let scaled = |row: String| {
            let row: String = row.chars().flat_map(|cell| [cell; CELLS]).collect();
            (row + "\n").repeat(CELLS)
        };
        let picture: String = floor.into_iter().chain(within).chain(below).map(scaled).collect();
        let (mut frame, whole) = RegionFrame::of_picture(&picture, 0.05);
        drivable::mark(&mut frame, 1.0, &Watch::unwatched()).expect("nobody stops it");
        let side = |start: usize, low: usize, length: usize| start + low * CELLS..start + (low + length) * CELLS;
        let rect = Rect { u: side(whole.u.start, floor_width, width), v: side(whole.v.start, low, rows.len()) };
        Body::of(&frame, &BodyArea { rect, axis: Some(axis), fronts: [false; 2] })
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
    fn block_storage_is_reached_from_its_barer_sides() {
        let (free, goods) = (vec![".".repeat(30); 5], vec!["#".repeat(30); 20]);
        let rows = [free.clone(), goods, free].concat();
        assert_eq!(body(&rows, false, Axis::V).axis, Axis::U);
        assert_eq!(body(&rows, false, Axis::U).axis, Axis::U);
    }
}
