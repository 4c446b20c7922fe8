//! What goods look like along their row, and what a place scores that holds them.
//!
//! The loads of a site are alike, so the content of its places repeats one shape: three columns of blocks, three
//! stringers, the front of a load. The shape is learnt from the places of a first guess, as the mean of their content
//! weighted by its amplitude, which turn by turn approaches its first principal component. It is then used as a matched
//! filter: a place gains the energy of its content that the shape explains, and loses a part of what it does not explain.
//! Goods that are cut in two, guards and walls are explained badly, whatever the gaps beside them; empty places gain and
//! lose nothing. Goods stand in the middle of their place, so the shape is even.
//!
//! Source: matched filters (D. O. North 1943, reprinted Proc. IEEE 51, 1963, doi 10.1109/PROC.1963.2383); the even shape
//! that is learnt by turns with the places is ours. Cost: O(cells of the row x cells of a place).

use super::comb::{self, Comb, Simd};
use super::evidence::RowEvidence;

/// Cost of energy that the shape leaves unexplained: content with about a quarter of its energy in the shape scores
/// nothing.
const MISFIT_COST: f32 = 0.3;

/// The shape of goods in their place; its norm does not matter.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LoadTemplate {
    /// Content by distance from the middle, cells, the same to both sides.
    half: Vec<f64>,
}

impl LoadTemplate {
    /// Learns the shape of goods in places at a pitch, metres, from rows with twice the middles and the weights of their
    /// places. It is no wider than the narrowest place, so that no content is explained twice.
    pub(super) fn learn<'a>(rows: impl IntoIterator<Item = (&'a RowEvidence, &'a [(usize, f64)])>, pitch: f64) -> Self {
        let mut half = Vec::new();
        for (row, places) in rows {
            half.resize(reach(pitch, row.cell), 0.0);
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

    /// The same goods in places at another pitch, metres.
    pub(super) fn at(&self, pitch: f64, cell: f64) -> Self {
        let mut half = self.half.clone();
        half.resize(reach(pitch, cell), 0.0);
        Self { half }
    }
}

/// Half the width of a template for places at a pitch, cells.
fn reach(pitch: f64, cell: f64) -> usize {
    ((pitch - comb::NARROWER_M) / cell / 2.0) as usize
}

/// Energy of the content of a row that each of some templates of one width explains, less the cost of what it does not,
/// by twice the middle of the place, cells.
pub(super) fn explained<const N: usize>(templates: [&LoadTemplate; N], row: &RowEvidence) -> Vec<Simd<N>> {
    let reach = templates.iter().map(|template| template.half.len()).min().unwrap_or(0);
    let half: Vec<Simd<N>> =
        (0..reach).map(|distance| templates.map(|template| template.half[distance] as f32)).collect();
    let square = |template: &LoadTemplate| (2.0 * template.half.iter().map(|value| value * value).sum::<f64>()) as f32;
    let per_square = templates.map(|template| 1.0 / square(template).max(f32::MIN_POSITIVE));
    let mut whole: Vec<Simd<N>> = vec![[0.0; N]; row.len() + 1];
    for content in row.contents() {
        add_explained(&mut whole, content, &half, per_square);
    }
    let mut twice = Vec::with_capacity(2 * row.len() + 1);
    for (one, next) in whole.iter().zip(whole.iter().skip(1)) {
        twice.push(*one);
        twice.push(std::array::from_fn(|hypothesis| 0.5 * (one[hypothesis] + next[hypothesis])));
    }
    twice.extend(whole.last());
    twice
}

/// Adds what templates explain of a content, by the middle of the place; `half` holds their values by distance from it.
fn add_explained<const N: usize>(sums: &mut [Simd<N>], content: &[f64], half: &[Simd<N>], per_square: Simd<N>) {
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
            product = std::array::from_fn(|hypothesis| product[hypothesis] + half[hypothesis] * (before + after));
        }
        let energy = (energies[middle + 2 * reach] - energies[middle]) as f32;
        for hypothesis in 0..N {
            let explained = product[hypothesis] * product[hypothesis] * per_square[hypothesis];
            let missed = energy - explained;
            sum[hypothesis] += explained - MISFIT_COST * if missed > 0.0 { missed } else { 0.0 };
        }
    }
}

/// Twice the middles of the places of a row, cells, ascending.
pub(super) fn middles(comb: &Comb) -> impl Iterator<Item = usize> {
    comb.places().map(|place| place.start + place.end)
}
