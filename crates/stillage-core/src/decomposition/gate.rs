//! The periodicity gate: whether the rows of one direction are rows of places, or walls and furniture that are no such
//! thing and stay whole.
//!
//! A comb fits anything somehow, so its score alone tells little; the question is whether it fits better than chance. Each
//! row is compared with itself after its columns were cut into short pieces and these shuffled: the same posts, gaps and
//! goods, but no regular distance between them. What the real row scores above its shuffled selves, as a share of the
//! score of a perfect row, is nothing for walls, desks and shelves, whatever they score, and positive for places, even
//! where each row has its own pitch and phase. Rows vote together; few rows must be clearer than many.
//!
//! Source: surrogate data (J. Theiler et al. 1992, doi 10.1016/0167-2789(92)90102-S), with block shuffling (H. Künsch
//! 1989, doi 10.1214/aos/1176347265) for the null. Measured: floors of 24 offices, a bookshop and three warehouses
//! without places have an excess of at most 0.07 (most of them 0.02, with one row up to 0.10), but for one office of 0.19
//! whose desks stand like racks; generated sites 0.06 to 1.0, the lower end with pitch and phase of each row its own and a
//! third of the places empty. So the two kinds meet at the bound: it is measured on these maps, and no law.
//!
//! Cost: O(pitches x cells) of at most [`MOST_LENGTH_M`] of rows. Limits: furniture at a regular distance of 0.8 to 1.6 m
//! along several walls is taken for places, and so may bare posts at any distances, which are little but borders.

use rayon::prelude::*;

use super::evidence::Evidence;
use super::frame::Patch;
use super::pitch::Guesses;

/// Least excess of many rows, and what the excess of one row must be above it.
const LEAST_EXCESS: f64 = 0.03;
const LEAST_EXCESS_OF_ONE: f64 = 0.25;
/// Weight of what the comb earns per place beside the score by which pitches are chosen: the one shows places of many
/// pitches, the other posts that stand far apart.
const EARNED_WEIGHT: f64 = 0.5;
/// Shuffled selves of each row.
const SHUFFLES: u64 = 3;
/// Length of the pieces that are shuffled, metres: longer than a post with its gap, shorter than any place.
const PIECE_M: [f64; 2] = [0.25, 0.55];
/// Rows shorter than two places of the widest kind say nothing, metres.
const LEAST_LENGTH_M: f64 = 2.6;
/// So many metres of rows settle the question.
const MOST_LENGTH_M: f64 = 1000.0;

/// Whether rows repeat themselves. `layers` and `row` give the number of layers and the cells of a row by its number,
/// `widths` are those that its evidence is asked about and `pitches` the range of the pitch, metres.
pub(super) fn is_periodic(
    rows: &[&Evidence],
    layers: impl Fn(usize) -> usize,
    patch: impl Fn(usize) -> Patch + Sync,
    widths: [f64; 2],
    pitches: [f64; 2],
) -> bool {
    let long: Vec<usize> = (0..rows.len()).filter(|&row| rows[row].length() >= LEAST_LENGTH_M).collect();
    let length: f64 = long.iter().map(|&row| rows[row].length()).sum();
    let stride = (length / MOST_LENGTH_M).ceil().max(1.0) as usize;
    let voters: Vec<usize> = long.into_iter().step_by(stride).collect();
    let of_row = |&row: &usize| {
        let (real, cells) = (rows[row], patch(row));
        let mut excess = fit(real, pitches);
        for turn in 0..SHUFFLES {
            let shuffled = shuffled(&cells, real.cell, row as u64 * SHUFFLES + turn);
            let chance = fit(&Evidence::of(&shuffled, real.cell, widths), pitches);
            excess = [0, 1].map(|at| excess[at] - chance[at] / SHUFFLES as f64);
        }
        excess.map(|excess| excess * real.length())
    };
    let of_rows: Vec<[f64; 2]> = voters.par_iter().map(of_row).collect();
    let length: f64 = voters.iter().map(|&row| rows[row].length()).sum();
    let [score, earned] = [0, 1].map(|at| of_rows.iter().map(|excess| excess[at]).sum::<f64>() / length);
    let excess = score + EARNED_WEIGHT * earned.max(0.0);
    let votes: usize = voters.iter().map(|&row| layers(row)).sum();
    votes > 0 && excess >= LEAST_EXCESS + LEAST_EXCESS_OF_ONE / votes as f64
}

/// How well the comb fits at the best pitch: the score by which pitches are chosen, and what the comb earns per place.
fn fit(row: &Evidence, pitches: [f64; 2]) -> [f64; 2] {
    let guesses = Guesses::of(&[row], pitches);
    guesses
        .best(&[row])
        .map_or([0.0; 2], |(at, score)| [score, guesses.of_row[0][at].score * guesses.pitches[at] / row.length()])
}

/// A row with its columns in another order.
fn shuffled(row: &Patch, cell: f64, seed: u64) -> Patch {
    let mut random = (0_u64..).map(|turn| mix(mix(seed) ^ turn));
    let mut below = |limit: usize| random.next().unwrap_or_default() as usize % limit.max(1);
    let [shortest, longest] = PIECE_M.map(|metres| (metres / cell).round().max(1.0) as usize);
    let mut pieces = Vec::new();
    let mut start = 0;
    while start < row.width {
        let end = (start + shortest + below(longest - shortest + 1)).min(row.width);
        pieces.push(start..end);
        start = end;
    }
    for last in (1..pieces.len()).rev() {
        pieces.swap(last, below(last + 1));
    }
    let order: Vec<usize> = pieces.into_iter().flatten().collect();
    let cells = (0..row.height).flat_map(|y| order.iter().map(move |&x| row.row(y)[x])).collect();
    Patch { width: row.width, height: row.height, cells }
}

/// The finalizer of `SplitMix64` (G. L. Steele, D. Lea and C. H. Flood, OOPSLA 2014, doi 10.1145/2660193.2660195).
fn mix(value: u64) -> u64 {
    let value = value.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let value = (value ^ (value >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let value = (value ^ (value >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    value ^ (value >> 31)
}
