//! Whether the layers of a group share their storage lanes.
//!
//! The storage lanes of block storage and of most deep racks run through all layers. These layers are cut together, and
//! each helps where another is too empty. But racks stand behind racks as well, each with its own phase and pitch; if they
//! are cut together, neither is cut right. So each layer is first cut by itself, with a load template that all layers have
//! in common, and the offset of its goods from those behind them is measured. The mean cosine of the offsets, a pitch
//! being a full turn (mean resultant of directions, K. V. Mardia 1972), is near 1 where storage lanes are shared and near
//! 0 where they are not:
//!
//! | generated sites | mean cosine |
//! | --- | --- |
//! | with storage lanes | 0.9 to 1.0 |
//! | without | -0.9 to 0.35 |
//!
//! Layers that the cosine does not join are still joined where separate pitches do not repay their description length
//! ([`crate::decomposition::likelihood`]). A layer whose goods hide everything has the storage lanes of the layer before.
//!
//! Cost: O(cells of the groups x pitches).

use std::f64::consts::TAU;
use std::ops::Range;

use rayon::prelude::*;

use super::evidence::RowEvidence;
use super::row_model::RowModel;
use super::row_set::{PITCH_COST, RowSet};
use crate::watch::{Stopped, Watch};

/// Mean cosine above which storage lanes are shared: half-way between 0 and 1.
const SHARED: f64 = 0.5;
/// Weight of the prior that storage lanes are shared, in pairs of goods that stand exactly behind one another.
const PRIOR_PAIRS: f64 = 4.0;

/// For each of some groups, given as the evidence of their layers, how many layers in a row share their storage lanes,
/// from the first on; `pitches` are those that are tried, metres.
pub(super) fn shared(
    groups: &[Vec<RowEvidence>],
    pitches: &[f64],
    watch: &Watch<'_>,
) -> Result<Vec<Vec<usize>>, Stopped> {
    let layers: Vec<&RowEvidence> = groups.iter().filter(|layers| layers.len() > 1).flatten().collect();
    let Some(model) = (RowSet { rows: layers, pitches: pitches.to_vec() }).common_model(watch)? else {
        return Ok(groups.iter().map(|layers| vec![layers.len()]).collect());
    };
    groups.par_iter().map(|layers| LayerFits::of(layers, &model, pitches, watch)?.shared()).collect()
}

/// The layers of a group, each with the model at the pitch that fits it best.
struct LayerFits<'a> {
    layers: &'a [RowEvidence],
    own: Vec<RowModel>,
    common: &'a RowModel,
    pitches: &'a [f64],
    watch: &'a Watch<'a>,
}

impl<'a> LayerFits<'a> {
    fn of(
        layers: &'a [RowEvidence],
        common: &'a RowModel,
        pitches: &'a [f64],
        watch: &'a Watch<'a>,
    ) -> Result<Self, Stopped> {
        let fitted = if layers.len() > 1 { layers } else { &[] };
        let own = fitted.iter().map(|layer| common.fitted(layer, pitches, watch)).collect::<Result<_, _>>()?;
        Ok(Self { layers, own, common, pitches, watch })
    }

    /// All layers, or else each with the one before it wherever these two share their storage lanes.
    fn shared(&self) -> Result<Vec<usize>, Stopped> {
        let count = self.layers.len();
        if count < 2 || self.is_shared(0..count)? {
            return Ok(vec![count]);
        }
        let mut counts = vec![1];
        for layer in 1..count {
            // Two layers are all of them, which are known not to share.
            let is_shared = count > 2 && self.is_shared(layer - 1..layer + 1)?;
            match counts.last_mut() {
                Some(last) if is_shared => *last += 1,
                _ => counts.push(1),
            }
        }
        Ok(counts)
    }

    fn is_shared(&self, range: Range<usize>) -> Result<bool, Stopped> {
        let (layers, own) = (&self.layers[range.clone()], &self.own[range]);
        let others = layers.len() as f64 - 1.0;
        let cosines = cosines(layers, own);
        if cosines.iter().sum::<f64>() + PRIOR_PAIRS >= SHARED * (cosines.len() as f64 + PRIOR_PAIRS) {
            return Ok(true);
        }
        let bundle = RowEvidence::bundle(layers.iter().cloned());
        let together = self.common.best_fit(&bundle, self.pitches, self.watch)?;
        let apart: f64 = own.iter().zip(layers).map(|(model, layer)| model.fit(layer).score).sum();
        // The borders of a bundle are the mean of those of its layers.
        Ok(apart - (together.score + others * together.structure) <= others * PITCH_COST)
    }
}

/// Cosines of the offsets between the goods of each layer and the nearest goods behind, each layer cut with its own
/// model.
fn cosines(layers: &[RowEvidence], own: &[RowModel]) -> Vec<f64> {
    let goods: Vec<Vec<usize>> = own.iter().zip(layers).map(|(model, layer)| model.goods_in(layer)).collect();
    let of_pair = |(pair, model): (&[Vec<usize>], &RowModel)| -> Vec<f64> {
        let pitch = model.pitch / layers[0].cell;
        let turn = |twice: &usize| {
            let turn = distance_to_nearest(&pair[1], *twice)? as f64 / (2.0 * pitch);
            Some(turn).filter(|turn| *turn <= 0.5)
        };
        pair[0].iter().filter_map(turn).map(|turn| (TAU * turn).cos()).collect()
    };
    goods.windows(2).zip(own).flat_map(of_pair).collect()
}

/// Distance from a number to the nearest of some ascending ones.
fn distance_to_nearest(ascending: &[usize], number: usize) -> Option<usize> {
    let next = ascending.partition_point(|&other| other < number);
    let near = [next.checked_sub(1), Some(next)].into_iter().flatten();
    near.filter_map(|at| ascending.get(at)).map(|other| other.abs_diff(number)).min()
}

#[cfg(test)]
mod tests {
    use super::super::row_model;
    use super::*;
    use crate::decomposition::ground::{Axis, RegionFrame};

    /// How many layers in a row, drawn in cells of 5 cm, share their storage lanes.
    fn check(layers: &[&str], wanted: &[usize]) {
        let evidence = |row: &&str| {
            let (frame, rect) = RegionFrame::of_picture(&format!("{row}\n").repeat(20), 0.05);
            RowEvidence::of(&frame.patch(&rect, Axis::U), frame.cell, [0.7, 1.8])
        };
        let group = layers.iter().map(evidence).collect();
        let found = shared(&[group], &row_model::pitches([0.8, 1.6]), &Watch::unwatched());
        assert_eq!(found.expect("nobody stops it"), [wanted]);
    }

    const FULL: &str = "..################..";
    const EMPTY: &str = "....................";

    #[test]
    fn goods_behind_goods_share_lanes() {
        let half = &EMPTY[..10];
        let front = [FULL, EMPTY, FULL, FULL, EMPTY, FULL, FULL, half].concat();
        let behind = [FULL, FULL, FULL, FULL, FULL, EMPTY, FULL].concat();
        let [aligned, shifted] = [[&behind, half].concat(), [half, &behind].concat()];
        check(&[&front, &aligned], &[2]);
        check(&[&front, &shifted], &[1, 1]);
        check(&[EMPTY, EMPTY], &[2]);
    }

    #[test]
    fn a_layer_that_shows_nothing_takes_the_lanes_before_it() {
        let front = [FULL, EMPTY, FULL, FULL, EMPTY, FULL, FULL, &EMPTY[..10]].concat();
        let behind = [&EMPTY[..10], FULL, FULL, FULL, FULL, FULL, EMPTY, FULL].concat();
        check(&[&front, &behind, &"?".repeat(front.len())], &[1, 2]);
    }

    #[test]
    fn the_nearest_number_may_lie_on_either_side() {
        let distances = [0, 4, 6, 7, 20].map(|number| distance_to_nearest(&[4, 8, 9], number));
        assert_eq!(distances, [Some(4), Some(0), Some(2), Some(1), Some(11)]);
        assert_eq!(distance_to_nearest(&[], 3), None);
    }
}
