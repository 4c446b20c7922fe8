//! Junctions: where three arms of a corridor or more meet.
//!
//! A cell lies where corridors meet when the ground of the room reaches far through it in both directions of the site.
//! At a bend it does so too, but only two arms lead away. Cost: O(cells of the rectangle around the room), and of the
//! rectangles around its junctions.

use std::f64::consts::FRAC_PI_2;

use super::ground::RoomGround;
use super::partition::Partition;
use super::room_cells::RoomCells;
use super::stacks::RoomRectangle;
use crate::components::{Components, Neighbours};
use crate::digital_lines::for_each_line;
use crate::geometry::direction;
use crate::plot::PlotKind;
use crate::watch::{Stopped, Watch};

/// How far the ground reaches through a junction in both directions, in widths of the corridor: across it, and into an
/// arm further than a niche is deep.
const REACH: f64 = 2.5;
/// How far an arm is followed, in widths of the corridor.
const ARM: f64 = 1.0;
/// Least area of an arm up to there, in squares of the width of the corridor: half of its own.
const LEAST_ARM: f64 = 0.5;
/// Least and greatest area of a junction, in squares of the width of the corridor. No measurement is recorded for these
/// values.
const AREAS: [f64; 2] = [0.25, 6.0];

/// Cuts the junctions out of a corridor, given by its number and its width, cells; `angle` is a direction of the site,
/// radians.
pub(super) fn cut_out(
    ground: &RoomGround,
    partition: &Partition,
    rooms: &mut RoomCells,
    corridor: u32,
    width: f64,
    angle: f64,
    watch: &Watch<'_>,
) -> Result<(), Stopped> {
    let Some(window) = RoomRectangle::of_room(&rooms.cells, corridor, ground.width) else { return Ok(()) };
    let cells: Vec<usize> = window.cells().collect();
    let size = [window.columns.len(), window.rows.len()];
    let is_corridor: Vec<bool> =
        cells.iter().map(|&cell| ground.is_free[cell] && rooms.cells[cell] == corridor).collect();
    let mut directions_with_reach = vec![0_u8; cells.len()];
    for angle in [angle, angle + FRAC_PI_2] {
        let along = direction(angle);
        let least = REACH * width * along.x.abs().max(along.y.abs());
        for_each_line(size, angle, watch, |line| {
            for run in line.chunk_by(|&one, &other| is_corridor[one] == is_corridor[other]) {
                if is_corridor[run[0]] && run.len() as f64 >= least {
                    for &cell in run {
                        directions_with_reach[cell] += 1;
                    }
                }
            }
        })?;
    }
    let is_open = |cell: usize| directions_with_reach[cell] == 2;
    let found = Components::of([size[0], cells.len()], Neighbours::Four, is_open, watch)?;
    let squares = |count: usize| count as f64 / (width * width);
    for junction in found.iter().filter(|junction| (AREAS[0]..=AREAS[1]).contains(&squares(junction.len()))) {
        let around = Around::of(junction.bounds(), (ARM * width).ceil() as usize, size);
        let mut is_in = vec![false; cells.len()];
        junction.cells().for_each(|cell| is_in[cell] = true);
        let arms = around.components(|cell| is_corridor[cell] && !is_open(cell), size[0], watch)?;
        let touches = |arm: &Vec<usize>| arm.iter().any(|&cell| beside(cell, size).any(|near| is_in[near]));
        let arms = arms.iter().filter(|arm| squares(arm.len()) >= LEAST_ARM && touches(arm)).count();
        if arms >= 3 {
            let number = rooms.add_part_of(corridor, PlotKind::Junction);
            junction.cells().for_each(|cell| rooms.cells[cells[cell]] = number);
        }
    }
    // The walls beside a junction go with it.
    for &cell in cells.iter().filter(|&&cell| !ground.is_free[cell]) {
        if rooms.cells[cell] == corridor {
            rooms.cells[cell] = rooms.cells[partition.nearest[cell] as usize];
        }
    }
    Ok(())
}

/// The cells up, down, left and right of one.
fn beside(cell: usize, [columns, rows]: [usize; 2]) -> impl Iterator<Item = usize> {
    let left = (!cell.is_multiple_of(columns)).then(|| cell - 1);
    let right = (!(cell + 1).is_multiple_of(columns)).then_some(cell + 1);
    let above = Some(cell + columns).filter(|&above| above < columns * rows);
    [left, right, cell.checked_sub(columns), above].into_iter().flatten()
}

/// A rectangle of a window.
struct Around {
    columns: std::ops::Range<usize>,
    rows: std::ops::Range<usize>,
}

impl Around {
    fn of([columns, rows]: [std::ops::Range<usize>; 2], margin: usize, size: [usize; 2]) -> Self {
        let wider =
            |range: std::ops::Range<usize>, end| range.start.saturating_sub(margin)..(range.end + margin).min(end);
        Self { columns: wider(columns, size[0]), rows: wider(rows, size[1]) }
    }

    /// The connected parts of some of its cells, as cells of the window with `width` columns.
    fn components(
        &self,
        is_in: impl Fn(usize) -> bool,
        width: usize,
        watch: &Watch<'_>,
    ) -> Result<Vec<Vec<usize>>, Stopped> {
        let side = self.columns.len();
        let of_window = |cell: usize| (self.rows.start + cell / side) * width + self.columns.start + cell % side;
        let size = [side, side * self.rows.len()];
        let found = Components::of(size, Neighbours::Four, |cell| is_in(of_window(cell)), watch)?;
        Ok(found.iter().map(|part| part.cells().map(of_window).collect()).collect())
    }
}
