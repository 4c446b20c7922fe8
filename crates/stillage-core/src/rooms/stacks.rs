//! Stacks: shelves and piles of goods that stand in a room, free or against its wall.
//!
//! Closed ground is a wall, the building around the room, or goods. Goods have the room on two sides: a straight line
//! in one of the two directions of the site leads from the room through them and out into the same room. Lines into a
//! wall lead to another room or to none, and lines along a wall pass through no more than its thickness. So the closed
//! cells between two open cells of one room, opened by a disc that is wider than walls are thick, are stacks. It does
//! not matter whether something touches them, or whether their inside was seen. Free ground that is too tight for a
//! person counts as closed: it is the inside of a shelf, or the slot behind it.
//!
//! Cost: O(cells of the rectangles around the rooms). Limits: what stands against a wall at a slant loses its edges;
//! goods that fill a corner of the room look like the corner of the building, and are not found.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

use crate::components::{Component, Components, Neighbours};
use crate::digital_lines::for_each_line;
use crate::distance_transform::DistanceTransform;
use crate::geometry::OrientedBox;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::watch::{Stopped, Watch};

/// Least thickness of a stack, metres: walls are thinner, shelves of a shop have 0.5.
const STACK_M: f64 = 0.4;
/// Diameter of the disc that stacks are opened by, metres: below the depth of the smallest place, 0.6; walls and
/// columns jut out less.
const DEPTH_M: f64 = 0.55;
/// Least share of the smallest box around a stack that it fills; walls around a corner fill less.
const STACK_FILL: f64 = 0.6;
/// Least area of a stack, square metres: the smallest place (0.8 by 0.6 m); chairs and plants take less.
const STACK_M2: f64 = 0.48;
/// Ground into which no disc of this diameter fits is too tight for a person, metres.
const TIGHT_M: f64 = 0.25;

/// The stacks of a site.
pub(crate) struct Stacks {
    /// The stack of each cell, row-major, from 1; 0 for none.
    pub cells: Vec<u32>,
    /// The smallest box around each stack, metres of the grid frame.
    pub footprints: Vec<OrientedBox>,
    /// The room that each stack stands in: most cells around it are of this room; 0 for none.
    pub rooms: Vec<u32>,
}

impl Stacks {
    /// Finds the stacks in rooms, given by the room of each cell, 0 for none; `angle` is a direction of the site, radians.
    /// `stands_alone` is true for the cells of stacks that nothing touches.
    pub(super) fn find(
        grid: &OccupancyGrid,
        rooms: &[u32],
        stands_alone: impl Fn(usize) -> bool,
        angle: f64,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let (width, cells, cell) = (grid.width(), grid.cells(), grid.resolution());
        let margin = (TIGHT_M / cell).ceil() as usize + 1;
        let mut is_thick = vec![false; cells.len()];
        for (room, window) in RoomRectangle::of_rooms(rooms, width, margin) {
            let is_free = window.cells().map(|cell| cells[cell] == Occupancy::Free).collect();
            let is_open = opened(is_free, window.columns.len(), TIGHT_M / cell, watch)?;
            let is_room: Vec<bool> = window.cells().map(|cell| rooms[cell] == room).collect();
            let mut is_between = vec![false; is_room.len()];
            for angle in [angle, angle + FRAC_PI_2] {
                for_each_line([window.columns.len(), window.rows.len()], angle, watch, |line| {
                    mark_between(line, &is_open, &is_room, &mut is_between);
                })?;
            }
            let of_room = opened(is_between, window.columns.len(), DEPTH_M / cell, watch)?;
            window.cells().zip(of_room).for_each(|(cell, is_in)| is_thick[cell] |= is_in);
        }
        let parts =
            Components::of([width, cells.len()], Neighbours::Four, |cell| is_thick[cell] || stands_alone(cell), watch)?;
        let mut stacks = Self { cells: vec![0; cells.len()], footprints: Vec::new(), rooms: Vec::new() };
        for part in parts.iter() {
            let closed = part.cells().filter(|&cell| cells[cell] != Occupancy::Free).count();
            if let Some(footprint) = footprint(part, closed, cell) {
                stacks.footprints.push(footprint);
                stacks.rooms.push(room_around(part, rooms, width));
                part.cells().for_each(|cell| stacks.cells[cell] = stacks.footprints.len() as u32);
            }
        }
        Ok(stacks)
    }
}

/// The room that most cells beside the runs of a component are of; 0 for none.
fn room_around(part: Component<'_>, rooms: &[u32], width: usize) -> u32 {
    let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
    for run in part.runs() {
        let row = run.row as usize * width;
        let beside = [(row + run.columns.start as usize).checked_sub(1), Some(row + run.columns.end as usize)];
        for &room in beside.into_iter().flatten().filter_map(|cell| rooms.get(cell)).filter(|&&room| room != 0) {
            *counts.entry(room).or_default() += 1;
        }
    }
    counts.into_iter().max_by_key(|&(room, count)| (count, std::cmp::Reverse(room))).map_or(0, |(room, _)| room)
}

/// A rectangle of the map.
pub(super) struct RoomRectangle {
    pub(super) columns: Range<usize>,
    pub(super) rows: Range<usize>,
    /// Columns of the map.
    width: usize,
}

impl RoomRectangle {
    /// Those around the cells of each room, with its number, and a margin, cells.
    fn of_rooms(rooms: &[u32], width: usize, margin: usize) -> impl Iterator<Item = (u32, Self)> {
        let height = rooms.len().checked_div(width).unwrap_or(0);
        let mut bounds: BTreeMap<u32, [Range<usize>; 2]> = BTreeMap::new();
        for (row, line) in rooms.chunks_exact(width.max(1)).enumerate() {
            let mut start = 0;
            for run in line.chunk_by(PartialEq::eq) {
                let columns = start..start + run.len();
                start = columns.end;
                if run[0] != 0 {
                    let [across, down] = bounds.entry(run[0]).or_insert([columns.clone(), row..row]);
                    *across = across.start.min(columns.start)..across.end.max(columns.end);
                    down.end = row + 1;
                }
            }
        }
        let wider = move |range: &Range<usize>, end| range.start.saturating_sub(margin)..(range.end + margin).min(end);
        bounds.into_iter().map(move |(room, [columns, rows])| {
            (room, Self { columns: wider(&columns, width), rows: wider(&rows, height), width })
        })
    }

    /// That around the cells of one room; `None` for a room without cells.
    pub(super) fn of_room(rooms: &[u32], room: u32, width: usize) -> Option<Self> {
        Self::of_rooms(rooms, width, 0).find(|&(number, _)| number == room).map(|(_, rectangle)| rectangle)
    }

    /// Its cells of the map, row-major.
    pub(super) fn cells(&self) -> impl Iterator<Item = usize> {
        self.rows.clone().flat_map(move |row| self.columns.clone().map(move |column| row * self.width + column))
    }
}

/// The smallest box around a component, metres, if the component is as thick and as full as goods and at least
/// [`STACK_M2`] of it are `closed` cells; `cell` is the side of a cell, metres.
pub(super) fn footprint(thing: Component<'_>, closed: usize, cell: f64) -> Option<OrientedBox> {
    let area_of = |cells: usize| cells as f64 * cell * cell;
    if area_of(closed) < STACK_M2 {
        return None;
    }
    let smallest = thing.smallest_box(cell);
    let [long, short] = smallest.sides();
    let is_stack = short >= STACK_M && area_of(thing.len()) >= STACK_FILL * long * short;
    is_stack.then_some(smallest)
}

/// The morphological opening of some cells by a disc (G. Matheron 1975): those that discs of `diameter` cells cover
/// that lie inside. Cells beyond the map count as inside.
fn opened(is_in: Vec<bool>, width: usize, diameter: f64, watch: &Watch<'_>) -> Result<Vec<bool>, Stopped> {
    // Distances are measured to the centre of an obstacle, which begins half a cell before.
    let reach = f64::midpoint(diameter, 1.0);
    let squared = reach * reach;
    let is_within = |distance: u32| f64::from(distance) < squared;
    let from_outside = DistanceTransform::of(width, is_in.len(), |cell| !is_in[cell], watch)?.squared;
    let is_middle: Vec<bool> = from_outside.into_iter().map(|distance| !is_within(distance)).collect();
    let from_middle = DistanceTransform::of(width, is_in.len(), |cell| is_middle[cell], watch)?.squared;
    Ok(is_in.into_iter().zip(from_middle).map(|(is_in, distance)| is_in && is_within(distance)).collect())
}

/// Marks the cells of a line between two open ones of the room.
fn mark_between(line: &[usize], is_open: &[bool], is_room: &[bool], is_between: &mut [bool]) {
    let mut last: Option<(usize, bool)> = None;
    for (place, &cell) in line.iter().enumerate().filter(|&(_, &cell)| is_open[cell]) {
        if let Some((before, true)) = last.replace((place, is_room[cell]))
            && is_room[cell]
        {
            line[before + 1..place].iter().for_each(|&cell| is_between[cell] = true);
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;

    /// The stacks of one room, a letter each; a cell is 0.2 m.
    fn check(picture: &str, expected: &Expect) {
        let grid = OccupancyGrid::from_ascii(picture, 0.2);
        let rooms: Vec<u32> = grid.cells().iter().map(|&cell| u32::from(cell == Occupancy::Free)).collect();
        let found = Stacks::find(&grid, &rooms, |_| false, 0.0, &Watch::unwatched()).expect("nobody stops it");
        let letter = |(cell, &stack): (usize, &u32)| match (stack, grid.cells()[cell]) {
            (1.., _) => char::from(b'a' + (stack - 1) as u8),
            (0, Occupancy::Free) => '.',
            (0, Occupancy::Occupied) => '#',
            (0, Occupancy::Unknown) => '?',
        };
        let letters: Vec<char> = found.cells.iter().enumerate().map(letter).collect();
        let rows: Vec<String> = letters.chunks(grid.width()).rev().map(String::from_iter).collect();
        expected.assert_eq(&(rows.join("\n") + "\n"));
    }

    #[test]
    fn what_touches_a_wall_is_a_stack_like_what_does_not() {
        check(
            "
            ??????????????????????????????
            ##############????############
            #............#????#..........#
            #............#????#..........#
            #............######..........#
            #.....................########
            #.....######..........########
            #.....#????#..........########
            #.....######.................#
            #............................#
            ##############################
            ",
            &expect![[r#"
                ??????????????????????????????
                ##############????############
                #............bbbbbb..........#
                #............bbbbbb..........#
                #............bbbbbb..........#
                #.....................########
                #.....aaaaaa..........########
                #.....aaaaaa..........########
                #.....aaaaaa.................#
                #.....aaaaaa.................#
                ##############################
            "#]],
        );
    }

    #[test]
    fn walls_and_corners_of_the_building_are_none() {
        check(
            "
            ##################????????????
            #................#????????????
            #................#????????????
            #................#############
            #............................#
            #........#...................#
            #........#...................#
            #........#...................#
            ##############################
            ",
            &expect![[r#"
                ##################????????????
                #................#????????????
                #................#????????????
                #................#############
                #............................#
                #........#...................#
                #........#...................#
                #........#...................#
                ##############################
            "#]],
        );
    }

    #[test]
    fn the_inside_of_a_shelf_is_no_ground() {
        check(
            "
            .................
            .................
            .................
            ....########.....
            .................
            ....########.....
            .................
            ....########.....
            .................
            .................
            .................
            ",
            &expect![[r#"
                .................
                .................
                .................
                ....#aaaaaa#.....
                .....aaaaaa......
                ....#aaaaaa#.....
                .....aaaaaa......
                ....#aaaaaa#.....
                .................
                .................
                .................
            "#]],
        );
    }
}
