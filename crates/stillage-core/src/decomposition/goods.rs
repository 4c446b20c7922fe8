//! What goods look like along their row, and what a place earns that holds them.
//!
//! Pallets of a site are alike, so the content of its places repeats one shape: three columns of blocks, three stringers,
//! the front of a load. The shape is learnt from the places of a first guess, as their first principal component, and
//! then sought as a matched filter: a place earns the energy of its content that the shape explains, and pays for some
//! of what it does not. Goods that are cut in two, guards and walls are explained badly, whatever the gaps beside them
//! say; empty places earn nothing and cost nothing. Goods stand in the middle of their place, so the shape is even.
//!
//! Source: matched filters (D. O. North 1943, reprinted Proc. IEEE 51, 1963, doi 10.1109/PROC.1963.2383); the even shape
//! that is learnt by turns with the cuts is ours. Cost: O(cells of the row x cells of a place).

use super::comb::{self, Comb};
use super::evidence::Evidence;

/// What energy that the shape leaves unexplained costs: something with a third of its energy in the shape is as
/// likely no goods at all.
const MISFIT_COST: f64 = 0.3;

/// The shape of goods in their place, of a length that is of no account.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Goods {
    /// Content by distance from the middle, cells, the same to both sides.
    half: Vec<f64>,
}

impl Goods {
    /// Learns the shape of goods in places of a pitch, cells: the rows, with the doubled middles and the weights of their
    /// places. It is no wider than the narrowest place, so that no content is explained twice.
    pub(super) fn learn<'a>(rows: impl IntoIterator<Item = (&'a Evidence, &'a [(usize, f64)])>, pitch: f64) -> Self {
        let mut half = Vec::new();
        for (row, places) in rows {
            half.resize(((pitch - comb::NARROWER_M) / row.cell / 2.0) as usize, 0.0);
            let places = row.contents().flat_map(|content| places.iter().map(move |place| (content, place)));
            for (content, &(twice, weight)) in places {
                for middle in [twice / 2, twice.div_ceil(2)] {
                    for (distance, sum) in half.iter_mut().enumerate() {
                        let after = content.get(middle + distance).copied().unwrap_or(0.0);
                        let before = middle.checked_sub(distance + 1).and_then(|at| content.get(at));
                        *sum += weight * (after + before.copied().unwrap_or(0.0));
                    }
                }
            }
        }
        Self { half }
    }

    /// The same goods in places of another pitch, metres.
    pub(super) fn at(&self, pitch: f64, cell: f64) -> Self {
        let mut half = self.half.clone();
        half.resize(((pitch - comb::NARROWER_M) / cell / 2.0) as usize, 0.0);
        Self { half }
    }

    /// Energy of the content of a row that goods explain, less the cost of what they do not, by twice the middle of
    /// their place, cells.
    pub(super) fn explained(&self, row: &Evidence) -> Vec<f64> {
        let reach = self.half.len();
        let mut sum = vec![0.0; row.len() + 1];
        for of_row in row.contents() {
            let mut content = vec![0.0; row.len() + 2 * reach];
            content[reach..reach + row.len()].copy_from_slice(of_row);
            let square = (2.0 * self.half.iter().map(|value| value * value).sum::<f64>()).max(f64::MIN_POSITIVE);
            let at_middle = |middle: usize| {
                let (before, after) = content[middle..middle + 2 * reach].split_at(reach);
                let (mut product, mut energy) = (0.0, 0.0);
                for ((before, after), value) in before.iter().rev().zip(after).zip(&self.half) {
                    product += value * (before + after);
                    energy += before * before + after * after;
                }
                let explained = product * product / square;
                explained - MISFIT_COST * (energy - explained).max(0.0)
            };
            sum.iter_mut().enumerate().for_each(|(middle, sum)| *sum += at_middle(middle));
        }
        let whole = sum;
        (0..=2 * row.len()).map(|twice| f64::midpoint(whole[twice / 2], whole[twice.div_ceil(2)])).collect()
    }
}

/// Twice the middles of the places of a row, cells.
pub(super) fn middles(comb: &Comb) -> impl Iterator<Item = usize> {
    comb.places().map(|place| place.start + place.end)
}
