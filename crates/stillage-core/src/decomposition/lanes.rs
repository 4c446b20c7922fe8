//! Whether the layers of a stack share their lanes.
//!
//! Lanes of block storage and of most deep racks run through all layers, so these are cut together, and each helps the
//! others where it is too empty to tell. Yet racks stand behind racks as well, each with its own phase and pitch: cut
//! together, neither is cut right. So each layer is cut by itself, with goods that all layers have in common. Where lanes
//! are shared, goods stand one behind the other, off by little; where they are not, they are off by anything up to half a
//! pitch. The mean cosine of what they are off, a pitch being a full turn, is near one or near zero (mean resultant of
//! directions, K. V. Mardia 1972). Measured on generated sites: 0.9 to 1.0 with lanes, and -0.9 to 0.35 without. And
//! pitches of their own must pay for themselves (minimum description length, J. Rissanen 1978, doi
//! 10.1016/0005-1098(78)90005-5).
//!
//! Cost: O(cells of the stacks x pitches). Limits: all layers of a stack, or none.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::evidence::Evidence;
use super::reading::{PITCH_PRICE, Reading, Rows};

/// Mean cosine above which lanes are shared: half-way.
const SHARED: f64 = 0.5;
/// Lanes are shared as a rule: that says as much as so many pairs of goods that stand one behind the other.
const PRIOR_PAIRS: f64 = 4.0;

/// For each of some stacks, given as the evidence of their layers, whether its lanes run through all layers; `pitches` are
/// those that are tried, metres.
pub(super) fn are_shared(stacks: &[Vec<Evidence>], pitches: &[f64]) -> Vec<bool> {
    let layers: Vec<&Evidence> = stacks.iter().filter(|layers| layers.len() > 1).flatten().collect();
    let Some(reading) = (Rows { rows: layers, pitches: pitches.to_vec() }).in_common() else {
        return vec![true; stacks.len()];
    };
    stacks.par_iter().map(|layers| is_shared(layers, &reading, pitches)).collect()
}

fn is_shared(layers: &[Evidence], reading: &Reading, pitches: &[f64]) -> bool {
    let others = layers.len().saturating_sub(1) as f64;
    if others == 0.0 {
        return true;
    }
    let own: Vec<Reading> = layers.iter().map(|layer| reading.fitted(layer, pitches)).collect();
    let cosines = cosines(layers, &own);
    if cosines.iter().sum::<f64>() + PRIOR_PAIRS >= SHARED * (cosines.len() as f64 + PRIOR_PAIRS) {
        return true;
    }
    let (together, borders) = reading.best_fit(&Evidence::bundle(layers.iter().cloned()), pitches);
    let apart: f64 = own.iter().zip(layers).map(|(reading, layer)| reading.fit(layer).0).sum();
    // The borders of a bundle are the mean of those of its layers.
    apart - (together + others * borders) <= others * PITCH_PRICE
}

/// Cosines of what the goods of each layer, read in its own way, are off those behind them.
fn cosines(layers: &[Evidence], own: &[Reading]) -> Vec<f64> {
    let goods: Vec<Vec<usize>> = own.iter().zip(layers).map(|(reading, layer)| reading.goods_in(layer)).collect();
    let of_pair = |(pair, reading): (&[Vec<usize>], &Reading)| -> Vec<f64> {
        let pitch = reading.pitch / layers[0].cell;
        let turn = |twice: &usize| {
            let nearest = pair[1].iter().map(|behind| behind.abs_diff(*twice)).min()?;
            Some(nearest as f64 / (2.0 * pitch)).filter(|turn| *turn <= 0.5)
        };
        pair[0].iter().filter_map(turn).map(|turn| (TAU * turn).cos()).collect()
    };
    goods.windows(2).zip(own).flat_map(of_pair).collect()
}

#[cfg(test)]
mod tests {
    use super::super::frame::{Axis, Frame};
    use super::super::reading;
    use super::*;

    /// Whether two layers, drawn in cells of 5 cm, share their lanes.
    fn check(front: &str, behind: &str) -> bool {
        let layers = [front, behind].map(|row| {
            let (frame, rect) = Frame::of_picture(&format!("{row}\n").repeat(20), 0.05);
            Evidence::of(&frame.patch(&rect, Axis::U), frame.cell, [0.7, 1.8])
        });
        are_shared(&[layers.into()], &reading::pitches([0.8, 1.6]))[0]
    }

    const FULL: &str = "..################..";
    const EMPTY: &str = "....................";

    #[test]
    fn goods_behind_goods_share_lanes() {
        let half = &EMPTY[..10];
        let front = [FULL, EMPTY, FULL, FULL, EMPTY, FULL, FULL, half].concat();
        let behind = [FULL, FULL, FULL, FULL, FULL, EMPTY, FULL].concat();
        assert!(check(&front, &[&behind, half].concat()));
        assert!(!check(&front, &[half, &behind].concat()));
        assert!(check(EMPTY, EMPTY));
    }
}
