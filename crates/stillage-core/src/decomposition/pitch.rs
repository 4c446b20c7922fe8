//! The pitch of the places of a block, from all of its rows together.
//!
//! Every candidate is fitted to every row; what the borders earn is compared with what borders earn on average. A sum
//! would favour fractions of the pitch and a mean its multiples, so the excess is divided by powers of the number of
//! borders and of the length in between (accuracy study: most of 42 regions right). Cost: O(candidates x cells).

use super::comb;
use super::evidence::Evidence;

/// Step of the candidates, metres.
const STEP_M: f64 = 0.025;
/// Powers of the number of borders and of the length (accuracy study).
const BORDERS_POWER: f64 = 0.6;
const LENGTH_POWER: f64 = 0.4;
/// Rows shorter than this many places say nothing.
const LEAST_PLACES: f64 = 2.2;

/// The candidates and how well each fits.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PitchScores {
    pub pitches: Vec<f64>,
    pub scores: Vec<f64>,
}

impl PitchScores {
    /// Fits every candidate within `range` (metres) to the rows.
    pub(super) fn of(rows: &[&Evidence], range: [f64; 2], cell: f64) -> Self {
        let count = ((range[1] - range[0]) / STEP_M).round() as usize + 1;
        let pitches: Vec<f64> = (0..count).map(|index| range[0] + index as f64 * STEP_M).collect();
        let fits: Vec<[f64; 3]> = pitches
            .iter()
            .map(|&pitch| {
                let mut fit = [0.0; 3];
                for row in rows {
                    let length = row.border.len() as f64 * cell;
                    if length < LEAST_PLACES * pitch {
                        continue;
                    }
                    let comb = comb::cut(row, pitch, cell);
                    fit[0] += comb.score;
                    fit[1] += comb.borders as f64;
                    fit[2] += length;
                }
                fit
            })
            .collect();
        let mut means: Vec<f64> = fits.iter().map(|[score, borders, _]| score / borders.max(1.0)).collect();
        means.sort_by(f64::total_cmp);
        let usual = means.get(means.len() / 2).copied().unwrap_or(0.0);
        let scores = fits
            .iter()
            .map(|[score, borders, length]| {
                let borders = borders.max(1.0);
                (score - usual * borders) / borders.powf(BORDERS_POWER) / length.max(1e-3).powf(LENGTH_POWER)
            })
            .collect();
        Self { pitches, scores }
    }

    /// The best pitch and its score.
    pub(super) fn best(&self) -> Option<(f64, f64)> {
        let best = (0..self.scores.len()).reduce(|a, b| if self.scores[b] > self.scores[a] { b } else { a })?;
        Some((self.pitches[best], self.scores[best]))
    }

    /// Score of the candidate nearest to a pitch.
    pub(super) fn at(&self, pitch: f64) -> f64 {
        let near = |a: usize, b: usize| {
            let distance = |index: usize| (self.pitches[index] - pitch).abs();
            if distance(b) < distance(a) { b } else { a }
        };
        (0..self.scores.len()).reduce(near).map_or(f64::NEG_INFINITY, |index| self.scores[index])
    }
}
