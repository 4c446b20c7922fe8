//! Whether the layers of stacks share their lanes.
//!
//! Lanes of block storage and of most deep racks run through all layers, so these are cut together, and each helps the
//! others where it is too empty to tell. Yet racks stand behind racks as well, each with its own phase and pitch: cut
//! together, neither is cut right. So each layer is cut by itself first, with goods that all layers have in common. Where
//! lanes are shared, goods stand one behind the other, off by little; where they are not, they are off by anything up to
//! half a pitch. The mean cosine of what they are off, a pitch being a full turn, is near one or near zero (mean resultant
//! of directions, K. V. Mardia 1972). Measured on generated sites: 0.9 to 1.0 with lanes, and -0.9 to 0.25 without.
//!
//! Cost: O(cells of the stacks x pitches). Limits: one answer for all stacks of a direction.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::evidence::Evidence;
use super::reading::{Reading, Rows};

/// Mean cosine above which lanes are shared: half-way.
const SHARED: f64 = 0.5;

/// Whether the lanes of stacks, given as the evidence of their layers, run through all layers; `pitches` are those that are
/// tried, metres.
pub(super) fn are_shared(stacks: &[&[Evidence]], pitches: &[f64]) -> bool {
    let layers: Vec<&Evidence> = stacks.iter().copied().flatten().collect();
    let Some(reading) = (Rows { rows: &layers, pitches: pitches.to_vec() }).in_common() else { return true };
    let cosines: Vec<f64> = stacks.par_iter().flat_map_iter(|layers| cosines(layers, &reading, pitches)).collect();
    cosines.iter().sum::<f64>() >= SHARED * cosines.len() as f64
}

/// Cosines of what the goods of each layer are off those behind them.
fn cosines(layers: &[Evidence], reading: &Reading, pitches: &[f64]) -> Vec<f64> {
    let cut = |layer: &Evidence| {
        let own = reading.fitted(layer, pitches);
        (own.pitch / layer.cell, own.goods_in(layer))
    };
    let cuts: Vec<(f64, Vec<usize>)> = layers.iter().map(cut).collect();
    let of_pair = |pair: &[(f64, Vec<usize>)]| -> Vec<f64> {
        let [(pitch, goods), (_, behind)] = pair else { return Vec::new() };
        let turn = |twice: &usize| {
            let nearest = behind.iter().map(|other| other.abs_diff(*twice)).min()?;
            Some(nearest as f64 / (2.0 * pitch)).filter(|turn| *turn <= 0.5)
        };
        goods.iter().filter_map(turn).map(|turn| (TAU * turn).cos()).collect()
    };
    cuts.windows(2).flat_map(of_pair).collect()
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
        are_shared(&[&layers], &reading::pitches([0.8, 1.6]))
    }

    const FULL: &str = "..#######..#######..";
    const EMPTY: &str = "....................";

    #[test]
    fn goods_behind_goods_share_lanes() {
        let front = [FULL, EMPTY, FULL, FULL, EMPTY, FULL, FULL].concat();
        let behind = [FULL, FULL, EMPTY, FULL, FULL, EMPTY, FULL].concat();
        assert!(check(&front, &behind));
        assert!(!check(&front, &["..........", &behind[10..], &behind[..10]].concat()));
        assert!(check(EMPTY, EMPTY));
    }
}
