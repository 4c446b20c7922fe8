//! How the rows of one direction are read: the pitch of their places and the shape of the goods in them.
//!
//! Every pitch is tried, with goods as a first guess has them and with goods a quarter, a half and three quarters of a
//! place further, for a row of full places looks the same from all; where goods end, at posts and at uprights, only one
//! of them is right. Goods and cuts
//! are found by turns, as in expectation maximization, and the reading that explains the rows best for its number of
//! places is taken: a likelihood with the remaining energy as its noise, and a price for each place (minimum description
//! length, J. Rissanen 1978, doi 10.1016/0005-1098(78)90005-5).
//!
//! Rows that a reading of their own explains much better leave, and are read together in turn: one direction may hold
//! racks and a staging area, or rows with another pitch.
//!
//! Cost: O(pitches x cells x widths of places). Limits: one shape of goods in each reading, so a row that mixes loads and
//! legs is explained by what both have in common.

use rayon::prelude::*;

use super::comb::{self, Comb, Lanes};
use super::evidence::Evidence;
use super::load_template::{self, Goods};

/// Length along which the noise of content is the same, metres: goods off their mark, and the smoothing.
const CORRELATION_M: f64 = 0.2;
/// Share of the energy that is noise even where goods explain all of it.
pub(crate) const LEAST_NOISE: f64 = 0.15;
/// Noise before anything is explained, as a share of the energy.
const FIRST_NOISE: f64 = 0.4;
/// Turns of cutting and learning; there is no change worth it afterwards.
const TURNS: usize = 2;
/// Price of a place: whether it is full and how wide it is, half a logarithm of its cells.
pub(crate) const PLACE_PRICE: f64 = 1.5;
/// Price of a shape of goods of a row's own: its dozen values, each half a logarithm of the cells of a row.
pub(crate) const GOODS_PRICE: f64 = 25.0;
/// Price of another reading that is there already, and of a pitch of a row's own.
const READING_PRICE: f64 = 5.0;
pub(crate) const PITCH_PRICE: f64 = 10.0;
/// No direction of a region holds more sorts of storage.
const MOST_READINGS: usize = 6;
/// Rows of this length together are enough to learn from, metres: some 300 places.
const ENOUGH_M: f64 = 400.0;
/// A row's own pitch is known to this, metres.
const NEAR_M: f64 = 0.03;
/// Step of the pitches that are tried, metres; every second one is tried first.
const STEP_M: f64 = 0.025;
const STRIDE: usize = 2;
/// Rows shorter than this many places say nothing of their pitch.
const LEAST_PLACES: f64 = 2.2;

/// The pitches that are tried within `range`, metres.
pub(crate) fn pitches(range: [f64; 2]) -> Vec<f64> {
    let count = ((range[1] - range[0]) / STEP_M).round() as usize + 1;
    (0..count).map(|index| range[0] + index as f64 * STEP_M).collect()
}

/// Whether a row is long enough to tell whether it has a pitch, metres.
fn tells(row: &Evidence, pitch: f64) -> bool {
    row.length() >= LEAST_PLACES * pitch
}

/// A way to read rows.
#[derive(Debug, Clone)]
pub(crate) struct Reading {
    /// Metres.
    pub pitch: f64,
    goods: Goods,
    /// Energy per cell that the goods leave unexplained.
    noise: f64,
}

/// What a reading makes of rows.
#[derive(Debug, Clone, Copy, Default)]
struct Account {
    explained: f64,
    energy: f64,
    cells: usize,
    places: usize,
    /// What borders and widths earn.
    structure: f64,
    /// Side of a cell, metres.
    cell: f64,
}

impl Account {
    /// Adds a row; `explained` says by twice the middle of a place what of its energy is.
    fn add(&mut self, row: &Evidence, comb: &Comb, explained: impl Fn(usize) -> f32, noise: f64) {
        let mut of_row = 0.0;
        for place in comb.places() {
            of_row += f64::from(explained(place.start + place.end));
            let energy = |content: &[f64]| content[place.clone()].iter().map(|value| value * value).sum::<f64>();
            self.energy += row.contents().map(energy).sum::<f64>();
            self.cells += place.len() * row.contents().count();
            self.places += row.contents().count();
        }
        self.explained += of_row;
        self.structure += comb.score - of_row * weight(noise, row.cell);
        self.cell = row.cell;
    }

    fn noise(&self) -> f64 {
        let left = (self.energy - self.explained).max(LEAST_NOISE * self.energy);
        (left / self.cells.max(1) as f64).max(f64::MIN_POSITIVE.sqrt())
    }

    fn score(&self, noise: f64) -> f64 {
        self.explained * weight(noise, self.cell) + self.structure - PLACE_PRICE * self.places as f64
    }
}

/// What energy counts in a logarithm of a likelihood.
pub(crate) fn weight(noise: f64, cell: f64) -> f64 {
    cell / (2.0 * CORRELATION_M * noise)
}

impl Reading {
    /// Cuts a row.
    pub(super) fn cut(&self, row: &Evidence) -> Comb {
        self.cut_and_account(row, self.noise).0
    }

    /// The score of a row at the best of some pitches, and what borders and widths have in it.
    pub(super) fn best_fit(&self, row: &Evidence, pitches: &[f64]) -> (f64, f64) {
        self.fitted(row, pitches).fit(row)
    }

    /// The score of a row, and what borders and widths have in it.
    pub(super) fn fit(&self, row: &Evidence) -> (f64, f64) {
        let (_, account) = self.cut_and_account(row, self.noise);
        (account.score(self.noise), account.structure)
    }

    /// The same goods at that of some pitches which suits a row best.
    pub(super) fn fitted(&self, row: &Evidence, pitches: &[f64]) -> Self {
        let fit = |&pitch: &f64| {
            let reading = self.at(pitch, row.cell);
            (reading.score(row, self.noise), reading)
        };
        let fits = pitches.iter().step_by(STRIDE).map(fit);
        fits.reduce(|best, other| if other.0 > best.0 { other } else { best })
            .map_or_else(|| self.clone(), |best| best.1)
    }

    /// Twice the middles of the places of a row that hold goods, cells.
    pub(super) fn goods_in(&self, row: &Evidence) -> Vec<usize> {
        let explained = load_template::explained([&self.goods], row);
        load_template::middles(&self.cut(row)).filter(|&twice| explained[twice][0] > 0.0).collect()
    }

    fn score(&self, row: &Evidence, noise: f64) -> f64 {
        self.cut_and_account(row, noise).1.score(noise)
    }

    fn cut_and_account(&self, row: &Evidence, noise: f64) -> (Comb, Account) {
        let explained = load_template::explained([&self.goods], row);
        let [comb] = cut(row, self.pitch, &explained, [noise]);
        let mut account = Account::default();
        account.add(row, &comb, |twice| explained[twice][0], noise);
        (comb, account)
    }

    /// The same goods at another pitch.
    fn at(&self, pitch: f64, cell: f64) -> Self {
        Self { pitch, goods: self.goods.at(pitch, cell), noise: self.noise }
    }
}

/// Cuts a row once for each sort of goods and its noise.
fn cut<const N: usize>(row: &Evidence, pitch: f64, explained: &[Lanes<N>], noise: [f64; N]) -> [Comb; N] {
    let weight = noise.map(|noise| weight(noise, row.cell) as f32);
    comb::cut(row, pitch, |start, width| {
        let explained = &explained[2 * start + width];
        std::array::from_fn(|lane| explained[lane] * weight[lane])
    })
}

/// Places by their doubled middles, cells, each with its weight.
type Weighted = Vec<(usize, f64)>;

/// Learns goods and cuts rows by turns, from several first guesses of the places of each row.
fn fit<const N: usize>(rows: &[&Evidence], pitch: f64, guesses: [Vec<Weighted>; N]) -> [(Reading, Account); N] {
    let energy: f64 = rows.iter().flat_map(|row| &row.content).map(|value| value * value).sum();
    let cells: usize = rows.iter().map(|row| row.content.len()).sum();
    let mut noise = [(FIRST_NOISE * energy / cells.max(1) as f64).max(f64::MIN_POSITIVE.sqrt()); N];
    let mut places = guesses;
    let mut turn = 1;
    loop {
        let goods =
            places.map(|places| Goods::learn(rows.iter().copied().zip(places.iter().map(Vec::as_slice)), pitch));
        let mut accounts = [Account::default(); N];
        places = std::array::from_fn(|_| Vec::with_capacity(rows.len()));
        for row in rows {
            let explained = load_template::explained(goods.each_ref(), row);
            for (lane, comb) in cut(row, pitch, &explained, noise).into_iter().enumerate() {
                let at = |twice: usize| explained[twice][lane];
                accounts[lane].add(row, &comb, at, noise[lane]);
                let amplitude = |twice: usize| (twice, f64::from(at(twice).max(0.0)).sqrt());
                places[lane].push(load_template::middles(&comb).map(amplitude).collect());
            }
        }
        noise = accounts.map(|account| account.noise());
        if turn == TURNS {
            let mut goods = goods.into_iter().zip(noise).zip(accounts);
            return std::array::from_fn(|_| {
                let ((goods, noise), account) = goods.next().expect("there are as many goods as guesses");
                (Reading { pitch, goods, noise }, account)
            });
        }
        turn += 1;
    }
}

/// Rows of one direction.
pub(crate) struct Rows<'a> {
    pub rows: Vec<&'a Evidence>,
    /// The pitches that are tried, metres, ascending.
    pub pitches: Vec<f64>,
}

impl Rows<'_> {
    /// The reading that explains all rows best; none where they are too short to tell.
    pub(super) fn in_common(&self) -> Option<Reading> {
        let all: Vec<usize> = (0..self.rows.len()).collect();
        self.best(&self.sample(&all))
    }

    /// A reading for each row, `first` being that of all in common; none where rows show nothing.
    pub(super) fn read(&self, first: Reading) -> Vec<Option<Reading>> {
        let all: Vec<usize> = (0..self.rows.len()).collect();
        let noise = first.noise;
        let own: Vec<Option<Reading>> = all.par_iter().map(|&row| self.best(&[row])).collect();
        let mut readings = vec![first];
        let mut group = all.clone();
        while readings.len() < MOST_READINGS {
            let current = &readings[readings.len() - 1];
            let leaves = |&row: &usize| {
                let score = |reading: &Reading| reading.score(self.rows[row], noise);
                own[row].as_ref().is_some_and(|own| score(own) > score(current) + GOODS_PRICE)
            };
            let leaving: Vec<usize> = group.par_iter().copied().filter(leaves).collect();
            if leaving.len() == group.len() && readings.len() > 1 {
                break;
            }
            let Some(next) = self.best(&self.sample(&leaving)) else { break };
            readings.push(next);
            group = leaving;
        }
        let choose = |(&row, own): (&usize, &Option<Reading>)| self.choose(row, own.as_ref(), &readings, noise);
        all.par_iter().zip(&own).map(choose).collect()
    }

    /// Rows enough to learn from, evenly spread.
    fn sample(&self, of: &[usize]) -> Vec<usize> {
        let length: f64 = of.iter().map(|&row| self.rows[row].len() as f64 * self.rows[row].cell).sum();
        of.iter().copied().step_by(((length / ENOUGH_M) as usize).max(1)).collect()
    }

    /// The reading that explains rows best.
    fn best(&self, of: &[usize]) -> Option<Reading> {
        let count = self.pitches.len();
        let coarse: Vec<(usize, Reading, Account)> = (0..count)
            .step_by(STRIDE)
            .collect::<Vec<_>>()
            .into_par_iter()
            .flat_map_iter(|at| self.fits(of, at))
            .collect();
        let noise = coarse.iter().map(|(_, _, account)| account.noise()).fold(f64::INFINITY, f64::min);
        let better = |one: (usize, Reading, Account), other: (usize, Reading, Account)| {
            if other.2.score(noise) > one.2.score(noise) { other } else { one }
        };
        let best = coarse.into_iter().reduce(better)?;
        let near = [best.0.checked_sub(1), Some(best.0 + 1).filter(|&next| next < count)];
        let fine = near.into_iter().flatten().flat_map(|at| self.fits(of, at));
        let (_, reading, _) = fine.fold(best, better);
        Some(reading)
    }

    /// Rows read at a pitch, with goods as guessed and by quarters of a place further.
    fn fits(&self, of: &[usize], at: usize) -> Vec<(usize, Reading, Account)> {
        let pitch = self.pitches[at];
        let rows: Vec<&Evidence> = of.iter().map(|&row| self.rows[row]).filter(|row| tells(row, pitch)).collect();
        let Some(cell) = rows.first().map(|row| row.cell) else { return Vec::new() };
        let guess = |row: &&Evidence| -> Vec<usize> {
            let [comb] = comb::cut(row, pitch, comb::even(row));
            load_template::middles(&comb).collect()
        };
        let guess: Vec<Vec<usize>> = rows.iter().map(guess).collect();
        // Middles are doubled, so half a pitch is a quarter of a place.
        let shifted = [0.0, 0.5, 1.0, 1.5].map(|quarters| {
            let shift = (quarters * pitch / cell).round() as usize;
            guess.iter().map(|middles| middles.iter().map(|twice| (twice + shift, 1.0)).collect()).collect()
        });
        fit(&rows, pitch, shifted).map(|(reading, account)| (at, reading, account)).into()
    }

    /// The reading for a row: one of those found, at its pitch or about that of the row's own reading.
    fn choose(&self, row: usize, own: Option<&Reading>, readings: &[Reading], noise: f64) -> Option<Reading> {
        let row = self.rows[row];
        if row.content.iter().all(|&content| content <= 0.0) {
            return None;
        }
        let scored = |reading: Reading, price: f64| (reading.score(row, noise) - price, reading);
        let better = |one: (f64, Reading), other: (f64, Reading)| if other.0 > one.0 { other } else { one };
        let price = |rank: usize| if rank == 0 { 0.0 } else { READING_PRICE };
        let of_group =
            readings.iter().enumerate().map(|(rank, reading)| scored(reading.clone(), price(rank))).reduce(better)?;
        let reading = of_group.1.clone();
        let is_near = |pitch: &&f64| own.is_some_and(|own| (own.pitch - **pitch).abs() <= NEAR_M);
        let near = self.pitches.iter().filter(is_near);
        let others = near.map(|&pitch| scored(reading.at(pitch, row.cell), price(1) + PITCH_PRICE));
        Some(others.fold(of_group, better).1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decomposition::ground::{Axis, Frame};

    /// Borders of the places that a row drawn in cells of 5 cm is cut into.
    fn check(row: &str, wanted: &expect_test::Expect) {
        let (frame, rect) = Frame::of_picture(&format!("{row}\n").repeat(20), 0.05);
        let evidence = Evidence::of(&frame.patch(&rect, Axis::U), frame.cell, [0.7, 1.8]);
        let rows = Rows { rows: vec![&evidence], pitches: pitches([0.8, 1.6]) };
        let reading = rows.in_common().and_then(|first| rows.read(first).remove(0));
        let cut = reading.map(|reading| reading.cut(&evidence));
        let places = cut.iter().flat_map(Comb::places).map(|place| format!("{}..{}", place.start, place.end));
        wanted.assert_eq(&places.collect::<Vec<_>>().join(" "));
    }

    /// Three stringers on a place of 1.1 m; the gap within a pallet is wider than that between two.
    const FULL: &str = ".#.......##.......##..";
    const EMPTY: &str = "......................";

    #[test]
    fn places_end_where_goods_end() {
        let row = [FULL, FULL, EMPTY, FULL, FULL, FULL, EMPTY, FULL].concat();
        check(&row, &expect_test::expect!["0..20 20..44 44..65 65..87 87..109 109..131 131..153 153..175"]);
    }

    #[test]
    fn floor_that_nobody_saw_is_not_read() {
        check(&"?".repeat(100), &expect_test::expect![""]);
        check("..", &expect_test::expect![""]);
    }
}
