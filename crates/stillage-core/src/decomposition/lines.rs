//! From parcels to lines that know where they end.
//!
//! The sides of the parcels of a region are gathered by their offset; sides that touch or overlap are one stretch. So no
//! two segments of the result cover each other, and every border between two parcels is there once. Cost: O(parcels log
//! parcels).

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use super::ground::{Axis, RegionFrame};
use super::plot::Parcel;
use crate::geometry::fold_half_turn;
use crate::radiography::Line;

/// The borders of the parcels of a region.
pub(super) fn of_parcels(frame: &RegionFrame, region: u8, parcels: &[Parcel]) -> Vec<Line> {
    let mut lines = Vec::new();
    for axis in Axis::BOTH {
        let mut sides: BTreeMap<usize, Vec<[usize; 2]>> = BTreeMap::new();
        for parcel in parcels {
            let (along, across) = (parcel.rect.range(axis), parcel.rect.range(axis.other()));
            for offset in [across.start, across.end] {
                sides.entry(offset).or_default().push([along.start, along.end]);
            }
        }
        for (offset, stretches) in sides {
            let stretches = united(stretches);
            lines.push(line(frame, region, axis, offset, &stretches));
        }
    }
    lines
}

/// Stretches that touch or overlap become one.
fn united(mut stretches: Vec<[usize; 2]>) -> Vec<[usize; 2]> {
    stretches.sort_unstable();
    let mut united: Vec<[usize; 2]> = Vec::new();
    for [start, end] in stretches {
        match united.last_mut() {
            Some(last) if start <= last[1] => last[1] = last[1].max(end),
            _ => united.push([start, end]),
        }
    }
    united
}

fn line(frame: &RegionFrame, region: u8, axis: Axis, offset: usize, stretches: &[[usize; 2]]) -> Line {
    let at = |side: usize, cells: usize| frame.start[side] + cells as f64 * frame.cell;
    let occupied = stretches.iter().map(|&stretch| occupied_beside(frame, axis, offset, stretch)).sum::<usize>();
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
    let mut extents: Vec<[f64; 2]> = stretches.iter().map(extent).collect();
    extents.sort_by(|one, other| one[0].total_cmp(&other[0]));
    Line {
        region,
        orientation: folded,
        offset: if turns_around { -offset } else { offset },
        support: occupied as f64 * frame.cell,
        extents,
    }
}

/// Cells along a stretch with an occupied one on either side of it.
fn occupied_beside(frame: &RegionFrame, axis: Axis, offset: usize, [start, end]: [usize; 2]) -> usize {
    let is_occupied = |along: usize, across: usize| {
        let (u, v) = if axis == Axis::U { (along, across) } else { (across, along) };
        u < frame.columns && v < frame.rows && frame.row(v)[u].is_occupied()
    };
    (start..end).filter(|&along| (offset.saturating_sub(1)..=offset).any(|across| is_occupied(along, across))).count()
}
