//! The ground on lines across a direction, with the walls at its ends.

use std::f64::consts::FRAC_PI_2;

use super::super::ground::RoomGround;
use crate::digital_lines::for_each_line;
use crate::geometry::{direction, normal};
use crate::runs::runs_where;
use crate::watch::{Stopped, Watch};

/// A run of ground on a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct GroundRun {
    /// Where it begins and ends across the direction, metres.
    pub ends: [f64; 2],
    /// Whether a wall stands at each end. Goods that stand alone are no walls.
    pub is_wall: [bool; 2],
}

impl GroundRun {
    pub(super) fn width(&self) -> f64 {
        self.ends[1] - self.ends[0]
    }
}

/// A line across a direction.
pub(super) struct CrossLine {
    /// Its place along the direction, metres.
    pub along: f64,
    /// The ground on it, in no order.
    pub runs: Vec<GroundRun>,
}

/// The lines across a direction, `angle` in radians, by their places along it.
pub(super) fn find(ground: &RoomGround, angle: f64, watch: &Watch<'_>) -> Result<Vec<CrossLine>, Stopped> {
    let width = ground.width;
    let height = ground.is_free.len().checked_div(width).unwrap_or(0);
    let (along, across) = (direction(angle), normal(angle));
    let place = |cell: usize| ground.middle_of([(cell % width) as i64, (cell / width) as i64]).coords;
    // Half the length of a line in one cell.
    let half = ground.cell / across.x.abs().max(across.y.abs()) / 2.0;
    let mut lines = Vec::new();
    for_each_line([width, height], angle + FRAC_PI_2, watch, |line| {
        let is_wall =
            |index: Option<usize>| index.and_then(|index| line.get(index)).is_some_and(|&cell| !ground.is_stack[cell]);
        let runs = runs_where(line.len(), |index| ground.is_free[line[index]]).map(|run| {
            let ends = [run.start, run.end - 1].map(|index| across.dot(&place(line[index])));
            let walls = [is_wall(run.start.checked_sub(1)), is_wall(Some(run.end))];
            let [low, high] = if ends[0] <= ends[1] { [0, 1] } else { [1, 0] };
            GroundRun { ends: [ends[low] - half, ends[high] + half], is_wall: [walls[low], walls[high]] }
        });
        if let Some(&first) = line.first() {
            lines.push(CrossLine { along: along.dot(&place(first)), runs: runs.collect() });
        }
    })?;
    lines.sort_by(|one, other| one.along.total_cmp(&other.along));
    Ok(lines)
}
