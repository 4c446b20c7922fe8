//! Whether the rows of one direction are rows of places, or walls and furniture, which stay whole.
//!
//! A comb fits any row somehow, so its score alone proves little; a row must score better than chance. Each row is
//! compared with copies of itself whose columns were cut into short pieces and shuffled: these have the same posts, gaps
//! and goods, but nothing at a regular distance. The row and its copies are cut with the same model, each at the pitch that
//! fits best. The *excess* of a row is its score less the mean score of its copies. It is positive for places, even where
//! each row has its own pitch and phase and a third of the places are empty; for walls, desks and shelves, which have no
//! load template in common, it is about 0. Layers that share their storage lanes count as one row.
//!
//! The rows of a direction are periodic if their mean excess per metre, less a multiple of its standard error, is above a
//! threshold. The threshold is higher for few rows than for many, and higher where vehicles do not find room along the
//! rows. Where the rows of a direction are several sorts of storage without a template in common, each row is judged with
//! its own model, and the threshold is higher. Where the rows of one direction are clearly periodic, those of the other
//! need less: two racks in the wing of a hall are too few to be certain by themselves.
//!
//! Source: surrogate data (J. Theiler et al. 1992, doi 10.1016/0167-2789(92)90102-S), with block shuffling (H. Künsch
//! 1989, doi 10.1214/aos/1176347265) for the null hypothesis. The thresholds follow from these measurements:
//!
//! | model | maps | mean excess less 1.5 errors | length with room for a vehicle |
//! | --- | --- | --- | --- |
//! | in common | 24 offices, a bookshop and other floors without places | up to 1.4 | up to 0.94 where the excess is above 0.3 |
//! | in common | 150 generated sites | 0.4 to 3 where they are hard, else 1 to 9 | 0.97 and more |
//! | of each row | floors without places | up to 6 | 0.81 to 0.91 |
//! | of each row | sites | 2 to 10 | |
//!
//! Cost: O(pitches x cells) of at most 1 km of rows. Limits: furniture at a regular distance of 0.8 to 1.6 m along several
//! walls is taken for places.

use rayon::prelude::*;

use super::evidence::RowEvidence;
use super::rack_row::RackRow;
use super::row_model::Fit;
use crate::decomposition::ground::{Patch, RegionFrame};
use crate::geometry::hash::split_mix;
use crate::watch::{Stopped, Watch};

/// What the mean excess of rows must reach, logarithms of a likelihood per metre of a layer.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Threshold {
    /// For many rows.
    least: f64,
    /// Added for a single layer, a half of it for two, and so on.
    of_one: f64,
    /// Added for rows that no vehicle finds room along, in proportion for a part of their length.
    blocked: f64,
    /// Standard errors that are subtracted from the mean before it is compared.
    errors: f64,
    /// Length of the rows that are sampled, metres.
    most_length: f64,
}

impl Threshold {
    /// For rows with the model that all have in common. Fifteen of sixteen means are less than 1.5 errors too high.
    pub(super) const COMMON_MODEL: Self =
        Self { least: 0.15, of_one: 2.0, blocked: 10.0, errors: 1.5, most_length: 1000.0 };
    /// For rows with a model each: a piece of furniture resembles itself more than it resembles other furniture.
    pub(super) const OWN_MODELS: Self =
        Self { least: 2.15, of_one: 4.0, blocked: 60.0, errors: 3.0, most_length: 300.0 };
}

/// Surplus over the threshold that no office has, logarithms of a likelihood per metre of a layer.
const SURE_SURPLUS: f64 = 1.25;
/// Weight of borders beside that of loads: furniture has a shape but no borders.
const BORDER_WEIGHT: f64 = 2.0;
/// Shuffled copies of each row.
const SHUFFLES: u64 = 3;
/// Length of the pieces that are shuffled, metres: longer than a post with its gap, shorter than any place.
const PIECE_M: [f64; 2] = [0.25, 0.55];
/// Rows shorter than this are left out, metres: less than two places of the widest kind.
const LEAST_LENGTH_M: f64 = 2.6;
/// Rows with something in them along less than this share of their length are left out.
const GOODS_SHARE: f64 = 0.1;

/// How surely rows are periodic.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Periodicity {
    /// Mean excess per metre of a layer, a logarithm of a likelihood, and its standard error.
    mean: f64,
    error: f64,
    /// Number of layers that were sampled.
    layers: usize,
    /// Share of their length with room for a vehicle on one side.
    open: f64,
    /// Whether nothing stands in any of them.
    is_bare: bool,
    threshold: Threshold,
}

impl Periodicity {
    /// Measures rows, given with the evidence of each. `widths` is the range of places in that evidence, metres; `fit`
    /// is the score of a row at the pitch that fits it best.
    pub(super) fn of(
        frame: &RegionFrame,
        (rows, evidence): (&[RackRow], &[RowEvidence]),
        widths: [f64; 2],
        fit: impl Fn(&RowEvidence) -> Result<Fit, Stopped> + Sync,
        threshold: Threshold,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let all: Vec<usize> = {
            let is_judged = |&row: &usize| evidence[row].length() >= LEAST_LENGTH_M && !evidence[row].is_even;
            (0..rows.len()).filter(is_judged).collect()
        };
        let mut held = Vec::new();
        for &row in &all {
            watch.check()?;
            held.extend(rows[row].patches(frame).any(|layer| holds_goods(&layer)).then_some(row));
        }
        // Bare racks are judged by their posts.
        let is_bare = held.is_empty();
        let long = if is_bare { all } else { held };
        let length: f64 = long.iter().map(|&row| evidence[row].length()).sum();
        let stride = (length / threshold.most_length).ceil().max(1.0) as usize;
        let sample: Vec<usize> = long.into_iter().step_by(stride).collect();
        let score = |row: &RowEvidence| fit(row).map(|fit| fit.score + BORDER_WEIGHT * fit.structure);
        let excess = |&row: &usize| {
            let (real, layers): (_, Vec<Patch>) = (&evidence[row], rows[row].patches(frame).collect());
            let mut chance = 0.0;
            for turn in 0..SHUFFLES {
                let order = shuffled(real.len(), real.cell, row as u64 * SHUFFLES + turn);
                let of_layer = |layer: &Patch| RowEvidence::of(&layer.in_order(&order), real.cell, widths);
                chance += score(&RowEvidence::bundle(layers.iter().map(of_layer)))?;
            }
            // A row below chance is no row of places; how far below is no evidence about the others.
            let total = (score(real)? - chance / SHUFFLES as f64).max(0.0);
            Ok(Excess { total, length: real.length() * layers.len() as f64 })
        };
        let excesses: Vec<Excess> = sample.par_iter().map(excess).collect::<Result<_, _>>()?;
        let layers = sample.iter().map(|&row| evidence[row].contents().count()).sum();
        let sampled: f64 = sample.iter().map(|&row| evidence[row].length()).sum();
        let open = sample.iter().map(|&row| rows[row].open * evidence[row].length()).sum::<f64>();
        Ok(Self {
            layers,
            open: open / sampled.max(f64::MIN_POSITIVE),
            is_bare,
            threshold,
            ..Self::of_excesses(&excesses)
        })
    }

    /// Mean and error from the excess of each row.
    fn of_excesses(rows: &[Excess]) -> Self {
        if rows.is_empty() {
            return Self::default();
        }
        let length: f64 = rows.iter().map(|row| row.length).sum();
        let mean = rows.iter().map(|row| row.total).sum::<f64>() / length;
        let square = |row: &Excess| row.length * (row.total / row.length - mean).powi(2);
        let variance = rows.iter().map(square).sum::<f64>() / length;
        // The spread of few rows is uncertain, so the error of two rows counts twice and that of three by a quarter more.
        // Student's factor (W. S. Gosset 1908, doi 10.1093/biomet/6.1.1) does the same and is larger still.
        let freedom = rows.len().saturating_sub(1).max(1) as f64;
        let error = (variance / freedom).sqrt() * (1.0 + 1.0 / (freedom * freedom));
        Self { mean, error, ..Self::default() }
    }

    /// By how much the mean, less its errors, is above the threshold for many rows.
    fn surplus(&self) -> f64 {
        self.mean - self.threshold.errors * self.error - self.least()
    }

    /// The threshold for many rows.
    fn least(&self) -> f64 {
        self.threshold.least + self.threshold.blocked * (1.0 - self.open)
    }

    /// Whether the rows are periodic, whatever else the map holds.
    pub(super) fn is_certain(&self) -> bool {
        self.layers > 0 && self.surplus() >= self.threshold.of_one / self.layers as f64
    }

    /// Whether they are so more clearly than any furniture, so that the building is a storage.
    pub(super) fn is_sure(&self) -> bool {
        self.is_certain() && self.surplus() >= SURE_SURPLUS
    }

    /// Whether they are rather periodic than not, which is enough in a storage.
    pub(super) fn is_likely(&self) -> bool {
        !self.is_bare && self.mean >= self.least()
    }
}

/// Score of a row less that of its shuffled copies.
#[derive(Debug, Clone, Copy)]
struct Excess {
    total: f64,
    /// Length of all its layers, metres.
    length: f64,
}

/// Whether something stands in the middle of a row, not only at its side as a wall does.
fn holds_goods(row: &Patch) -> bool {
    let middle = row.height / 4..row.height - row.height / 4;
    let is_held = |column: &usize| middle.clone().any(|y| !row.row(y)[*column].is_free());
    (0..row.width).filter(is_held).count() as f64 >= GOODS_SHARE * row.width as f64
}

/// The columns of a row in another order: cut into short pieces, and these shuffled.
fn shuffled(width: usize, cell: f64, seed: u64) -> Vec<usize> {
    let mut random = (0_u64..).map(|turn| split_mix(split_mix(seed) ^ turn));
    let mut below = |limit: usize| random.next().unwrap_or_default() as usize % limit.max(1);
    let [shortest, longest] = PIECE_M.map(|metres| (metres / cell).round().max(1.0) as usize);
    let mut pieces = Vec::new();
    let mut start = 0;
    while start < width {
        let end = (start + shortest + below(longest - shortest + 1)).min(width);
        pieces.push(start..end);
        start = end;
    }
    for last in (1..pieces.len()).rev() {
        pieces.swap(last, below(last + 1));
    }
    pieces.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn are_certain(excesses: &[f64]) -> bool {
        periodicity(excesses, 1.0).is_certain()
    }

    fn periodicity(excesses: &[f64], open: f64) -> Periodicity {
        let row = |excess: &f64| Excess { total: excess * 10.0, length: 10.0 };
        let measured = Periodicity::of_excesses(&excesses.iter().map(row).collect::<Vec<_>>());
        Periodicity { layers: excesses.len(), open, threshold: Threshold::COMMON_MODEL, ..measured }
    }

    #[test]
    fn few_rows_must_be_clearer_than_many() {
        assert!(are_certain(&[1.0; 12]));
        assert!(!are_certain(&[1.0; 2]));
        assert!(are_certain(&[4.0]));
        assert!(!are_certain(&[]));
    }

    #[test]
    fn rows_without_an_aisle_must_be_clearer() {
        assert!(!periodicity(&[1.0; 12], 0.8).is_certain());
        assert!(periodicity(&[3.0; 12], 0.8).is_certain());
    }

    #[test]
    fn rows_with_a_model_each_must_be_clearer() {
        let alone = |excess, open| Periodicity { threshold: Threshold::OWN_MODELS, ..periodicity(&[excess; 12], open) };
        assert!(alone(3.0, 1.0).is_certain());
        assert!(!alone(2.0, 1.0).is_certain());
        assert!(!alone(6.0, 0.9).is_certain());
    }

    #[test]
    fn rows_that_disagree_are_not_certain() {
        assert!(are_certain(&[0.6; 12]));
        assert!(!are_certain(&[1.8, 0.0, 0.0].repeat(4)));
    }
}
