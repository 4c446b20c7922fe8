//! First guesses of the pitch, and whether rows have one at all.
//!
//! Every candidate is fitted to every row by the borders and the evenness of its places alone; [`super::reading`] starts
//! from there. Whether there is anything to read is said by the best candidate: what its borders earn is compared with
//! what borders earn on average. A sum would favour fractions of the pitch and a mean its multiples, so the excess is
//! divided by powers of the number of borders and of the length in between; how well the rows repeat themselves at the
//! pitch, and at two of it, is added. Cost: O(candidates x cells).

use rayon::prelude::*;

use super::comb::{self, Comb};
use super::evidence::Evidence;

/// Step of the candidates, metres.
const STEP_M: f64 = 0.025;
/// Powers of the number of borders and of the length (best of 0.3 to 0.8 for the first).
const BORDERS_POWER: f64 = 0.8;
const LENGTH_POWER: f64 = 0.2;
/// Weight of the repeat at the pitch and at two of it (best of 0.15 to 1.2).
const REPEAT_WEIGHTS: [f64; 2] = [0.35, 0.25];
/// How far a repeat may be off the pitch, metres.
const REPEAT_REACH_M: f64 = 0.05;
/// Rows shorter than this many places say nothing.
const LEAST_PLACES: f64 = 2.2;

/// The pitches that are tried within `range`, metres.
pub(super) fn candidates(range: [f64; 2]) -> Vec<f64> {
    let count = ((range[1] - range[0]) / STEP_M).round() as usize + 1;
    (0..count).map(|index| range[0] + index as f64 * STEP_M).collect()
}

/// Whether a row is long enough to tell whether it has a pitch, metres.
pub(super) fn tells(row: &Evidence, pitch: f64) -> bool {
    row.length() >= LEAST_PLACES * pitch
}

/// Rows cut at every candidate.
#[derive(Debug, Clone)]
pub(super) struct Guesses {
    /// The candidates, metres.
    pub pitches: Vec<f64>,
    /// Every row cut at every candidate.
    pub of_row: Vec<Vec<Comb>>,
}

impl Guesses {
    /// Cuts the rows at every candidate within `range`, metres.
    pub(super) fn of(rows: &[&Evidence], range: [f64; 2]) -> Self {
        let pitches = candidates(range);
        let cut = |row: &&Evidence| pitches.iter().flat_map(|&pitch| comb::cut(row, pitch, comb::even(row))).collect();
        let of_row = rows.par_iter().map(cut).collect();
        Self { pitches, of_row }
    }

    /// The best candidate of all rows together, by number, and its score.
    pub(super) fn best(&self, rows: &[&Evidence]) -> Option<(usize, f64)> {
        let fit = |at: usize| {
            let mut fit = [0.0; 3];
            for (row, combs) in rows.iter().zip(&self.of_row).filter(|(row, _)| tells(row, self.pitches[at])) {
                fit[0] += combs[at].score;
                fit[1] += combs[at].borders as f64;
                fit[2] += row.len() as f64 * row.cell;
            }
            fit
        };
        let fits: Vec<[f64; 3]> = (0..self.pitches.len()).map(fit).collect();
        let mut means: Vec<f64> = fits.iter().map(|[score, borders, _]| score / borders.max(1.0)).collect();
        means.sort_by(f64::total_cmp);
        let usual = means.get(means.len() / 2).copied().unwrap_or(0.0);
        let widest = self.pitches.last().copied().unwrap_or(0.0);
        let repeats = Repeats::of(rows, 2.0 * widest + REPEAT_REACH_M);
        let score = |([score, borders, length], &pitch): (&[f64; 3], &f64)| {
            let borders = borders.max(1.0);
            let excess = (score - usual * borders) / borders.powf(BORDERS_POWER) / length.max(1e-3).powf(LENGTH_POWER);
            excess + REPEAT_WEIGHTS[0] * repeats.at(pitch) + REPEAT_WEIGHTS[1] * repeats.at(2.0 * pitch)
        };
        let scores = fits.iter().zip(&self.pitches).map(score).enumerate();
        scores.reduce(|best, other| if other.1 > best.1 { other } else { best })
    }
}

/// How well rows repeat themselves, by lag.
struct Repeats {
    shares: Vec<f64>,
    cell: f64,
}

impl Repeats {
    fn of(rows: &[&Evidence], longest: f64) -> Self {
        let cell = rows.first().map_or(1.0, |row| row.cell);
        let most = (longest / cell).ceil() as usize;
        let (mut products, mut squares) = (vec![0.0; most + 1], vec![0.0; most + 1]);
        for row in rows {
            let (of_row, whole) = row.repeats(most);
            for lag in 0..=most {
                products[lag] += of_row[lag];
                squares[lag] += whole[lag];
            }
        }
        let share = |(product, square): (&f64, &f64)| if *square > 0.0 { product / square } else { 0.0 };
        Self { shares: products.iter().zip(&squares).map(share).collect(), cell }
    }

    /// The best repeat near a lag, metres.
    fn at(&self, lag: f64) -> f64 {
        let reach = (REPEAT_REACH_M / self.cell).round() as usize;
        let at = (lag / self.cell).round() as usize;
        let near = self.shares.get(at.saturating_sub(reach)..=at + reach).unwrap_or_default();
        near.iter().copied().fold(0.0, f64::max)
    }
}
