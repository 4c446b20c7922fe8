//! Which lines of a body its layers may fill.
//!
//! These are the lines between two aisles, or between an aisle and a wall. An aisle may have been cut for other bodies than
//! this one, so goods may begin further in. Few goods stand in the outer layers of deep block storage that is filled from
//! within, so layers may begin further out. [`super::layer_count`] chooses among these extents.
//!
//! Cost: O(cells of the body). Limits: walls run along the body.

use std::ops::Range;

use super::body::Body;
use super::depth::{THIN_SHARE, thickest_pair};
use crate::decomposition::ground::{Cell, Patch, RegionFrame};

/// A body with room for more than this many rows is more than one row.
pub(super) const DEEP_ROOM: f64 = 1.5;
/// Depth of the deepest row, as a multiple of the usual depth.
const DEEPER: f64 = 1.15;
/// How far a deep body reaches into the aisles at most, as a multiple of the depth of a place, and least occupied share of
/// a line with goods.
const MOST_REACH: f64 = 3.5;
const GOODS_SHARE: f64 = 0.01;
/// Distance of goods from the front of their place, metres, at most.
const OVERHANG_M: f64 = 0.2;
/// Occupied share of a line of cells that makes it a wall.
const WALL_SHARE: f64 = 0.5;
/// A wall behind goods is seen between them only: least occupied share of the known part of its line, and least known
/// share. A line through goods has a lower occupied share, since the gaps between them are seen as well.
const SEEN_WALL_SHARE: f64 = 0.8;
const LEAST_SEEN: f64 = 0.05;
/// How far in front of a wall hits are scattered, metres, and the least share of a line that they take.
const SCATTER_M: f64 = 0.2;
const SCATTER_SHARE: f64 = 0.08;
/// Strip behind the fronts of goods, metres, and the known share of it between goods: nothing is known behind a wall, and
/// all where there is another room.
const BEHIND_M: [f64; 2] = [0.2, 0.5];
const SEEN_BETWEEN_GOODS: [f64; 2] = [0.04, 0.7];

/// The extents that the layers of a body may fill, where places are about `depth` deep within a range, metres. The first
/// one, which is always there, reaches from aisle to aisle or to a wall.
pub(super) fn extents(frame: &RegionFrame, body: &Body, depth: f64, range: [f64; 2]) -> Vec<Range<usize>> {
    let room = room(frame, body, depth);
    let far = if is_deep(frame, body, &room, depth, range) { frame.cells_of(MOST_REACH * depth) } else { 0 };
    let lines = OccupiedLines::around(frame, body, room.start.saturating_sub(far)..room.end + far);
    let (gap, overhang) = (frame.cells_of(THIN_SHARE * depth), frame.cells_of(OVERHANG_M));
    let (mut starts, mut ends) = (vec![room.start], vec![room.end]);
    if body.fronts[0] {
        starts.push(lines.outermost(room.start, (lines.range.start..room.start).rev(), gap));
        starts.extend(lines.first(room.clone()).filter(|line| line - room.start > overhang));
    }
    if body.fronts[1] && !room.is_empty() {
        ends.push(lines.outermost(room.end - 1, room.end..lines.range.end, gap) + 1);
        let last = lines.first(room.clone().rev()).map(|line| line + 1);
        ends.extend(last.filter(|line| room.end - line > overhang));
    }
    starts.dedup();
    ends.dedup();
    starts.iter().flat_map(|&start| ends.iter().map(move |&end| start..end)).collect()
}

/// Whether a body has room for more than two rows back to back, or than one before a wall.
pub(super) fn is_deep(frame: &RegionFrame, body: &Body, room: &Range<usize>, depth: f64, range: [f64; 2]) -> bool {
    let thickness = room.len() as f64 * frame.cell;
    let is_single_front = body.fronts[0] != body.fronts[1];
    thickness >= if is_single_front { DEEP_ROOM * depth } else { thickest_pair(range[1].min(DEEPER * depth)) }
}

/// The lines of a body and around it, with their occupied cells.
struct OccupiedLines {
    range: Range<usize>,
    occupied: Vec<u32>,
    least: f64,
}

impl OccupiedLines {
    fn around(frame: &RegionFrame, body: &Body, lines: Range<usize>) -> Self {
        let across = body.axis.other();
        let lines = lines.start..lines.end.min(frame.whole().range(across).end);
        let occupied = frame.counts(&body.rect.with(across, lines.clone()), body.axis, Cell::is_occupied);
        Self { range: lines, occupied, least: GOODS_SHARE * body.rect.range(body.axis).len() as f64 }
    }

    fn hold_goods(&self, line: usize) -> bool {
        f64::from(self.occupied[line - self.range.start]) >= self.least
    }

    /// The first of some lines that holds goods.
    fn first(&self, mut lines: impl Iterator<Item = usize>) -> Option<usize> {
        lines.find(|&line| self.hold_goods(line))
    }

    /// The last line with goods beyond a border, before a gap between them; the border itself if there is no gap.
    fn outermost(&self, border: usize, beyond: impl Iterator<Item = usize>, gap: usize) -> usize {
        let mut last = border;
        for line in beyond {
            if self.hold_goods(line) {
                last = line;
            } else if line.abs_diff(last) > gap {
                return last;
            }
        }
        border
    }
}

/// The part of a body that may hold goods: all of it, or what lies before the wall on the side without an aisle.
fn room(frame: &RegionFrame, body: &Body, depth: f64) -> Range<usize> {
    let across = body.across();
    if body.fronts[0] == body.fronts[1] {
        return across;
    }
    let low_front = body.fronts[0];
    let patch = frame.patch(&body.rect.with(body.axis.other(), across.clone()), body.axis);
    let is_wall = |y: &usize| {
        let from_front = if low_front { *y } else { patch.height - 1 - y };
        let [occupied, known] = [patch.occupied_share(*y..y + 1), patch.known_share(*y..y + 1)];
        let is_seen_between_goods = known >= LEAST_SEEN && occupied >= SEEN_WALL_SHARE * known;
        // Nearer to the front than a place is deep, a line may be the front of goods, and the robot sees between goods.
        let is_beyond_goods = from_front as f64 * frame.cell >= THIN_SHARE * depth;
        if is_beyond_goods {
            occupied >= WALL_SHARE || is_seen_between_goods
        } else {
            occupied >= WALL_SHARE && !sees_between_goods(frame, &patch, *y, low_front)
        }
    };
    // Rays scatter at a wall.
    let reach = frame.cells_of(SCATTER_M);
    let is_scatter = |y: &usize| patch.occupied_share(*y..y + 1) >= SCATTER_SHARE;
    if low_front {
        let Some(wall) = (0..patch.height).rev().find(is_wall) else { return across };
        let scatter = (wall.saturating_sub(reach)..wall).rev().take_while(is_scatter).count();
        across.start..across.start + wall - scatter
    } else {
        let Some(wall) = (0..patch.height).find(is_wall) else { return across };
        let scatter = (wall + 1..(wall + 1 + reach).min(patch.height)).take_while(is_scatter).count();
        across.start + wall + 1 + scatter..across.end
    }
}

/// Whether some of what lies behind a line is known, so that the line is the fronts of goods.
fn sees_between_goods(frame: &RegionFrame, patch: &Patch, line: usize, low_front: bool) -> bool {
    let [near, far] = BEHIND_M.map(|metres| frame.cells_of(metres));
    let behind = if low_front { line + near..line + far } else { line.saturating_sub(far)..line.saturating_sub(near) };
    let seen = patch.known_share(behind.start.min(patch.height)..behind.end.min(patch.height));
    (SEEN_BETWEEN_GOODS[0]..SEEN_BETWEEN_GOODS[1]).contains(&seen)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decomposition::ground::Axis;

    /// How many lines of a body that has an aisle above it may hold goods, in cells of 0.05 m.
    fn check(picture: &str, lines: &[usize]) {
        let (frame, rect) = RegionFrame::of_picture(picture, 0.05);
        let body = Body { rect, axis: Axis::U, fronts: [false, true] };
        let extents = extents(&frame, &body, 0.5, [0.4, 0.6]);
        assert_eq!(extents.iter().map(ExactSizeIterator::len).collect::<Vec<_>>(), lines);
    }

    #[test]
    fn an_aisle_may_have_been_cut_for_more_than_this_body() {
        check(
            "
            ........................
            ........................
            ........................
            ........................
            ........................
            ####.####.####.####.####
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            ",
            &[16, 11],
        );
    }

    #[test]
    fn goods_end_at_a_wall_that_shows_between_them() {
        check(
            "
            ####.####.####.####.####
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            ????.????.????.????.????
            ????#????#????#????#????
            ????????????????????????
            ????????????????????????
            ",
            &[8],
        );
    }

    #[test]
    fn goods_that_show_the_gaps_behind_them_go_on() {
        check(
            "
            ####.####.####.####.####
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            #??#.#??#.#??#.#??#.#??#
            ????.????.????.????.????
            ???#.#??#.#??#.#??#.#???
            ????.????.????.????.????
            ",
            &[9],
        );
    }
}
