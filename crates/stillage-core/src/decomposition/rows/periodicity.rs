//! The periodicity gate: whether the rows of one direction are rows of places, or walls and furniture that are no such
//! thing and stay whole.
//!
//! A comb fits anything somehow, so its score alone tells little; the question is whether it fits better than chance. Each
//! row is compared with itself after its columns were cut into short pieces and these shuffled: the same posts, gaps and
//! goods, but nothing at a regular distance. Both are read with the goods that all rows have in common and at whatever
//! pitch suits, and what the real row scores above its shuffled selves is its excess: positive for places, even where each
//! row has its own pitch and phase and a third of the places are empty, and nothing or less for walls, desks and shelves,
//! which no goods have in common. Layers that share their lanes speak together: solid goods show no more than where each
//! lane ends, each at another layer. Where a direction holds several sorts of storage that have no goods in common, each
//! row speaks for itself, and must speak more clearly. The rows together are periodic if their mean excess is certainly
//! high, as far as their spread tells; few rows must be clearer than many, and so must rows that vehicles do not find room
//! along. Where those of one direction are, those of the other need not: two racks in the wing of a hall are too few to be
//! certain by themselves.
//!
//! Source: surrogate data (J. Theiler et al. 1992, doi 10.1016/0167-2789(92)90102-S), with block shuffling (H. Künsch
//! 1989, doi 10.1214/aos/1176347265) for the null. Measured, as the mean less 1.5 errors: 24 offices, a bookshop
//! and other floors without places have up to 1.4, but those above 0.3 have room for a vehicle along 0.94 of their rows
//! at most; 150 generated sites have it along 0.97 and more, and 0.4 to 3 where they are hard, 1 to 9 otherwise. Each row
//! by itself, floors without places have up to 6, with room for a vehicle along 0.81 to 0.91, and sites 2 to 10.
//!
//! Cost: O(pitches x cells) of at most 1 km of rows. Limits: furniture at a regular distance of 0.8 to 1.6 m
//! along several walls is taken for places.

use rayon::prelude::*;

use super::evidence::Evidence;
use crate::decomposition::ground::Patch;
use crate::orientation::energy::mix;

/// What rows must score above chance, logarithms of a likelihood per metre of a layer.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Bar {
    /// Many rows.
    least: f64,
    /// One row above that.
    of_one: f64,
    /// Rows that nothing drives along above that.
    blocked: f64,
    /// Standard errors by which the mean must be above that.
    errors: f64,
    /// So many metres of rows settle the question.
    most_length: f64,
}

impl Bar {
    /// Rows that are read with the goods that all have in common: fifteen means of sixteen are no further off than that.
    pub(super) const IN_COMMON: Self =
        Self { least: 0.15, of_one: 2.0, blocked: 10.0, errors: 1.5, most_length: 1000.0 };
    /// Rows that are read each with goods of its own: furniture is more like itself than like that of other rows.
    pub(super) const BY_THEMSELVES: Self =
        Self { least: 2.15, of_one: 4.0, blocked: 60.0, errors: 3.0, most_length: 300.0 };
}

/// Excess above the bar of rows that no office has.
const SURE_EXCESS: f64 = 1.25;
/// How much more borders count than goods, for furniture has a shape but no borders.
const BORDER_WEIGHT: f64 = 2.0;
/// Shuffled selves of each row.
const SHUFFLES: u64 = 3;
/// Length of the pieces that are shuffled, metres: longer than a post with its gap, shorter than any place.
const PIECE_M: [f64; 2] = [0.25, 0.55];
/// Rows shorter than two places of the widest kind say nothing, metres.
const LEAST_LENGTH_M: f64 = 2.6;
/// Share of the length of a row in which something stands, at the least: bare floor says nothing.
const GOODS_SHARE: f64 = 0.1;

/// How surely rows repeat themselves.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Periodicity {
    /// What a metre of a layer scores above chance, a logarithm of a likelihood, and its standard error.
    mean: f64,
    error: f64,
    /// Number of layers that say so.
    votes: usize,
    /// Share of their length with room for a vehicle on one side.
    open: f64,
    /// Whether nothing stands in any of them.
    is_bare: bool,
    bar: Bar,
}

impl Periodicity {
    /// `open` and `layers` give the share of its length with room for a vehicle and the cells of each layer of a row by
    /// number, `widths` are those that its evidence is asked about, metres; `fit` is what a row scores at the pitch that
    /// suits it best, and what its borders have in it.
    pub(super) fn of(
        rows: &[Evidence],
        open: impl Fn(usize) -> f64,
        layers: impl Fn(usize) -> Vec<Patch> + Sync,
        widths: [f64; 2],
        fit: impl Fn(&Evidence) -> (f64, f64) + Sync,
        bar: Bar,
    ) -> Self {
        let all: Vec<usize> = (0..rows.len()).filter(|&row| rows[row].length() >= LEAST_LENGTH_M).collect();
        let held: Vec<usize> = all.iter().copied().filter(|&row| layers(row).iter().any(holds_goods)).collect();
        // Bare racks speak by their posts.
        let is_bare = held.is_empty();
        let long = if is_bare { all } else { held };
        let length: f64 = long.iter().map(|&row| rows[row].length()).sum();
        let stride = (length / bar.most_length).ceil().max(1.0) as usize;
        let voters: Vec<usize> = long.into_iter().step_by(stride).collect();
        let fit = |row: &Evidence| {
            let (score, borders) = fit(row);
            score + BORDER_WEIGHT * borders
        };
        let excess = |&row: &usize| {
            let (real, layers) = (&rows[row], layers(row));
            let chance = |turn: u64| {
                let order = shuffled(real.len(), real.cell, row as u64 * SHUFFLES + turn);
                fit(&Evidence::bundle(
                    layers.iter().map(|layer| Evidence::of(&layer.in_order(&order), real.cell, widths)),
                ))
            };
            let chance = (0..SHUFFLES).map(chance).sum::<f64>() / SHUFFLES as f64;
            // What is worse than chance is no row; how much worse says nothing of the others.
            Excess { total: (fit(real) - chance).max(0.0), length: real.length() * layers.len() as f64 }
        };
        let excesses: Vec<Excess> = voters.par_iter().map(excess).collect();
        let votes = voters.iter().map(|&row| rows[row].contents().count()).sum();
        let voting: f64 = voters.iter().map(|&row| rows[row].length()).sum();
        let open =
            voters.iter().map(|&row| open(row) * rows[row].length()).sum::<f64>() / voting.max(f64::MIN_POSITIVE);
        Self { is_bare, bar, ..Self::of_rows(&excesses, votes, open) }
    }

    /// The same from the excess of each row; each of their layers votes.
    fn of_rows(rows: &[Excess], votes: usize, open: f64) -> Self {
        if rows.is_empty() {
            return Self::default();
        }
        let length: f64 = rows.iter().map(|row| row.length).sum();
        let mean = rows.iter().map(|row| row.total).sum::<f64>() / length;
        let square = |row: &Excess| row.length * (row.total / row.length - mean).powi(2);
        let variance = rows.iter().map(square).sum::<f64>() / length;
        // The spread of two rows says little: their error counts twice, that of three by a quarter more (as Student's
        // factor does, W. S. Gosset 1908, doi 10.1093/biomet/6.1.1, which is larger still).
        let freedom = rows.len().saturating_sub(1).max(1) as f64;
        Self {
            mean,
            error: (variance / freedom).sqrt() * (1.0 + 1.0 / (freedom * freedom)),
            votes,
            open,
            is_bare: false,
            bar: Bar::IN_COMMON,
        }
    }

    /// What is certain of the mean above what many rows need.
    fn surplus(&self) -> f64 {
        self.mean - self.bar.errors * self.error - self.least()
    }

    fn least(&self) -> f64 {
        self.bar.least + self.bar.blocked * (1.0 - self.open)
    }

    /// Whether they do so certainly, whatever the map shows.
    pub(super) fn is_certain(&self) -> bool {
        self.votes > 0 && self.surplus() >= self.bar.of_one / self.votes as f64
    }

    /// Whether they do so more clearly than any furniture: the building is a storage.
    pub(super) fn is_sure(&self) -> bool {
        self.is_certain() && self.surplus() >= SURE_EXCESS
    }

    /// Whether they do so rather than not, in a storage.
    pub(super) fn is_likely(&self) -> bool {
        !self.is_bare && self.mean >= self.least()
    }
}

/// What a row scores above its shuffled selves.
#[derive(Debug, Clone, Copy)]
struct Excess {
    total: f64,
    /// That of all its layers, metres.
    length: f64,
}

/// Whether something stands in a row, and not beside it only, as a wall does.
fn holds_goods(row: &Patch) -> bool {
    let middle = row.height / 4..row.height - row.height / 4;
    let is_held = |column: &usize| middle.clone().any(|y| !row.row(y)[*column].is_free());
    (0..row.width).filter(is_held).count() as f64 >= GOODS_SHARE * row.width as f64
}

/// The columns of a row in another order.
fn shuffled(width: usize, cell: f64, seed: u64) -> Vec<usize> {
    let mut random = (0_u64..).map(|turn| mix(mix(seed) ^ turn));
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
        Periodicity::of_rows(&excesses.iter().map(row).collect::<Vec<_>>(), excesses.len(), open)
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
    fn rows_that_speak_for_themselves_must_be_clearer() {
        let alone = |excess, open| Periodicity { bar: Bar::BY_THEMSELVES, ..periodicity(&[excess; 12], open) };
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
