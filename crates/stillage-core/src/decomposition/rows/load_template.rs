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

use super::comb::{self, Comb, Lanes};
use super::evidence::Evidence;

/// What energy that the shape leaves unexplained costs: something with a third of its energy in the shape is as
/// likely no goods at all.
const MISFIT_COST: f32 = 0.3;

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

    fn reach(&self) -> usize {
        self.half.len()
    }
}

/// Energy of the content of a row that each of some goods of one width explains, less the cost of what it does not, by
/// twice the middle of their place, cells.
pub(super) fn explained<const N: usize>(goods: [&Goods; N], row: &Evidence) -> Vec<Lanes<N>> {
    let reach = goods.iter().map(|goods| goods.reach()).min().unwrap_or(0);
    let half: Vec<Lanes<N>> = (0..reach).map(|distance| goods.map(|goods| goods.half[distance] as f32)).collect();
    let square = |goods: &Goods| (2.0 * goods.half.iter().map(|value| value * value).sum::<f64>()) as f32;
    let per_square = goods.map(|goods| 1.0 / square(goods).max(f32::MIN_POSITIVE));
    let mut whole: Vec<Lanes<N>> = vec![[0.0; N]; row.len() + 1];
    for content in row.contents() {
        add_explained(&mut whole, content, &half, per_square);
    }
    let mut twice = Vec::with_capacity(2 * row.len() + 1);
    for (one, next) in whole.iter().zip(whole.iter().skip(1)) {
        twice.push(*one);
        twice.push(std::array::from_fn(|lane| 0.5 * (one[lane] + next[lane])));
    }
    twice.extend(whole.last());
    twice
}

/// Adds what goods of a half shape explain of a content, by the middle of their place.
fn add_explained<const N: usize>(sums: &mut [Lanes<N>], content: &[f64], half: &[Lanes<N>], per_square: Lanes<N>) {
    let reach = half.len();
    let mut padded = vec![0.0; content.len() + 2 * reach];
    padded.iter_mut().skip(reach).zip(content).for_each(|(padded, &content)| *padded = content as f32);
    let energies = padded.iter().scan(0.0, |sum, &content| {
        *sum += f64::from(content * content);
        Some(*sum)
    });
    let energies: Vec<f64> = std::iter::once(0.0).chain(energies).collect();
    for (middle, sum) in sums.iter_mut().enumerate() {
        let (before, after) = padded[middle..middle + 2 * reach].split_at(reach);
        let mut product = [0.0; N];
        for ((before, after), half) in before.iter().rev().zip(after).zip(half) {
            product = std::array::from_fn(|lane| product[lane] + half[lane] * (before + after));
        }
        let energy = (energies[middle + 2 * reach] - energies[middle]) as f32;
        for lane in 0..N {
            let explained = product[lane] * product[lane] * per_square[lane];
            let missed = energy - explained;
            sum[lane] += explained - MISFIT_COST * if missed > 0.0 { missed } else { 0.0 };
        }
    }
}

/// Twice the middles of the places of a row, cells.
pub(super) fn middles(comb: &Comb) -> impl Iterator<Item = usize> {
    comb.places().map(|place| place.start + place.end)
}
