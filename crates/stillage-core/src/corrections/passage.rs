//! Doors that people draw, open or shut.
//!
//! A border belongs to a door where it runs beside the line of the door; it is cut at the jambs, so that what lies beyond
//! them stays as it is.

use super::draft::{DoorMark, MapDraft};
use super::failure::Failure;
use crate::arrangement::{EdgeId, FaceId, Subdivision};
use crate::geometry::{Bounds, Point, segment};

/// A border runs beside a door when it is nearer than this to the line, metres: what a wall is thick.
const REACH_M: f64 = 0.3;
/// Least share of an edge beside a door that makes it an edge of the door: the majority.
const MAJORITY: f64 = 0.5;

/// Cuts the borders along a line at its ends, and notes whether vehicles may pass there.
pub(super) fn door(draft: &mut MapDraft<'_>, line: [Point; 2], is_open: bool, correction: u32) -> Result<(), Failure> {
    draft.settle()?;
    let stretches: Vec<[Point; 2]> =
        draft.subdivision.edges().filter_map(|edge| stretch(&draft.subdivision, edge, line)).collect();
    if stretches.is_empty() {
        let message = "no border between two faces runs along this line: draw it on the border, from jamb to jamb";
        return Err(Failure::unfit("/line", message));
    }
    let mut pieces = draft.pieces().clone();
    pieces.draw(&stretches, &draft.watch)?;
    let cut = pieces.subdivision(&draft.watch)?;
    draft.adopt(cut, |face| face)?;
    draft.doors.push(DoorMark { line, is_open, correction });
    Ok(())
}

/// The edges of a door, ascending.
pub(super) fn edges_along(subdivision: &Subdivision, line: [Point; 2]) -> Vec<EdgeId> {
    let is_beside = |edge: &EdgeId| {
        let beside = stretch(subdivision, *edge, line);
        beside.is_some_and(|[start, end]| (end - start).norm() >= MAJORITY * subdivision.length(*edge))
    };
    subdivision.edges().filter(is_beside).collect()
}

/// The part of an edge between two faces that runs beside a line; `None` where it does not, or crosses it only.
fn stretch(subdivision: &Subdivision, edge: EdgeId, line: [Point; 2]) -> Option<[Point; 2]> {
    let ends = subdivision.segment(edge);
    let is_near = Bounds::around(&line).grown(REACH_M).meets(&Bounds::around(&ends));
    if !is_near || subdivision.sides(edge).contains(&FaceId::OUTER) {
        return None;
    }
    let mut shares = line.map(|jamb| segment::share_of_nearest(jamb, ends));
    shares.sort_by(f64::total_cmp);
    let [start, end] = shares.map(|share| ends[0] + (ends[1] - ends[0]) * share);
    let is_beside = [start, end].iter().all(|&point| segment::distance(point, line) < REACH_M);
    // A border across the line is as long beside it as it is near to it.
    let along = (end - start).dot(&(line[1] - line[0])).abs();
    let runs_along = along > MAJORITY * (end - start).norm() * (line[1] - line[0]).norm();
    (is_beside && runs_along).then_some([start, end])
}
