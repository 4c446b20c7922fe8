//! How the bodies between aisles are cut into rows, one behind the other.
//!
//! Every place of a rack must be reached, so what is thin enough between two aisles is one row, or two back to back. What
//! is deeper - double-deep racks, block storage, marked floors - and what stands before a wall may have any number of
//! layers, which [`super::across`] finds; it may reach into the aisles before it, for the outer layers of a block that is
//! filled from within hold few goods. Layers that are reached from one side form a stack: their lanes run through all
//! of them, so they are cut together, and end together.
//!
//! Cost: O(cells of the bodies), and that of the layers. Limits: where goods hide what is behind them, the usual depth of
//! a pallet decides.

use std::ops::Range;

use super::across::{self, Strips};
use super::depth::{Body, THIN_SHARE, thickest_pair};
use super::frame::{Cell, Frame, Patch};
use crate::watch::{Stopped, Watch};

/// A body with room for more than this many rows is more than one row.
const DEEP_ROOM: f64 = 1.5;
/// Rows are at most so many times as deep as usual.
const DEEPER: f64 = 1.15;
/// How far a deep body reaches into the aisles at most, as a multiple of the depth of a place, and occupied share of a
/// line with goods.
const MOST_REACH: f64 = 3.5;
const GOODS_SHARE: f64 = 0.01;
/// Occupied share of a line of cells that makes it a wall.
const WALL_SHARE: f64 = 0.5;
/// A wall behind goods is seen between them only: occupied share of what is seen of its line, and how much that is at
/// least. Of the goods themselves one sees the gaps as well.
const SEEN_WALL_SHARE: f64 = 0.8;
const LEAST_SEEN: f64 = 0.05;
/// How far in front of a wall hits are scattered, metres, and the share of a line that they take at least.
const SCATTER_M: f64 = 0.2;
const SCATTER_SHARE: f64 = 0.08;
/// Where one sees between goods, behind their fronts, metres, and the share of the front along which one does: nothing is
/// seen behind a wall, and all of it where there is another room.
const BEHIND_M: [f64; 2] = [0.2, 0.5];
const SEEN_BETWEEN_GOODS: [f64; 2] = [0.04, 0.7];

/// The layers of a body that are reached from one side, as ranges across its rows.
pub(super) type Stack = Vec<Range<usize>>;

/// The rows of a body and what is left beside them.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Layers {
    pub stacks: Vec<Stack>,
    pub rests: Vec<Range<usize>>,
}

/// Cuts the bodies of one direction into rows of about a depth, metres, within a range.
pub(super) fn cut(
    frame: &Frame,
    bodies: &[&Body],
    depth: f64,
    range: [f64; 2],
    watch: &Watch<'_>,
) -> Result<Vec<Layers>, Stopped> {
    let rooms: Vec<Range<usize>> = bodies.iter().map(|body| room(frame, body, depth)).collect();
    let is_deep = |body: &Body, room: &Range<usize>| {
        let thickness = room.len() as f64 * frame.cell;
        let is_single_front = body.fronts[0] != body.fronts[1];
        thickness >= if is_single_front { DEEP_ROOM * depth } else { thickest_pair(range[1].min(DEEPER * depth)) }
    };
    let deep: Vec<usize> = (0..bodies.len()).filter(|&body| is_deep(bodies[body], &rooms[body])).collect();
    let reaches: Vec<Range<usize>> = deep.iter().map(|&body| reach(frame, bodies[body], &rooms[body], depth)).collect();
    let strips = |(&body, reach): (&usize, &Range<usize>)| {
        let (Body { rect, axis, fronts }, room) = (bodies[body], &rooms[body]);
        let mut options = vec![room.clone(), reach.start..room.end, room.start..reach.end, reach.clone()];
        options.sort_by_key(|room| (room.start, room.end));
        options.dedup();
        Strips::of(frame, &rect.with(axis.other(), reach.clone()), *axis, *fronts, &options)
    };
    let strips: Vec<Strips> = deep.iter().zip(&reaches).map(strips).collect();
    let mut read = deep.iter().zip(reaches).zip(across::layers(&strips, range, watch)?).peekable();
    let cut =
        |(index, (body, room)): (usize, (&&Body, Range<usize>))| match read.next_if(|&((&deep, _), _)| deep == index) {
            Some(((_, reach), layers)) if layers.len() > 1 => deep_layers(body, &reach, layers),
            Some(_) if body.fronts[0] == body.fronts[1] => Layers { stacks: Vec::new(), rests: vec![body.across()] },
            _ => shallow_layers(frame, body, room, depth),
        };
    Ok(bodies.iter().zip(rooms).enumerate().map(cut).collect())
}

/// One row or two back to back; before a wall, the row along the aisle.
fn shallow_layers(frame: &Frame, body: &Body, room: Range<usize>, depth: f64) -> Layers {
    let across = body.across();
    let rows = room.len() as f64 * frame.cell / depth;
    if rows < THIN_SHARE {
        return Layers { stacks: Vec::new(), rests: vec![across] };
    }
    if body.fronts[0] == body.fronts[1] {
        if rows < DEEP_ROOM {
            return Layers { rests: beside(&across, &room), stacks: vec![vec![room]] };
        }
        let stacks = equal_parts(&room, 2).into_iter().map(|row| vec![row]).collect();
        return Layers { stacks, rests: beside(&across, &room) };
    }
    let row_depth = if rows > DEEP_ROOM { frame.cells_of(depth).max(1) } else { room.len() };
    let row = if body.fronts[0] { room.start..room.start + row_depth } else { room.end - row_depth..room.end };
    Layers { rests: beside(&across, &row), stacks: vec![vec![row]] }
}

/// What is left of a range on both sides of a part.
fn beside(range: &Range<usize>, part: &Range<usize>) -> Vec<Range<usize>> {
    [range.start..part.start, part.end..range.end].into_iter().filter(|rest| !rest.is_empty()).collect()
}

fn equal_parts(range: &Range<usize>, count: usize) -> Vec<Range<usize>> {
    let at = |part: usize| range.start + (range.len() * part + count / 2) / count;
    (0..count).map(|part| at(part)..at(part + 1)).collect()
}

/// The layers of a deep body, given as lines of its room.
fn deep_layers(body: &Body, room: &Range<usize>, layers: Vec<Range<usize>>) -> Layers {
    let stack: Stack = layers.into_iter().map(|layer| room.start + layer.start..room.start + layer.end).collect();
    let (first, last) = (&stack[0], &stack[stack.len() - 1]);
    let rests = beside(&body.across(), &(first.start..last.end));
    let stacks = if body.fronts[0] == body.fronts[1] { halves(stack) } else { vec![stack] };
    Layers { stacks, rests }
}

/// Layers between two aisles are reached from the nearer one.
fn halves(mut stack: Stack) -> Vec<Stack> {
    if stack.len() % 2 == 1 {
        return vec![stack];
    }
    let far = stack.split_off(stack.len() / 2);
    vec![stack, far]
}

/// How far a deep body may reach into the aisles before it: few goods stand in the outer layers of a block that is filled
/// from within.
fn reach(frame: &Frame, body: &Body, room: &Range<usize>, depth: f64) -> Range<usize> {
    let lines = frame.whole().range(body.axis.other()).clone();
    let far = frame.cells_of(MOST_REACH * depth);
    let around = room.start.saturating_sub(far)..(room.end + far).min(lines.end);
    let occupied = frame.counts(&body.rect.with(body.axis.other(), around.clone()), body.axis, Cell::is_occupied);
    let length = body.rect.range(body.axis).len() as f64;
    let holds_goods = |line: &usize| f64::from(occupied[line - around.start]) >= GOODS_SHARE * length;
    let gap = frame.cells_of(THIN_SHARE * depth);
    let outermost = |border: usize, beyond: &mut dyn Iterator<Item = usize>| {
        let mut last = border;
        for line in beyond {
            if holds_goods(&line) {
                last = line;
            } else if line.abs_diff(last) > gap {
                return last;
            }
        }
        border
    };
    let start = outermost(room.start, &mut (around.start..room.start).rev());
    let end = outermost(room.end - 1, &mut (room.end..around.end)) + 1;
    let [low, high] = body.fronts;
    (if low { start } else { room.start })..(if high { end } else { room.end })
}

/// The part of a body that may hold goods: all of it, or what lies before the wall on the side without an aisle.
fn room(frame: &Frame, body: &Body, depth: f64) -> Range<usize> {
    let across = body.across();
    if body.fronts[0] == body.fronts[1] {
        return across;
    }
    let low_front = body.fronts[0];
    let patch = frame.patch(&body.rect.with(body.axis.other(), across.clone()), body.axis);
    let is_wall = |y: &usize| {
        let from_front = if low_front { *y } else { patch.height - 1 - y };
        let [occupied, known] = [patch.occupied_share(*y..y + 1), patch.known_share(*y..y + 1)];
        let shines_through = known >= LEAST_SEEN && occupied >= SEEN_WALL_SHARE * known;
        // Nearer to the front than a place is deep, a line may be the front of goods: those let the robot see between them.
        let is_beyond_goods = from_front as f64 * frame.cell >= THIN_SHARE * depth;
        if is_beyond_goods {
            occupied >= WALL_SHARE || shines_through
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

/// Whether the robot sees some of what is behind a line that may be the fronts of goods.
fn sees_between_goods(frame: &Frame, patch: &Patch, line: usize, low_front: bool) -> bool {
    let [near, far] = BEHIND_M.map(|metres| frame.cells_of(metres));
    let behind = if low_front { line + near..line + far } else { line.saturating_sub(far)..line.saturating_sub(near) };
    let seen = patch.known_share(behind.start.min(patch.height)..behind.end.min(patch.height));
    (SEEN_BETWEEN_GOODS[0]..SEEN_BETWEEN_GOODS[1]).contains(&seen)
}

#[cfg(test)]
mod tests {
    use super::super::frame::Axis;
    use super::*;

    /// How many lines of a body that has an aisle above it may hold goods, in cells of 0.05 m.
    fn check(picture: &str, lines: usize) {
        let (frame, rect) = Frame::of_picture(picture, 0.05);
        let body = Body { rect, axis: Axis::U, fronts: [false, true] };
        assert_eq!(room(&frame, &body, 0.5).len(), lines);
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
            8,
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
            9,
        );
    }
}
