//! The borders of parcels as lines that end where the parcels do.
//!
//! The sides of the parcels of a region are grouped by their offset; sides that touch or overlap are united. So no two
//! segments of the result cover each other, and every border between two parcels is there once. Cost: O(p log p) for p
//! parcels, and O(cells along the lines).

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use super::ground::{Axis, RegionFrame};
use super::parcel::Parcel;
use crate::geometry::fold_half_turn;
use crate::line::Line;
use crate::watch::{Stopped, Watch};

/// The borders of the parcels of a region.
pub(super) fn of_parcels(
    frame: &RegionFrame,
    region: u8,
    parcels: &[Parcel],
    watch: &Watch<'_>,
) -> Result<Vec<Line>, Stopped> {
    let mut lines = Vec::new();
    for axis in Axis::BOTH {
        let mut sides: BTreeMap<usize, Vec<[usize; 2]>> = BTreeMap::new();
        for parcel in parcels {
            let (along, across) = (parcel.rect.range(axis), parcel.rect.range(axis.other()));
            for offset in [across.start, across.end] {
                sides.entry(offset).or_default().push([along.start, along.end]);
            }
        }
        for (offset, sides) in sides {
            watch.check()?;
            lines.push(line(frame, region, axis, offset, &united(sides)));
        }
    }
    Ok(lines)
}

/// Unites ranges that touch or overlap.
fn united(mut ranges: Vec<[usize; 2]>) -> Vec<[usize; 2]> {
    ranges.sort_unstable();
    let mut united: Vec<[usize; 2]> = Vec::new();
    for [start, end] in ranges {
        match united.last_mut() {
            Some(last) if start <= last[1] => last[1] = last[1].max(end),
            _ => united.push([start, end]),
        }
    }
    united
}

/// The line at an offset along `axis`, with the ranges of cells where it runs.
fn line(frame: &RegionFrame, region: u8, axis: Axis, offset: usize, ranges: &[[usize; 2]]) -> Line {
    let at = |side: usize, cells: usize| frame.start[side] + cells as f64 * frame.cell;
    let occupied = ranges.iter().map(|&range| occupied_beside(frame, axis, offset, range)).sum::<usize>();
    // Along u the normal points along v; along v it points against u.
    let (orientation, offset, along) = match axis {
        Axis::U => (frame.angle, at(1, offset), 0),
        Axis::V => (frame.angle + FRAC_PI_2, -at(0, offset), 1),
    };
    let folded = fold_half_turn(orientation);
    let turns_around = (orientation - folded).abs() > FRAC_PI_2;
    let extent = |&[start, end]: &[usize; 2]| {
        let (start, end) = (at(along, start), at(along, end));
        if turns_around { [-end, -start] } else { [start, end] }
    };
    let mut extents: Vec<[f64; 2]> = ranges.iter().map(extent).collect();
    extents.sort_by(|one, other| one[0].total_cmp(&other[0]));
    Line {
        region,
        orientation: folded,
        offset: if turns_around { -offset } else { offset },
        support: occupied as f64 * frame.cell,
        extents,
    }
}

/// Number of cells along a range with an occupied one on either side of it.
fn occupied_beside(frame: &RegionFrame, axis: Axis, offset: usize, [start, end]: [usize; 2]) -> usize {
    let is_occupied = |along: usize, across: usize| {
        let (u, v) = if axis == Axis::U { (along, across) } else { (across, along) };
        u < frame.columns && v < frame.rows && frame.row(v)[u].is_occupied()
    };
    (start..end).filter(|&along| (offset.saturating_sub(1)..=offset).any(|across| is_occupied(along, across))).count()
}
