//! By which shifts a turned map may lie on another.
//!
//! Method: cross-correlation of two overviews over all shifts by Fourier transforms; its maxima. Cost: two transforms
//! for each turn. Limits: shifts nearer than [`APART_M`] are one.

use rayon::prelude::*;

use super::overview::Overview;
use crate::fourier::{Fourier, Spectrum};
use crate::geometry::{RigidMotion, Vector};
use crate::watch::{Stopped, Watch};

/// Least distance of two shifts of one turn, metres: below the pitch of any rack.
const APART_M: f64 = 0.7;
/// Shifts that are kept for each turn: a hall has about as many aisles that fit.
const PER_TURN: usize = 12;

/// The motions of the first overview onto the second, by turn, best first.
pub(super) fn candidates(
    from: &Overview,
    to: &Overview,
    turns: &[f64],
    watch: &Watch<'_>,
) -> Result<Vec<RigidMotion>, Stopped> {
    let diagonal = (from.width as f64).hypot(from.height as f64).ceil() as usize + 2;
    let fourier = Fourier::at_least(to.width + diagonal, to.height + diagonal);
    let target = fourier.forward(&to.values, to.width);
    let of_turn = |&turn: &f64| {
        watch.check()?;
        Ok(of_turn(&from.turned(turn), to, turn, &fourier, &target))
    };
    let found: Vec<Vec<RigidMotion>> = turns.par_iter().map(of_turn).collect::<Result<_, Stopped>>()?;
    Ok(found.concat())
}

fn of_turn(turned: &Overview, to: &Overview, turn: f64, fourier: &Fourier, target: &Spectrum) -> Vec<RigidMotion> {
    let correlation = fourier.correlation(target, &fourier.forward(&turned.values, turned.width));
    let size = fourier.size();
    let shift = |index: usize| {
        let signed =
            |at: usize, size: usize, ahead: usize| if at < ahead { at as f64 } else { at as f64 - size as f64 };
        Vector::new(signed(index % size[0], size[0], to.width), signed(index / size[0], size[1], to.height))
    };
    let mut kept: Vec<Vector> = Vec::new();
    for index in maxima(&correlation, size) {
        let candidate = shift(index);
        if kept.iter().all(|other| (candidate - other).norm() * to.cell >= APART_M) {
            kept.push(candidate);
        }
        if kept.len() == PER_TURN {
            break;
        }
    }
    let base = to.low - turned.low;
    kept.into_iter().map(|shift| RigidMotion { shift: base + shift * to.cell, turn }).collect()
}

/// Indices of the values above zero that none of the four beside them exceeds, highest first.
fn maxima(values: &[f32], [width, height]: [usize; 2]) -> Vec<usize> {
    let at = |column: usize, row: usize| values[(row % height) * width + column % width];
    let is_maximum = |&index: &usize| {
        let (column, row, value) = (index % width, index / width, values[index]);
        let beside = [(column + 1, row), (column + width - 1, row), (column, row + 1), (column, row + height - 1)];
        value > 0.0 && beside.into_iter().all(|(column, row)| at(column, row) <= value)
    };
    let mut found: Vec<usize> = (0..values.len()).filter(is_maximum).collect();
    found.sort_by(|&one, &other| values[other].total_cmp(&values[one]).then(one.cmp(&other)));
    found
}
