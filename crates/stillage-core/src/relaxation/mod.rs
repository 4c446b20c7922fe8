//! Probabilistic relaxation: neighbours settle on categories that go together.
//!
//! Source: A. Rosenfeld, R. Hummel and S. Zucker, *Scene labeling by relaxation operations* (1976,
//! doi 10.1109/TSMC.1976.4309519), as O. Mozos uses it on place maps (the paper's \[6\]). Each node has a distribution p
//! over the categories. Its neighbours' distributions support category l by q(l) = sum over neighbours j, weights c, of
//! c(j) r(l, l') p(j, l'), and p(l) becomes p(l) (1 + q(l)), over the sum of these.
//!
//! The compatibility r of two categories is H. Yamamoto's (1979): 1 certain neighbours, 0 independent, -1 never seen
//! together, from how often they are. Departure: there are no labelled maps to learn that from, so it is counted on
//! this map's own categories before the first iteration. Categories then mostly attract themselves, so on cells this is a
//! smoother that knows which borders are usual; on faces it learns patterns, such as storage along corridors. And
//! because a certain distribution would never move, none begins with less than [`LEAST`] of any category.
//!
//! On [`cells`](relax_cells): neighbours are the eight around, free ones alone. On [`faces`](relax_faces): those across
//! an edge, weighted by its length.
//!
//! Limits: long relaxation lets great categories swallow small ones; a category that nowhere touches itself has no
//! attraction. What it did is reported ([`RelaxationReport`]).

mod cells;
mod faces;

#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

pub use cells::{Lattice, Memberships, relax_cells};
pub use faces::{Adjacency, relax_faces};

/// Least share of a category in a distribution before the first iteration.
const LEAST: f32 = 0.01;

/// Largest change of a share below which relaxation ends (lineage of place labelling: 1e-3).
const REST: f32 = 1e-3;

/// What a relaxation did.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct RelaxationReport {
    /// Cells or faces that have a distribution.
    pub nodes: usize,
    /// How many of them changed their category, by iteration.
    pub changed_by_iteration: Vec<usize>,
    /// How many have another category than before.
    pub changed: usize,
    /// Mean entropy of a distribution before, bits.
    pub entropy_before: f64,
    /// Mean entropy of a distribution after, bits.
    pub entropy_after: f64,
}

/// How well categories go together: row l, column l' is the support that l has from a neighbour l', -1 to 1.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Compatibilities {
    count: usize,
    values: Vec<f32>,
}

impl Compatibilities {
    /// From the weight of neighbours by the category of one (row) and the other (column); symmetric.
    fn from_pairs(pairs: &[f64], count: usize) -> Self {
        let total: f64 = pairs.iter().sum();
        let marginals: Vec<f64> = pairs.chunks_exact(count.max(1)).map(|row| row.iter().sum()).collect();
        let compatibility = |own: usize, other: usize| {
            if marginals[own] <= 0.0 || marginals[other] <= 0.0 {
                // One that has no neighbours tells nothing.
                return 0.0;
            }
            let prior = marginals[own] / total;
            let conditional = pairs[own * count + other] / marginals[other];
            if conditional > prior { (1.0 - prior / conditional) / (1.0 - prior) } else { conditional / prior - 1.0 }
        };
        let values = (0..count * count).map(|at| compatibility(at / count, at % count).clamp(-1.0, 1.0) as f32);
        Self { count, values: values.collect() }
    }

    /// The compatibilities of one category with all.
    fn row(&self, own: usize) -> &[f32] {
        &self.values[own * self.count..(own + 1) * self.count]
    }
}

/// Entropy of shares, bits.
fn entropy(shares: impl Iterator<Item = f32>) -> f64 {
    shares.filter(|&share| share > 0.0).map(|share| f64::from(-share * share.log2())).fold(0.0, |sum, part| sum + part)
}

/// Raises every share to the least one.
fn soften(shares: &mut [f32]) {
    let sum: f32 = shares.iter().map(|share| share.max(LEAST)).sum();
    for share in shares {
        *share = share.max(LEAST) / sum;
    }
}

/// The greatest share, the first of equals.
fn greatest<T: PartialOrd + Copy>(shares: impl Iterator<Item = T>) -> usize {
    let greatest = shares.enumerate().reduce(|best, other| if other.1 > best.1 { other } else { best });
    greatest.map_or(0, |(category, _)| category)
}
